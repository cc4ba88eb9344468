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
#include <ebsmpm/fracture/damage_ridge.h>
#include <ebsmpm/fracture/lattice_neighbours.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace EBSMPM
{
  namespace internal
  {
    namespace DamageRidgeImplementation
    {
      /** Part of the local maximum above which the ridge begins. */
      constexpr double ridge_fraction = 0.75;

      /** Smallest variance of a ball, over the square of its radius. */
      constexpr double least_ball_variance = 1e-3;



      /** The variance of positions with moments of order 0 to 2. */
      template <int dim>
      SymmetricTensor<2, dim>
      variance(const double                   weight,
               const Tensor<1, dim>          &first,
               const SymmetricTensor<2, dim> &second)
      {
        const Tensor<1, dim> mean = first / weight;
        return second / weight - symmetrize(outer_product(mean, mean));
      }
    } // namespace DamageRidgeImplementation
  }   // namespace internal

  using namespace internal::DamageRidgeImplementation;
  using namespace CrackDirections;



  template <int dim>
  DamageRidge<dim>::DamageRidge(const SplineSpace<dim> &space,
                                const double            minimum_damage,
                                const int               radius)
    : space(&space)
    , minimum_damage(minimum_damage)
    , radius(radius)
  {}



  template <int dim>
  void
  DamageRidge<dim>::clear()
  {
    functions.clear();
  }



  template <int dim>
  void
  DamageRidge<dim>::smooth_damage(const CellPoints<dim>           &points,
                                  const std::vector<unsigned int> &cells,
                                  const std::vector<double>       &volumes,
                                  const std::vector<double>       &damage)
  {
    // The mean damage of the functions, from values at the points. The third
    // time, the means themselves are what we are after.
    std::vector<double> values = damage;
    for (unsigned int pass = 0; pass < 2; ++pass)
      evaluate_means(points,
                     cells,
                     sum_up(points, cells, volumes, values),
                     values);

    functions.clear();
    for (const auto &entry : sum_up(points, cells, volumes, values))
      {
        FunctionData function;
        function.damage = entry.second.value / entry.second.volume;
        function.owner  = entry.second.owner;
        functions.emplace(entry.first, function);
      }
  }



  template <int dim>
  typename DamageRidge<dim>::SumTable
  DamageRidge<dim>::sum_up(const CellPoints<dim>           &points,
                           const std::vector<unsigned int> &cells,
                           const std::vector<double>       &volumes,
                           const std::vector<double>       &values) const
  {
    const BSplineKernel<dim> kernel(space->degree());
    const unsigned int       n            = kernel.n_functions();
    const MPI_Comm          &communicator = space->communicator();
    const unsigned int my_rank = Utilities::MPI::this_mpi_process(communicator);
    std::array<double, BSplineKernel<dim>::max_n_functions> B;

    SumTable sums;
    for (const unsigned int c : cells)
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
            Sums &sum = sums[space->cell_function(cell.index, cell.level, i)];
            sum.volume += volume[i];
            sum.value += value[i];
            sum.owner = my_rank;
          }
      }

    const FunctionDirectory<dim, Sums> directory(communicator);
    return directory.reduce(sums, [](Sums a, const Sums &b) {
      a.volume += b.volume;
      a.value += b.value;
      a.owner = std::min(a.owner, b.owner);
      return a;
    });
  }



  template <int dim>
  void
  DamageRidge<dim>::evaluate_means(const CellPoints<dim>           &points,
                                   const std::vector<unsigned int> &cells,
                                   const SumTable                  &sums,
                                   std::vector<double> &values) const
  {
    const BSplineKernel<dim> kernel(space->degree());
    const unsigned int       n = kernel.n_functions();
    std::array<double, BSplineKernel<dim>::max_n_functions> B, means;

    for (const unsigned int c : cells)
      {
        const auto &cell = points.cells()[c];
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
  }



  template <int dim>
  void
  DamageRidge<dim>::find()
  {
    std::vector<Key> centers;
    for (const auto &entry : functions)
      centers.push_back(entry.first);
    const Table around =
      surroundings(functions, centers, radius, space->communicator());

    for (auto &entry : functions)
      {
        FunctionData &function = entry.second;
        const Ball    members  = ball(entry.first, around);

        function.ridge_damage = 0.;
        for (const auto &member : members)
          function.ridge_damage =
            std::max(function.ridge_damage, member.second);
        if (function.ridge_damage >= minimum_damage)
          find_axes(entry.first, members, function);
      }
    look_from_crest();
    add_shared_functions(*space, functions);
  }



  template <int dim>
  void
  DamageRidge<dim>::look_from_crest()
  {
    std::vector<Key> centers;
    for (const auto &entry : functions)
      if (entry.second.ridge_damage >= minimum_damage)
        centers.push_back(entry.first);
    const Table around =
      surroundings(functions, centers, radius, space->communicator());

    for (const Key &key : centers)
      {
        FunctionData &function = functions.at(key);
        const auto    crest    = around.find(space->lattice().nearest_function(
          Point<dim>(to_tensor(function.centroid)),
          key.level,
          space->degree()));
        if (crest == around.end() ||
            crest->second.ridge_damage < minimum_damage)
          {
            function.variance_ratio = 1.;
            continue;
          }
        function.variance_ratio = crest->second.variance_ratio;
        function.least_variance = crest->second.least_variance;
        function.normal         = crest->second.normal;
        function.centroid       = crest->second.centroid;
      }
  }



  template <int dim>
  typename DamageRidge<dim>::Ball
  DamageRidge<dim>::ball(const Key &center, const Table &around) const
  {
    const double     h = space->lattice().cell_extents(center.level)[0];
    const Point<dim> x =
      space->lattice().greville_point(center, space->degree());

    Ball result;
    for_each_neighbour(center, radius, [&](const Key &key) {
      const auto found = around.find(key);
      if (found == around.end())
        return;
      const Tensor<1, dim> offset =
        space->lattice().greville_point(key, space->degree()) - x;
      if (offset.norm() > radius * h * (1. + 1e-6))
        return;
      result.emplace_back(offset, found->second.damage);
    });
    return result;
  }



  template <int dim>
  void
  DamageRidge<dim>::find_axes(const Key    &center,
                              const Ball   &ball,
                              FunctionData &function) const
  {
    // Moments of what rises above the foot of the ridge, and of everything.
    double                  weight = 0.;
    Tensor<1, dim>          first, ball_first;
    SymmetricTensor<2, dim> second, ball_second;
    for (const auto &member : ball)
      {
        // Squared, so that the crest counts more than the flanks, also where
        // the ridge is a plateau.
        const double rise =
          std::max(0., member.second - ridge_fraction * function.ridge_damage);
        const double w = rise * rise;
        const auto   square =
          symmetrize(outer_product(member.first, member.first));
        weight += w;
        first += w * member.first;
        second += w * square;
        ball_first += member.first;
        ball_second += square;
      }
    const auto   ridge = variance(weight, first, second);
    const double r = radius * space->lattice().cell_extents(center.level)[0];

    // In coordinates in which the variance of the ball is one, the axes are
    // eigenvectors. Eigenvalues come in descending order.
    SymmetricTensor<2, dim> scaling;
    for (const auto &axis :
         eigenvectors(variance<dim>(ball.size(), ball_first, ball_second)))
      scaling += 1. /
                 std::sqrt(std::max(axis.first, least_ball_variance * r * r)) *
                 symmetrize(outer_product(axis.second, axis.second));
    const auto axes =
      eigenvectors(symmetrize(Tensor<2, dim>(scaling) * Tensor<2, dim>(ridge) *
                              Tensor<2, dim>(scaling)));
    const double         next  = axes[dim - 2].first;
    const double         least = std::max(axes[dim - 1].first, 0.);
    const Tensor<1, dim> n     = scaling * axes[dim - 1].second;
    const Point<dim>     x =
      space->lattice().greville_point(center, space->degree());

    function.variance_ratio = next > 0. ? least / next : 1.;
    function.normal         = to_array(canonical(Tensor<1, dim>(n / n.norm())));
    function.least_variance =
      std::max(n * ridge * n, 0.) / (n.norm_square() * r * r);
    function.centroid = to_array(Tensor<1, dim>(x + first / weight));
  }



  template <int dim>
  const typename DamageRidge<dim>::Table &
  DamageRidge<dim>::table() const
  {
    return functions;
  }



  template <int dim>
  const typename DamageRidge<dim>::FunctionData *
  DamageRidge<dim>::nearest(const typename CellPoints<dim>::Cell &cell,
                            const Point<dim> &unit_point) const
  {
    // Greville points are cell centres for even degrees, vertices for odd ones.
    const int p   = space->degree();
    Key       key = space->cell_function(cell.index, cell.level, 0);
    for (unsigned int d = 0; d < dim; ++d)
      key.index[d] +=
        (p % 2 == 0) ? p / 2 : p / 2 + (unit_point[d] < 0.5 ? 0 : 1);
    const auto found = functions.find(key);
    return found == functions.end() ? nullptr : &found->second;
  }



  template <int dim>
  Tensor<1, dim>
  DamageRidge<dim>::side_vector(const typename CellPoints<dim>::Cell &cell,
                                const Point<dim> &unit_point,
                                const Point<dim> &location) const
  {
    const FunctionData *function = nearest(cell, unit_point);
    if (function == nullptr || function->ridge_damage < minimum_damage)
      return Tensor<1, dim>();

    const double h        = space->lattice().cell_extents(cell.level)[0];
    const auto   n        = to_tensor(function->normal);
    const double distance = (to_tensor(function->centroid) - location) * n;
    return (distance > -tie * h) ? n : -n;
  }



  template class DamageRidge<2>;
  template class DamageRidge<3>;
} // namespace EBSMPM
