// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of CrackPartition that decides about functions by looking at others:
// those in gaps between separable functions, and those without material.

#include <ebsmpm/fracture/crack_directions.h>
#include <ebsmpm/fracture/crack_partition.h>
#include <ebsmpm/fracture/lattice_neighbours.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace EBSMPM
{
  using namespace CrackDirections;

  namespace
  {
    /** Reach of the closure, in cells. */
    constexpr int closure_reach = 3;
  } // namespace



  template <int dim>
  void
  CrackPartition<dim>::close_gaps()
  {
    std::vector<Key> candidates;
    for (const auto &entry : table)
      if (!entry.second.separable && !entry.second.at_junction &&
          entry.second.damage_ahead > data.closure_damage)
        candidates.push_back(entry.first);
    const DataTable around = surroundings(table,
                                          candidates,
                                          closure_reach,
                                          spline_space->communicator());

    // Which of the others have material at all. (Boundary points may see
    // functions that do not.)
    std::vector<Key> unknown;
    for (const auto &key : candidates)
      for_each_neighbour(key, closure_reach, [&](const Key &other) {
        if (around.find(other) == around.end())
          unknown.push_back(other);
      });
    std::sort(unknown.begin(), unknown.end());
    unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
    const auto sound    = spline_space->query(unknown);
    const auto is_sound = [&sound](const Key &key) {
      const auto found = sound.find(key);
      return found != sound.end() && found->second.fraction > 0.;
    };

    std::vector<Key> closed;
    for (const auto &key : candidates)
      {
        const Tensor<1, dim> m = to_tensor(table.at(key).side);
        if (m.norm_square() == 0.)
          continue;
        const double     h = spline_space->lattice().cell_extents(key.level)[0];
        const Point<dim> x =
          spline_space->lattice().greville_point(key, spline_space->degree());

        // What lies along the ridge: separable functions, the outside, and
        // functions that are intact, or else so far away that nobody knows what
        // comes after them.
        std::vector<Tensor<1, dim>> separable, outside, intact;
        const auto                  is_at_reach = [&key](const Key &other) {
          int steps = 0;
          for (unsigned int d = 0; d < dim; ++d)
            steps = std::max(steps, std::abs(other.index[d] - key.index[d]));
          return steps == closure_reach;
        };
        for_each_neighbour(key, closure_reach, [&](const Key &other) {
          const Tensor<1, dim> offset =
            spline_space->lattice().greville_point(other,
                                                   spline_space->degree()) -
            x;
          const double         along  = offset * m;
          const Tensor<1, dim> across = offset - along * m;
          if (across.norm() < 0.5 * h ||
              across.norm() > (closure_reach + tie) * h)
            return;
          const auto found = around.find(other);
          if (found != around.end())
            {
              if (found->second.separable && std::abs(along) < (2. + tie) * h)
                separable.push_back(across / across.norm());
              else if (!found->second.separable &&
                       std::abs(along) < (0.5 + tie) * h &&
                       (found->second.damage_ahead <= data.closure_damage ||
                        is_at_reach(other)))
                intact.push_back(across / across.norm());
            }
          else if (std::abs(along) < (0.5 + tie) * h)
            (is_sound(other) ? intact : outside)
              .push_back(across / across.norm());
        });

        // In 3-D, the outside counts only where nothing is intact ahead: else,
        // a crack that runs along a free surface would find it diagonally ahead
        // of its tip.
        const auto any_opposite = [](const Tensor<1, dim>              &a,
                                     const std::vector<Tensor<1, dim>> &list,
                                     const double cosine) {
          return std::any_of(list.begin(),
                             list.end(),
                             [&](const Tensor<1, dim> &b) {
                               return a * b < -cosine;
                             });
        };
        bool between = false;
        for (const auto &a : separable)
          between = between || any_opposite(a, separable, 0.7) ||
                    (any_opposite(a, outside, 0.7) &&
                     (dim < 3 || !any_opposite(a, intact, 0.3)));
        if (between)
          closed.push_back(key);
      }
    for (const auto &key : closed)
      table[key].separable = true;
  }



  template <int dim>
  void
  CrackPartition<dim>::cut_remainders(const CellPoints<dim>  &points,
                                      const CrackLabels<dim> &labels)
  {
    // What there is on the far side of a function: material that is parted from
    // the near side by separable functions, how far away along the side vector
    // that begins, and other material.
    struct FarSide
    {
      double                  distance  = std::numeric_limits<double>::max();
      bool                    has_whole = false;
      std::array<double, dim> side{};
      unsigned int            owner = 0;
    };
    const auto combine = [](FarSide a, const FarSide &b) {
      a.distance  = std::min(a.distance, b.distance);
      a.has_whole = a.has_whole || b.has_whole;
      return a;
    };
    const auto distance =
      [&](const Key &key, const Tensor<1, dim> &side, const Point<dim> &x) {
        return (x - spline_space->lattice().greville_point(
                      key, spline_space->degree())) *
               side;
      };
    const FunctionDirectory<dim, FarSide> directory(
      spline_space->communicator());
    const unsigned int n = spline_space->n_functions_per_cell();

    typename FunctionDirectory<dim, FarSide>::Table far_sides;
    for (const auto &entry : table)
      if (!entry.second.separable && !entry.second.at_junction &&
          to_tensor(entry.second.side).norm_square() > 0. &&
          entry.second.majority >= data.remainder_majority)
        {
          FarSide &far_side = far_sides[entry.first];
          far_side.side     = entry.second.side;
          far_side.owner    = entry.second.owner;
        }

    std::vector<std::pair<const Key, FarSide> *> whole;
    for (const unsigned int c : active_cells)
      {
        const auto &cell             = points.cells()[c];
        bool        sees_a_separable = false;
        whole.clear();
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto key =
              spline_space->cell_function(cell.index, cell.level, i);
            const auto function = table.find(key);
            const auto found    = far_sides.find(key);
            if (function != table.end() && function->second.separable)
              sees_a_separable = true;
            else if (found != far_sides.end())
              whole.push_back(&*found);
          }
        for (auto *const function : whole)
          {
            FarSide             &far_side = function->second;
            const Tensor<1, dim> m        = to_tensor(far_side.side);
            for (unsigned int q = cell.begin; q < cell.end; ++q)
              if (sees_a_separable && labels.side[q] * m < 0.)
                far_side.distance =
                  std::min(far_side.distance,
                           distance(function->first, m, points.location(q)));
              else if (!(labels.side[q] * m > 0.))
                far_side.has_whole = true;
          }
      }
    far_sides = directory.reduce(far_sides, combine);

    // Few are left. For them, cells that take no part count, too: nobody has
    // told on which side their points are, but they are not on the near one if
    // they are as far away as what has been cut off.
    for (auto entry = far_sides.begin(); entry != far_sides.end();)
      if (entry->second.distance < std::numeric_limits<double>::max() &&
          !entry->second.has_whole)
        ++entry;
      else
        entry = far_sides.erase(entry);
    if (Utilities::MPI::max(far_sides.empty() ? 0U : 1U,
                            spline_space->communicator()) == 0)
      return;
    add_shared_functions(*spline_space, far_sides);
    auto active = active_cells.begin();
    for (unsigned int c = 0; c < points.cells().size(); ++c)
      if (active != active_cells.end() && *active == c)
        ++active;
      else
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto &cell  = points.cells()[c];
            const auto  found = far_sides.find(
              spline_space->cell_function(cell.index, cell.level, i));
            if (found == far_sides.end())
              continue;
            FarSide             &far_side = found->second;
            const Tensor<1, dim> m        = to_tensor(far_side.side);
            const double         h =
              spline_space->lattice().cell_extents(cell.level)[0];
            for (unsigned int q = cell.begin; q < cell.end; ++q)
              if (distance(found->first, m, points.location(q)) >
                  far_side.distance - tie * h)
                far_side.has_whole = true;
          }
    for (const auto &entry : directory.reduce(far_sides, combine))
      if (!entry.second.has_whole && table.find(entry.first) != table.end())
        table.at(entry.first).separable = true;
  }



  template <int dim>
  void
  CrackPartition<dim>::add_bare_functions(
    const CellPoints<dim> &boundary_points)
  {
    const unsigned int n = spline_space->n_functions_per_cell();
    std::vector<Key>   bare;
    for (const auto &cell : boundary_points.cells())
      {
        const auto key = [&](const unsigned int i) {
          return spline_space->cell_function(cell.index, cell.level, i);
        };
        bool is_near = false;
        for (unsigned int i = 0; i < n && !is_near; ++i)
          is_near = table.find(key(i)) != table.end();
        for (unsigned int i = 0; i < n && is_near; ++i)
          if (table.find(key(i)) == table.end() &&
              spline_space->find(key(i))->fraction == 0.)
            bare.push_back(key(i));
      }
    std::sort(bare.begin(), bare.end());
    bare.erase(std::unique(bare.begin(), bare.end()), bare.end());
    if (Utilities::MPI::max(bare.empty() ? 0U : 1U,
                            spline_space->communicator()) == 0)
      return;

    const DataTable    around = surroundings(table,
                                          bare,
                                          spline_space->degree(),
                                          spline_space->communicator());
    const unsigned int my_rank =
      Utilities::MPI::this_mpi_process(spline_space->communicator());
    typename FunctionDirectory<dim, unsigned int>::Table owners;
    for (const auto &key : bare)
      {
        // Those at the smallest distance.
        FunctionData   function;
        Tensor<1, dim> side;
        int            smallest = std::numeric_limits<int>::max();
        for_each_neighbour(key, spline_space->degree(), [&](const Key &other) {
          const auto found = around.find(other);
          if (found == around.end())
            return;
          int square = 0;
          for (unsigned int d = 0; d < dim; ++d)
            square += Utilities::fixed_power<2>(other.index[d] - key.index[d]);
          if (square > smallest)
            return;
          if (square < smallest)
            {
              smallest           = square;
              function.separable = false;
              side               = 0.;
            }
          if (found->second.separable)
            {
              const Tensor<1, dim> theirs = to_tensor(found->second.side);
              function.separable          = true;
              if (side * theirs >= 0.)
                side += theirs;
            }
        });
        if (!function.separable)
          continue;
        function.side = to_array(side / side.norm());
        table[key]    = function;
        owners[key]   = my_rank;
      }
    const FunctionDirectory<dim, unsigned int> directory(
      spline_space->communicator());
    for (const auto &entry :
         directory.reduce(owners,
                          [](const unsigned int a, const unsigned int b) {
                            return std::min(a, b);
                          }))
      table[entry.first].owner = entry.second;
  }



  template void
  CrackPartition<2>::close_gaps();
  template void
  CrackPartition<3>::close_gaps();

  template void
  CrackPartition<2>::cut_remainders(const CellPoints<2> &,
                                    const CrackLabels<2> &);
  template void
  CrackPartition<3>::cut_remainders(const CellPoints<3> &,
                                    const CrackLabels<3> &);

  template void
  CrackPartition<2>::add_bare_functions(const CellPoints<2> &);
  template void
  CrackPartition<3>::add_bare_functions(const CellPoints<3> &);
} // namespace EBSMPM
