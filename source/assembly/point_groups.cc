// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/point_groups.h>

#include <algorithm>
#include <numeric>

namespace EBSMPM
{
  template <int dim>
  std::shared_ptr<const Utilities::MPI::Partitioner>
  make_partitioner(const SplineSpace<dim>          &space,
                   const AffineConstraints<double> &constraints,
                   const unsigned int               n_components)
  {
    std::vector<types::global_dof_index> ghosts;
    for (const auto &entry : space.functions())
      {
        const auto index = entry.second.index;
        if (index < space.n_independent())
          ghosts.push_back(index);
        else
          for (const auto &term : *constraints.get_constraint_entries(index))
            ghosts.push_back(term.first);
      }
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());

    const auto spread = [n_components](const IndexSet &functions) {
      IndexSet unknowns(n_components * functions.size());
      for (auto range = functions.begin_intervals();
           range != functions.end_intervals();
           ++range)
        unknowns.add_range(n_components * *range->begin(),
                           n_components * (range->last() + 1));
      unknowns.compress();
      return unknowns;
    };

    IndexSet relevant(space.n_independent());
    relevant.add_indices(ghosts.begin(), ghosts.end());
    relevant.compress();
    return std::make_shared<const Utilities::MPI::Partitioner>(
      spread(space.locally_owned_independent()),
      spread(relevant),
      space.communicator());
  }



  template <int dim>
  bool
  PointGroups<dim>::reinit(const CellPoints<dim>             &points,
                           const std::vector<Pattern>        &patterns,
                           const SplineSpace<dim>            &space,
                           const AffineConstraints<double>   &constraints,
                           const Utilities::MPI::Partitioner &partitioner)
  {
    Assert(patterns.empty() || patterns.size() == points.n_points(),
           ExcDimensionMismatch(patterns.size(), points.n_points()));

    Origin new_origin;
    new_origin.space     = &space;
    new_origin.n_changes = space.n_changes();
    new_origin.cells.reserve(points.cells().size());
    new_origin.levels.reserve(points.cells().size());
    new_origin.ends.reserve(points.cells().size());
    for (const auto &cell : points.cells())
      {
        new_origin.cells.push_back(cell.index);
        new_origin.levels.push_back(cell.level);
        new_origin.ends.push_back(cell.end);
      }
    new_origin.patterns = patterns;
    if (new_origin == origin)
      return false;
    std::swap(origin, new_origin);

    // Often, points have gone from one of the cells to another, and that is
    // all.
    if (patterns.empty() && origin.has_same_functions(new_origin))
      {
        max_points = 0;
        for (auto &group : group_list)
          {
            group.begin = points.cells()[group.cell].begin;
            group.end   = points.cells()[group.cell].end;
            max_points  = std::max(max_points, group.end - group.begin);
          }
        point_numbers.resize(points.n_points());
        std::iota(point_numbers.begin(), point_numbers.end(), 0U);
        return true;
      }

    group_list.clear();
    point_numbers.clear();
    function_numbers.clear();
    extensions.clear();
    n_per_cell = space.n_functions_per_cell();
    max_n = max_points = 0;
    AssertThrow(n_per_cell <= 8 * sizeof(Pattern), ExcInternalError());

    point_numbers.reserve(points.n_points());
    std::vector<unsigned int> columns;
    std::vector<Pattern>      patterns_here;

    for (unsigned int c = 0; c < points.cells().size(); ++c)
      {
        const auto &cell = points.cells()[c];

        patterns_here.assign(1, patterns.empty() ? 0 : patterns[cell.begin]);
        if (!patterns.empty())
          {
            patterns_here.assign(patterns.begin() + cell.begin,
                                 patterns.begin() + cell.end);
            std::sort(patterns_here.begin(), patterns_here.end());
            patterns_here.erase(std::unique(patterns_here.begin(),
                                            patterns_here.end()),
                                patterns_here.end());
          }

        for (const Pattern pattern : patterns_here)
          {
            Group group;
            group.cell    = c;
            group.pattern = pattern;
            group.begin   = point_numbers.size();
            for (unsigned int q = cell.begin; q < cell.end; ++q)
              if (patterns.empty() || patterns[q] == pattern)
                point_numbers.push_back(q);
            group.end = point_numbers.size();

            // The functions that these points read, and what they depend on.
            std::array<types::global_dof_index, 64> indices;
            bool                                    plain = true;
            columns.clear();
            for (unsigned int i = 0; i < n_per_cell; ++i)
              {
                const auto key = space.cell_function(cell.index, cell.level, i)
                                   .with_part((pattern >> i) & 1);
                const auto *function = space.find(key);
                Assert(function != nullptr,
                       ExcMessage("A point reads a function that does not "
                                  "exist in this space."));
                indices[i] = function->index;
                if (indices[i] < space.n_independent())
                  columns.push_back(partitioner.global_to_local(indices[i]));
                else
                  {
                    plain = false;
                    for (const auto &term :
                         *constraints.get_constraint_entries(indices[i]))
                      columns.push_back(
                        partitioner.global_to_local(term.first));
                  }
              }

            group.first_function = function_numbers.size();
            group.extension      = numbers::invalid_unsigned_int;
            if (!plain)
              {
                std::sort(columns.begin(), columns.end());
                columns.erase(std::unique(columns.begin(), columns.end()),
                              columns.end());
                const unsigned int m = columns.size();
                group.extension      = extensions.size();
                extensions.resize(extensions.size() + n_per_cell * m, 0.);
                double    *E         = extensions.data() + group.extension;
                const auto column_of = [&](
                                         const types::global_dof_index index) {
                  return std::lower_bound(columns.begin(),
                                          columns.end(),
                                          partitioner.global_to_local(index)) -
                         columns.begin();
                };
                for (unsigned int i = 0; i < n_per_cell; ++i)
                  if (indices[i] < space.n_independent())
                    E[i * m + column_of(indices[i])] = 1.;
                  else
                    for (const auto &term :
                         *constraints.get_constraint_entries(indices[i]))
                      E[i * m + column_of(term.first)] = term.second;
              }
            group.n_functions = columns.size();
            function_numbers.insert(function_numbers.end(),
                                    columns.begin(),
                                    columns.end());

            max_n      = std::max(max_n, group.n_functions);
            max_points = std::max(max_points, group.end - group.begin);
            group_list.push_back(group);
          }
      }
    return true;
  }



  template <int dim>
  std::vector<unsigned int>
  find_partners(const CellPoints<dim>  &points,
                const PointGroups<dim> &groups,
                const CellPoints<dim>  &other_points,
                const PointGroups<dim> &others)
  {
    // Groups are sorted by cell, and by pattern.
    const auto is_before = [](const CellPoints<dim>                  &points_a,
                              const typename PointGroups<dim>::Group &a,
                              const CellPoints<dim>                  &points_b,
                              const typename PointGroups<dim>::Group &b) {
      const auto &cell_a = points_a.cells()[a.cell].iterator;
      const auto &cell_b = points_b.cells()[b.cell].iterator;
      return cell_a != cell_b ? cell_a < cell_b : a.pattern < b.pattern;
    };

    std::vector<unsigned int> partners(groups.groups().size(),
                                       numbers::invalid_unsigned_int);
    unsigned int              o = 0;
    for (unsigned int g = 0; g < partners.size(); ++g)
      {
        const auto &group = groups.groups()[g];
        while (o < others.groups().size() &&
               is_before(other_points, others.groups()[o], points, group))
          ++o;
        if (o < others.groups().size() &&
            !is_before(points, group, other_points, others.groups()[o]))
          partners[g] = o;
      }
    return partners;
  }



  template class PointGroups<2>;
  template class PointGroups<3>;

  template std::vector<unsigned int>
  find_partners(const CellPoints<2> &,
                const PointGroups<2> &,
                const CellPoints<2> &,
                const PointGroups<2> &);
  template std::vector<unsigned int>
  find_partners(const CellPoints<3> &,
                const PointGroups<3> &,
                const CellPoints<3> &,
                const PointGroups<3> &);

  template std::shared_ptr<const Utilities::MPI::Partitioner>
  make_partitioner<2>(const SplineSpace<2> &,
                      const AffineConstraints<double> &,
                      const unsigned int);
  template std::shared_ptr<const Utilities::MPI::Partitioner>
  make_partitioner<3>(const SplineSpace<3> &,
                      const AffineConstraints<double> &,
                      const unsigned int);
} // namespace EBSMPM
