// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/fracture/crack_partition.h>
#include <ebsmpm/splines/bspline_kernel.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace EBSMPM
{
  namespace internal
  {
    namespace CrackPartitionImplementation
    {
      /** Cells with less damage than this, and without labels, are left out. */
      constexpr double noteworthy_damage = 0.2;

      /** Part of the local maximum above which the ridge begins. */
      constexpr double ridge_fraction = 0.75;

      /** Offsets smaller than this part of a cell are ties. */
      constexpr double tie = 0.01;

      /**
       * Half the width of the strip in which a function looks for damage along
       * its side vector, in cells: as narrow as two points per cell and
       * direction permit.
       */
      constexpr double strip = 0.26;

      /** Reach of the closure, in cells. */
      constexpr int closure_reach = 3;



      /** Of the two directions of an axis, the one that counts as positive. */
      template <int dim>
      Tensor<1, dim>
      canonical(const Tensor<1, dim> &axis)
      {
        // The largest component, by a margin, so that an axis along a
        // coordinate direction does not depend on roundoff in the others.
        for (unsigned int d = 0; d < dim; ++d)
          if (std::abs(axis[d]) > 0.5 / std::sqrt(1. * dim))
            return axis[d] > 0 ? axis : -axis;
        return axis;
      }



      template <int dim>
      std::array<double, dim>
      to_array(const Tensor<1, dim> &t)
      {
        std::array<double, dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = t[d];
        return result;
      }



      template <std::size_t dim>
      Tensor<1, static_cast<int>(dim)>
      to_tensor(const std::array<double, dim> &a)
      {
        Tensor<1, static_cast<int>(dim)> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = a[d];
        return result;
      }



      /** Call <tt>visit(key)</tt> for all lattice neighbours within a radius. */
      template <int dim, typename Visitor>
      void
      for_each_neighbour(const FunctionKey<dim> &center,
                         const int               radius,
                         const Visitor &         visit)
      {
        const unsigned int width = 2 * radius + 1;
        const unsigned int n     = Utilities::pow(width, dim);
        for (unsigned int i = 0; i < n; ++i)
          {
            FunctionKey<dim> key = center;
            for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= width)
              key.index[d] += static_cast<int>(rest % width) - radius;
            visit(key);
          }
      }
    } // namespace CrackPartitionImplementation
  }   // namespace internal

  using namespace internal::CrackPartitionImplementation;



  template <int dim>
  CrackPartition<dim>::CrackPartition(const SplineSpace<dim> &space,
                                      const AdditionalData &  data)
    : space(&space)
    , data(data)
    , my_rank(Utilities::MPI::this_mpi_process(space.communicator()))
  {}



  template <int dim>
  bool
  CrackPartition<dim>::update(const CellPoints<dim> &    points,
                              const CellPoints<dim> &    boundary_points,
                              const std::vector<double> &volumes,
                              const std::vector<double> &damage,
                              CrackLabels<dim> &         labels,
                              CrackLabels<dim> &         boundary_labels)
  {
    if (data.grow)
      for (unsigned int q = 0; q < points.n_points(); ++q)
        labels.peak_damage[q] = std::max(labels.peak_damage[q], damage[q]);

    select_cells(points, damage, labels);
    const bool anything = (Utilities::MPI::max(active_cells.empty() ? 0U : 1U,
                                               space->communicator()) > 0);
    if (anything)
      {
        smooth_damage(points, volumes, damage);
        if (data.grow)
          {
            find_ridge();
            label_points(points, labels);
            label_points(boundary_points, boundary_labels);
          }
        find_sides(points, volumes, labels);
        find_separable(points, labels);
        if (data.grow)
          close_gaps();
      }
    const bool changed = make_patterns(points, labels, point_patterns);
    const bool boundary_changed =
      make_patterns(boundary_points, boundary_labels, boundary_point_patterns);
    return Utilities::MPI::max(changed || boundary_changed ? 1U : 0U,
                               space->communicator()) > 0;
  }



  template <int dim>
  void
  CrackPartition<dim>::select_cells(const CellPoints<dim> &    points,
                                    const std::vector<double> &damage,
                                    const CrackLabels<dim> &   labels)
  {
    active_cells.clear();
    table.clear();
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
  CrackPartition<dim>::smooth_damage(const CellPoints<dim> &    points,
                                     const std::vector<double> &volumes,
                                     const std::vector<double> &damage)
  {
    const BSplineKernel<dim>            kernel(space->degree());
    const unsigned int                  n = kernel.n_functions();
    const FunctionDirectory<dim, Sums>  directory(space->communicator());
    std::array<double, BSplineKernel<dim>::max_n_functions> B;

    // The mean damage of the functions, from values at the points. The third
    // time, the means themselves are what we are after.
    std::vector<double> values = damage;
    for (unsigned int pass = 0; pass < 3; ++pass)
      {
        typename FunctionDirectory<dim, Sums>::Table sums;
        for (const unsigned int c : active_cells)
          {
            const auto &cell = points.cells()[c];
            std::array<double, BSplineKernel<dim>::max_n_functions> volume{},
              value{};
            for (unsigned int q = cell.begin; q < cell.end; ++q)
              {
                kernel.values(points.unit_point(q), B.data());
                for (unsigned int i = 0; i < n; ++i)
                  {
                    volume[i] += B[i] * volumes[q];
                    value[i] += B[i] * volumes[q] * values[q];
                  }
              }
            for (unsigned int i = 0; i < n; ++i)
              {
                Sums &sum =
                  sums[space->cell_function(cell.index, cell.level, i)];
                sum.volume += volume[i];
                sum.value += value[i];
                sum.owner = my_rank;
              }
          }
        sums = directory.reduce(sums, [](Sums a, const Sums &b) {
          a.volume += b.volume;
          a.value += b.value;
          a.owner = std::min(a.owner, b.owner);
          return a;
        });

        if (pass < 2)
          for (const unsigned int c : active_cells)
            {
              const auto &cell = points.cells()[c];
              std::array<double, BSplineKernel<dim>::max_n_functions> means;
              for (unsigned int i = 0; i < n; ++i)
                {
                  const Sums &sum =
                    sums.at(space->cell_function(cell.index, cell.level, i));
                  means[i] = sum.value / sum.volume;
                }
              for (unsigned int q = cell.begin; q < cell.end; ++q)
                {
                  kernel.values(points.unit_point(q), B.data());
                  values[q] = 0.;
                  for (unsigned int i = 0; i < n; ++i)
                    values[q] += B[i] * means[i];
                }
            }
        else
          for (const auto &entry : sums)
            {
              FunctionData function;
              function.damage = entry.second.value / entry.second.volume;
              function.owner  = entry.second.owner;
              table.emplace(entry.first, function);
            }
      }
  }



  template <int dim>
  void
  CrackPartition<dim>::find_ridge()
  {
    std::vector<Key> centers;
    for (const auto &entry : table)
      centers.push_back(entry.first);
    const DataTable around = surroundings(centers, data.ridge_radius);

    for (auto &entry : table)
      {
        const double h =
          space->lattice().cell_extents(entry.first.level)[0];
        const Point<dim> x =
          space->lattice().greville_point(entry.first, space->degree());
        FunctionData &function = entry.second;

        // The functions of the ball, with their positions and damage.
        double maximum = 0.;
        std::vector<std::pair<Tensor<1, dim>, double>> ball;
        for_each_neighbour(
          entry.first, data.ridge_radius, [&](const Key &key) {
            const auto found = around.find(key);
            if (found == around.end())
              return;
            const Tensor<1, dim> offset =
              space->lattice().greville_point(key, space->degree()) - x;
            if (offset.norm() > data.ridge_radius * h * (1. + 1e-6))
              return;
            ball.emplace_back(offset, found->second.damage);
            maximum = std::max(maximum, found->second.damage);
          });
        function.ridge_damage = maximum;
        if (maximum < data.closure_damage)
          continue;

        // Moments of what rises above the foot of the ridge.
        double                  weight = 0.;
        Tensor<1, dim>          first;
        SymmetricTensor<2, dim> second;
        for (const auto &member : ball)
          {
            // Squared, so that the crest counts more than the flanks, also
            // where the ridge is a plateau.
            const double rise =
              std::max(0., member.second - ridge_fraction * maximum);
            const double w = rise * rise;
            weight += w;
            first += w * member.first;
            second += w * symmetrize(outer_product(member.first, member.first));
          }
        const Tensor<1, dim>          mean = first / weight;
        const SymmetricTensor<2, dim> variance =
          second / weight - symmetrize(outer_product(mean, mean));

        // Eigenvalues come in descending order.
        const auto   axes = eigenvectors(variance);
        const double next = axes[dim - 2].first;
        function.variance_ratio =
          next > 0. ? std::max(axes[dim - 1].first, 0.) / next : 1.;
        function.normal   = to_array(canonical(axes[dim - 1].second));
        function.centroid = to_array(Tensor<1, dim>(x + mean));
      }
  }



  template <int dim>
  void
  CrackPartition<dim>::label_points(const CellPoints<dim> &points,
                                    CrackLabels<dim> &     labels) const
  {
    for (const auto &cell : points.cells())
      for (unsigned int q = cell.begin; q < cell.end; ++q)
        {
          if (labels.frozen[q])
            continue;
          labels.side[q] = Tensor<1, dim>();
          const auto found =
            table.find(nearest_function(cell, points.unit_point(q)));
          if (found == table.end() ||
              found->second.ridge_damage < data.closure_damage)
            continue;

          const double h = space->lattice().cell_extents(cell.level)[0];
          const auto   n = to_tensor(found->second.normal);
          const double distance =
            (to_tensor(found->second.centroid) - points.location(q)) * n;
          labels.side[q] = (distance > -tie * h) ? n : -n;
        }
  }



  template <int dim>
  void
  CrackPartition<dim>::find_sides(const CellPoints<dim> &    points,
                                  const std::vector<double> &volumes,
                                  const CrackLabels<dim> &   labels)
  {
    const BSplineKernel<dim>           kernel(space->degree());
    const unsigned int                 n = kernel.n_functions();
    const FunctionDirectory<dim, Sums> directory(space->communicator());
    std::array<double, BSplineKernel<dim>::max_n_functions> B;

    typename FunctionDirectory<dim, Sums>::Table sums;
    for (const unsigned int c : active_cells)
      {
        const auto &cell = points.cells()[c];
        std::array<Sums, BSplineKernel<dim>::max_n_functions> local{};
        for (unsigned int q = cell.begin; q < cell.end; ++q)
          {
            kernel.values(points.unit_point(q), B.data());
            for (unsigned int i = 0; i < n; ++i)
              {
                local[i].volume += B[i] * volumes[q] * labels.side[q].norm();
                const Tensor<1, dim> axis = canonical(labels.side[q]);
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    local[i].vector[d] += B[i] * volumes[q] * labels.side[q][d];
                    local[i].axis[d] += B[i] * volumes[q] * axis[d];
                  }
              }
          }
        for (unsigned int i = 0; i < n; ++i)
          {
            Sums &sum = sums[space->cell_function(cell.index, cell.level, i)];
            sum.volume += local[i].volume;
            for (unsigned int d = 0; d < dim; ++d)
              {
                sum.vector[d] += local[i].vector[d];
                sum.axis[d] += local[i].axis[d];
              }
          }
      }
    sums = directory.reduce(sums, [](Sums a, const Sums &b) {
      a.volume += b.volume;
      for (unsigned int d = 0; d < dim; ++d)
        {
          a.vector[d] += b.vector[d];
          a.axis[d] += b.axis[d];
        }
      return a;
    });

    for (auto &entry : table)
      {
        const Sums &         sum  = sums.at(entry.first);
        const Tensor<1, dim> mean = to_tensor(sum.vector);
        if (sum.volume == 0.)
          continue;
        // As much material on either side: go to the fixed one.
        // (Points next to a slit have sides before there is a ridge.)
        const Tensor<1, dim> axis = to_tensor(sum.axis);
        const Tensor<1, dim> side =
          mean.norm() > tie * sum.volume ? mean / mean.norm() :
          axis.norm() > tie * sum.volume ? axis / axis.norm() :
                                           to_tensor(entry.second.normal);
        entry.second.side         = to_array(side);
      }
  }



  template <int dim>
  void
  CrackPartition<dim>::find_separable(const CellPoints<dim> & points,
                                      const CrackLabels<dim> &labels)
  {
    // Points see functions beyond those of their own cell: up to two cells
    // ahead of the function, half a support is not enough.
    constexpr int    ring = 1;
    std::vector<Key> centers;
    for (const auto &entry : table)
      centers.push_back(entry.first);
    const DataTable around = surroundings(centers, ring);

    // The damage met in the strip, or, where there is no material in the strip
    // because the function is outside of the body, in the whole support.
    struct Met
    {
      double in_strip   = -1.;
      double in_support = 0.;
    };
    typename FunctionDirectory<dim, Met>::Table ahead;
    const int                                   p = space->degree();
    for (const unsigned int c : active_cells)
      {
        const auto &       cell  = points.cells()[c];
        const double       h     = space->lattice().cell_extents(cell.level)[0];
        const unsigned int width = p + 1 + 2 * ring;
        const unsigned int n     = Utilities::pow(width, dim);
        for (unsigned int i = 0; i < n; ++i)
          {
            Key key = space->cell_function(cell.index, cell.level, 0);
            for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= width)
              key.index[d] += static_cast<int>(rest % width) - ring;
            const auto found = around.find(key);
            if (found == around.end())
              continue;
            const Tensor<1, dim> m = to_tensor(found->second.side);
            if (m.norm_square() == 0.)
              continue;

            const Point<dim> x =
              space->lattice().greville_point(key, space->degree());
            Met met;
            for (unsigned int q = cell.begin; q < cell.end; ++q)
              {
                const Tensor<1, dim> offset = points.location(q) - x;
                const double         along  = offset * m;
                if (along < -(1. + tie) * h || along > (2. + tie) * h)
                  continue;
                const double across = (offset - along * m).norm();
                if (across < strip * h)
                  met.in_strip = std::max(met.in_strip, labels.peak_damage[q]);
                if (across < (0.5 * (p + 1) + tie) * h)
                  met.in_support =
                    std::max(met.in_support, labels.peak_damage[q]);
              }
            Met &total       = ahead[key];
            total.in_strip   = std::max(total.in_strip, met.in_strip);
            total.in_support = std::max(total.in_support, met.in_support);
          }
      }

    // Ask for the result for all functions that we see, whether or not we had
    // something to say about them.
    for (const auto &entry : table)
      ahead.emplace(entry.first, Met());
    const FunctionDirectory<dim, Met> directory(space->communicator());
    ahead = directory.reduce(ahead, [](Met a, const Met &b) {
      a.in_strip   = std::max(a.in_strip, b.in_strip);
      a.in_support = std::max(a.in_support, b.in_support);
      return a;
    });
    for (auto &entry : table)
      {
        const Met &met = ahead.at(entry.first);
        entry.second.damage_ahead =
          met.in_strip >= 0. ? met.in_strip : met.in_support;
        entry.second.separable =
          entry.second.damage_ahead > data.damage_threshold;
      }
  }



  template <int dim>
  void
  CrackPartition<dim>::close_gaps()
  {
    std::vector<Key> candidates;
    for (const auto &entry : table)
      if (!entry.second.separable &&
          entry.second.damage_ahead > data.closure_damage)
        candidates.push_back(entry.first);
    const DataTable around = surroundings(candidates, closure_reach);

    // Which of the others exist at all.
    std::vector<Key> unknown;
    for (const auto &key : candidates)
      for_each_neighbour(key, closure_reach, [&](const Key &other) {
        if (around.find(other) == around.end())
          unknown.push_back(other);
      });
    std::sort(unknown.begin(), unknown.end());
    unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
    const auto sound = space->query(unknown);

    std::vector<Key> closed;
    for (const auto &key : candidates)
      {
        const Tensor<1, dim> m = to_tensor(table.at(key).side);
        if (m.norm_square() == 0.)
          continue;
        const double     h = space->lattice().cell_extents(key.level)[0];
        const Point<dim> x =
          space->lattice().greville_point(key, space->degree());

        // What lies along the ridge: separable functions, and the outside.
        std::vector<Tensor<1, dim>> separable, outside;
        for_each_neighbour(key, closure_reach, [&](const Key &other) {
          const Tensor<1, dim> offset =
            space->lattice().greville_point(other, space->degree()) - x;
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
            }
          else if (std::abs(along) < (0.5 + tie) * h &&
                   sound.find(other) == sound.end())
            outside.push_back(across / across.norm());
        });

        bool between = false;
        for (const auto &a : separable)
          {
            for (const auto &b : separable)
              between = between || a * b < -0.7;
            for (const auto &b : outside)
              between = between || a * b < -0.7;
          }
        if (between)
          closed.push_back(key);
      }
    for (const auto &key : closed)
      table[key].separable = true;
  }



  template <int dim>
  bool
  CrackPartition<dim>::make_patterns(const CellPoints<dim> &points,
                                     CrackLabels<dim> &     labels,
                                     std::vector<Pattern> & patterns) const
  {
    std::vector<Pattern> result(points.n_points(), 0);
    const unsigned int   n = space->n_functions_per_cell();
    for (const auto &cell : points.cells())
      {
        std::array<const FunctionData *, BSplineKernel<dim>::max_n_functions>
             functions{};
        bool any = false;
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto found =
              table.find(space->cell_function(cell.index, cell.level, i));
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
                const auto found =
                  table.find(nearest_function(cell, points.unit_point(q)));
                labels.frozen[q] =
                  found != table.end() &&
                  found->second.variance_ratio < data.frozen_ratio;
              }
          }
      }
    const bool changed = (result != patterns);
    patterns.swap(result);
    return changed;
  }



  template <int dim>
  typename CrackPartition<dim>::DataTable
  CrackPartition<dim>::surroundings(const std::vector<Key> &centers,
                                    const int               radius) const
  {
    // Publish what we own, and ask for what we do not see ourselves.
    FunctionDirectory<dim, FunctionData> directory(space->communicator());
    std::vector<typename FunctionDirectory<dim, FunctionData>::Entry> mine;
    for (const auto &entry : table)
      if (entry.second.owner == my_rank)
        mine.push_back({entry.first, entry.second});
    directory.publish(mine);

    std::vector<Key> wanted;
    for (const auto &center : centers)
      for_each_neighbour(center, radius, [&](const Key &key) {
        if (table.find(key) == table.end())
          wanted.push_back(key);
      });
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());

    DataTable result = directory.query(wanted);
    result.insert(table.begin(), table.end());
    return result;
  }



  template <int dim>
  typename CrackPartition<dim>::Key
  CrackPartition<dim>::nearest_function(
    const typename CellPoints<dim>::Cell &cell,
    const Point<dim> &                    unit_point) const
  {
    // Greville points are cell centres for even degrees, vertices for odd ones.
    const int p      = space->degree();
    Key       result = space->cell_function(cell.index, cell.level, 0);
    for (unsigned int d = 0; d < dim; ++d)
      result.index[d] +=
        (p % 2 == 0) ? p / 2 : p / 2 + (unit_point[d] < 0.5 ? 0 : 1);
    return result;
  }



  template <int dim>
  const std::vector<typename CrackPartition<dim>::Pattern> &
  CrackPartition<dim>::patterns() const
  {
    return point_patterns;
  }



  template <int dim>
  const std::vector<typename CrackPartition<dim>::Pattern> &
  CrackPartition<dim>::boundary_patterns() const
  {
    return boundary_point_patterns;
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
