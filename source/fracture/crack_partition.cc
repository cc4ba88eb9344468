// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/bspline_kernel.h>

#include <ebsmpm/fracture/crack_directions.h>
#include <ebsmpm/fracture/crack_partition.h>
#include <ebsmpm/fracture/lattice_neighbours.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace EBSMPM
{
  namespace internal
  {
    namespace CrackPartitionImplementation
    {
      /** Cells with less damage than this, and without labels, are left out. */
      constexpr double noteworthy_damage = 0.2;

      /**
       * Half the width of the strip in which a function looks for damage along
       * its side vector, in cells: as narrow as two points per cell and
       * direction permit.
       */
      constexpr double strip = 0.26;

      /**
       * Where cracks meet, the ridge has no direction but arms: the ratio of
       * its principal variances is larger than the first number, and the
       * smaller one, over the square of the radius, larger than the second.
       * (Straight arms of full length have 1/6 in all directions, and the end
       * of a ridge, or a new one, has less than 1/32.)
       */
      constexpr double junction_ratio    = 0.5;
      constexpr double junction_variance = 1. / 16.;

      /**
       * The lips of a crack that is wide open look like a junction. It is none
       * if more than this part of the material has settled sides, or if less
       * than that part of the support is filled.
       */
      constexpr double most_settled = 0.1;
      constexpr double least_filled = 0.8;

      /**
       * The length of the mean of side vectors above which there is more
       * material on one side beyond doubt.
       */
      constexpr double clear_majority = 0.5;
    } // namespace CrackPartitionImplementation
  }   // namespace internal

  using namespace internal::CrackPartitionImplementation;
  using namespace CrackDirections;



  template <int dim>
  CrackPartition<dim>::CrackPartition(const SplineSpace<dim> &space,
                                      const AdditionalData   &data)
    : spline_space(&space)
    , data(data)
    , ridge(space, data.closure_damage, data.ridge_radius)
  {}



  template <int dim>
  bool
  CrackPartition<dim>::update(const CellPoints<dim>     &points,
                              const CellPoints<dim>     &boundary_points,
                              const std::vector<double> &volumes,
                              const std::vector<double> &damage,
                              CrackLabels<dim>          &labels,
                              CrackLabels<dim>          &boundary_labels)
  {
    if (data.grow)
      for (unsigned int q = 0; q < points.n_points(); ++q)
        labels.peak_damage[q] = std::max(labels.peak_damage[q], damage[q]);

    select_cells(points, damage, labels);
    const bool anything =
      (Utilities::MPI::max(active_cells.empty() ? 0U : 1U,
                           spline_space->communicator()) > 0);
    if (anything)
      {
        ridge.smooth_damage(points, active_cells, volumes, damage);
        if (data.grow)
          {
            ridge.find();
            label_points(points, labels);
            label_points(boundary_points, boundary_labels);
          }
        find_sides(points, volumes, labels);
        find_separable(points, labels);
        if (data.grow)
          {
            close_gaps();
            // In 2-D, closing gaps to free boundaries leaves nothing.
            if (dim == 3)
              cut_remainders(points, labels);
          }
        add_bare_functions(boundary_points);
        add_shared_functions(*spline_space, table);
      }
    const bool changed = make_patterns(points, labels, point_patterns);
    const bool boundary_changed =
      make_patterns(boundary_points, boundary_labels, boundary_point_patterns);

    const auto reads_twins = [](const std::vector<Pattern> &patterns) {
      return std::any_of(patterns.begin(),
                         patterns.end(),
                         [](const Pattern pattern) { return pattern != 0; });
    };
    const bool twins =
      reads_twins(point_patterns) || reads_twins(boundary_point_patterns);
    std::vector<unsigned int> anywhere = {changed || boundary_changed ? 1U : 0U,
                                          twins ? 1U : 0U};
    Utilities::MPI::max(anywhere, spline_space->communicator(), anywhere);
    any_twin = (anywhere[1] > 0);
    return anywhere[0] > 0;
  }



  template <int dim>
  void
  CrackPartition<dim>::select_cells(const CellPoints<dim>     &points,
                                    const std::vector<double> &damage,
                                    const CrackLabels<dim>    &labels)
  {
    active_cells.clear();
    ridge.clear();
    table.clear();
    n_refused = 0;
    for (unsigned int c = 0; c < points.cells().size(); ++c)
      {
        const auto &cell       = points.cells()[c];
        bool        noteworthy = false;
        for (unsigned int q = cell.begin; q < cell.end && !noteworthy; ++q)
          noteworthy = (data.grow && damage[q] > noteworthy_damage) ||
                       labels.peak_damage[q] > noteworthy_damage ||
                       labels.frozen[q];
        if (noteworthy)
          active_cells.push_back(c);
      }
  }



  template <int dim>
  void
  CrackPartition<dim>::label_points(const CellPoints<dim> &points,
                                    CrackLabels<dim>      &labels) const
  {
    for (const auto &cell : points.cells())
      for (unsigned int q = cell.begin; q < cell.end; ++q)
        if (!labels.frozen[q])
          labels.side[q] =
            ridge.side_vector(cell, points.unit_point(q), points.location(q));
  }



  template <int dim>
  void
  CrackPartition<dim>::find_sides(const CellPoints<dim>     &points,
                                  const std::vector<double> &volumes,
                                  const CrackLabels<dim>    &labels)
  {
    const BSplineKernel<dim>           kernel(spline_space->degree());
    const unsigned int                 n = kernel.n_functions();
    const FunctionDirectory<dim, Sums> directory(spline_space->communicator());
    std::array<double, BSplineKernel<dim>::max_n_functions> B;

    const auto add = [](Sums a, const Sums &b) {
      a.volume += b.volume;
      a.settled_volume += b.settled_volume;
      a.filled_volume += b.filled_volume;
      for (unsigned int d = 0; d < dim; ++d)
        {
          a.vector[d] += b.vector[d];
          a.moment[d] += b.moment[d];
        }
      a.dyads += b.dyads;
      return a;
    };

    typename FunctionDirectory<dim, Sums>::Table sums;
    for (const unsigned int c : active_cells)
      {
        const auto &cell = points.cells()[c];
        std::array<Sums, BSplineKernel<dim>::max_n_functions> local{};
        for (unsigned int q = cell.begin; q < cell.end; ++q)
          {
            kernel.values(points.unit_point(q), B.data());
            const Tensor<1, dim>         &side = labels.side[q];
            const Point<dim>             &x    = points.location(q);
            const SymmetricTensor<2, dim> dyad =
              symmetrize(outer_product(side, side));
            for (unsigned int i = 0; i < n; ++i)
              {
                const double w = B[i] * volumes[q] * side.norm();
                local[i].volume += w;
                local[i].settled_volume += labels.frozen[q] ? w : 0.;
                local[i].filled_volume += B[i] * volumes[q];
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    local[i].moment[d] += B[i] * volumes[q] * x[d];
                    local[i].vector[d] += w * side[d];
                  }
                local[i].dyads += w * dyad;
              }
          }
        for (unsigned int i = 0; i < n; ++i)
          {
            Sums &sum =
              sums[spline_space->cell_function(cell.index, cell.level, i)];
            sum = add(sum, local[i]);
          }
      }
    sums = directory.reduce(sums, add);

    for (const auto &entry : sums)
      {
        const Sums          &sum      = entry.second;
        const auto          &shape    = ridge.table().at(entry.first);
        FunctionData        &function = table[entry.first];
        const Tensor<1, dim> mean     = to_tensor(sum.vector);
        function.owner                = shape.owner;
        for (unsigned int d = 0; d < dim; ++d)
          function.centre[d] = sum.moment[d] / sum.filled_volume;
        if (sum.volume == 0.)
          continue;
        const double h =
          spline_space->lattice().cell_extents(entry.first.level)[0];
        function.at_junction =
          shape.variance_ratio > junction_ratio &&
          shape.least_variance > junction_variance &&
          sum.settled_volume < most_settled * sum.volume &&
          sum.volume > least_filled * Utilities::fixed_power<dim>(h);

        // About as much material on either side: where the crack bends, what is
        // left of the mean need not point across it. If it is as much, go to
        // the fixed side. (Points next to a slit have sides before there is a
        // ridge.)
        Tensor<1, dim> side = mean / sum.volume;
        function.majority   = side.norm();
        if (side.norm() < clear_majority)
          {
            const Tensor<1, dim> axis =
              canonical(eigenvectors(sum.dyads)[0].second);
            side = (side * axis < -tie ? -axis : axis);
          }
        side /= side.norm();
        function.side = to_array(side);
      }
  }



  template <int dim>
  void
  CrackPartition<dim>::find_separable(const CellPoints<dim>  &points,
                                      const CrackLabels<dim> &labels)
  {
    // Points see functions beyond those of their own cell: up to two cells
    // ahead of the function, half a support is not enough.
    constexpr int    ring = 1;
    std::vector<Key> centers;
    for (const auto &entry : table)
      centers.push_back(entry.first);
    const DataTable around =
      surroundings(table, centers, ring, spline_space->communicator());

    // The damage met in the strip, or, where there is no material in the strip
    // because the function is outside of the body, in the strip around the
    // centre of its material, or in the whole support.
    struct Met
    {
      double in_strip      = -1.;
      double around_centre = -1.;
      double in_support    = 0.;
    };
    const auto combine = [](Met a, const Met &b) {
      a.in_strip      = std::max(a.in_strip, b.in_strip);
      a.around_centre = std::max(a.around_centre, b.around_centre);
      a.in_support    = std::max(a.in_support, b.in_support);
      return a;
    };
    typename FunctionDirectory<dim, Met>::Table ahead;
    const int                                   p = spline_space->degree();
    for (const unsigned int c : active_cells)
      {
        const auto  &cell = points.cells()[c];
        const double h    = spline_space->lattice().cell_extents(cell.level)[0];
        const unsigned int width = p + 1 + 2 * ring;
        const unsigned int n     = Utilities::pow(width, dim);
        for (unsigned int i = 0; i < n; ++i)
          {
            Key key = spline_space->cell_function(cell.index, cell.level, 0);
            for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= width)
              key.index[d] += static_cast<int>(rest % width) - ring;
            const auto found = around.find(key);
            if (found == around.end())
              continue;
            const Tensor<1, dim> m = to_tensor(found->second.side);
            if (m.norm_square() == 0.)
              continue;

            const Point<dim> x =
              spline_space->lattice().greville_point(key,
                                                     spline_space->degree());
            const Tensor<1, dim> shift = to_tensor(found->second.centre) - x;
            Met                  met;
            for (unsigned int q = cell.begin; q < cell.end; ++q)
              {
                const Tensor<1, dim> offset = points.location(q) - x;
                const double         along  = offset * m;
                if (along < -(1. + tie) * h || along > (2. + tie) * h)
                  continue;
                const Tensor<1, dim> across = offset - along * m;
                const double         damage = labels.peak_damage[q];
                if (across.norm() < strip * h)
                  met.in_strip = std::max(met.in_strip, damage);
                if ((across - (shift - (shift * m) * m)).norm() < strip * h)
                  met.around_centre = std::max(met.around_centre, damage);
                if (across.norm() < (0.5 * (p + 1) + tie) * h)
                  met.in_support = std::max(met.in_support, damage);
              }
            Met &total = ahead[key];
            total      = combine(total, met);
          }
      }

    // Ask for the result for all functions that we see, whether or not we had
    // something to say about them.
    for (const auto &entry : table)
      ahead.emplace(entry.first, Met());
    const FunctionDirectory<dim, Met> directory(spline_space->communicator());
    ahead = directory.reduce(ahead, combine);
    const unsigned int my_rank =
      Utilities::MPI::this_mpi_process(spline_space->communicator());
    for (auto &entry : table)
      {
        const Met &met            = ahead.at(entry.first);
        entry.second.damage_ahead = met.in_strip >= 0. ? met.in_strip :
                                    dim == 3 && met.around_centre >= 0. ?
                                                         met.around_centre :
                                                         met.in_support;
        const bool broken = entry.second.damage_ahead > data.damage_threshold;
        entry.second.separable = broken && !entry.second.at_junction;
        if (broken && entry.second.at_junction && entry.second.owner == my_rank)
          ++n_refused;
      }
    n_refused = Utilities::MPI::sum(n_refused, spline_space->communicator());
  }



  template <int dim>
  bool
  CrackPartition<dim>::make_patterns(const CellPoints<dim> &points,
                                     CrackLabels<dim>      &labels,
                                     std::vector<Pattern>  &patterns) const
  {
    std::vector<Pattern> result(points.n_points(), 0);
    const unsigned int   n = spline_space->n_functions_per_cell();
    for (const auto &cell : points.cells())
      {
        std::array<const FunctionData *, BSplineKernel<dim>::max_n_functions>
             functions{};
        bool any = false;
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto found = table.find(
              spline_space->cell_function(cell.index, cell.level, i));
            if (found != table.end() && found->second.separable)
              {
                functions[i] = &found->second;
                any          = true;
              }
          }
        if (!any)
          continue;

        for (unsigned int q = cell.begin; q < cell.end; ++q)
          {
            for (unsigned int i = 0; i < n; ++i)
              if (functions[i] != nullptr &&
                  labels.side[q] * to_tensor(functions[i]->side) < 0.)
                result[q] |= Pattern(1) << i;

            if (!labels.frozen[q] && labels.side[q].norm_square() > 0.)
              {
                const auto *shape = ridge.nearest(cell, points.unit_point(q));
                labels.frozen[q] =
                  shape != nullptr && shape->variance_ratio < data.frozen_ratio;
              }
          }
      }
    const bool changed = (result != patterns);
    patterns.swap(result);
    return changed;
  }



  template <int dim>
  void
  CrackPartition<dim>::clear()
  {
    point_patterns.clear();
    boundary_point_patterns.clear();
    any_twin = false;
  }



  template <int dim>
  const std::vector<typename CrackPartition<dim>::Pattern> &
  CrackPartition<dim>::patterns() const
  {
    return point_patterns;
  }



  template <int dim>
  bool
  CrackPartition<dim>::is_open() const
  {
    return any_twin;
  }



  template <int dim>
  const std::vector<typename CrackPartition<dim>::Pattern> &
  CrackPartition<dim>::boundary_patterns() const
  {
    return boundary_point_patterns;
  }



  template <int dim>
  Tensor<1, dim>
  CrackPartition<dim>::side_of(const Key &key) const
  {
    const auto found = table.find(key);
    return found != table.end() && found->second.separable ?
             to_tensor(found->second.side) :
             Tensor<1, dim>();
  }



  template <int dim>
  const SplineSpace<dim> &
  CrackPartition<dim>::space() const
  {
    return *spline_space;
  }



  template <int dim>
  unsigned int
  CrackPartition<dim>::n_junctions() const
  {
    return n_refused;
  }



  template <int dim>
  void
  CrackPartition<dim>::add_sides(
    typename SplineSpace<dim>::SupportTable &supports) const
  {
    for (auto &entry : supports)
      {
        const auto found = table.find(entry.first.with_part(0));
        if (found != table.end())
          entry.second.side = found->second.side;
      }
  }



  template class CrackPartition<2>;
  template class CrackPartition<3>;
} // namespace EBSMPM
