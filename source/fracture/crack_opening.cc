// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/bspline_kernel.h>

#include <ebsmpm/fracture/crack_opening.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <limits>

namespace EBSMPM
{
  namespace internal
  {
    namespace CrackOpeningImplementation
    {
      /** Part of a cell that must be filled on either side. */
      constexpr double least_fraction = 0.05;

      /** Sums over the points of one side of a function. */
      template <int dim>
      struct Side
      {
        double                        volume = 0.;
        std::array<double, dim>       x{};
        std::array<double, dim>       X{};
        std::array<double, dim * dim> F{};

        Side &
        operator+=(const Side &other)
        {
          volume += other.volume;
          for (unsigned int d = 0; d < dim; ++d)
            {
              x[d] += other.x[d];
              X[d] += other.X[d];
            }
          for (unsigned int k = 0; k < dim * dim; ++k)
            F[k] += other.F[k];
          return *this;
        }
      };

      /** The own side of a function, and the other one. */
      template <int dim>
      using Sides = std::array<Side<dim>, 2>;



      /** The opening $g_I$. */
      template <int dim>
      double
      opening(const Sides<dim> &sides, const Tensor<1, dim> &m)
      {
        Tensor<1, dim> x, X, M;
        for (unsigned int d = 0; d < dim; ++d)
          {
            x[d] =
              sides[1].x[d] / sides[1].volume - sides[0].x[d] / sides[0].volume;
            X[d] =
              sides[1].X[d] / sides[1].volume - sides[0].X[d] / sides[0].volume;
            for (unsigned int e = 0; e < dim; ++e)
              M[d] +=
                (sides[0].F[dim * e + d] + sides[1].F[dim * e + d]) * m[e];
          }
        return x * m - X * M / M.norm();
      }
    } // namespace CrackOpeningImplementation
  }   // namespace internal

  using namespace internal::CrackOpeningImplementation;



  template <int dim>
  CrackOpening
  crack_opening(const CellPoints<dim>             &points,
                const CrackPartition<dim>         &partition,
                const std::vector<double>         &volumes,
                const std::vector<Tensor<1, dim>> &displacements,
                const std::vector<Tensor<1, dim>> &increments,
                const std::vector<Tensor<2, dim>> &F)
  {
    const auto              &space = partition.space();
    const BSplineKernel<dim> kernel(space.degree());
    const unsigned int       n = kernel.n_functions();
    std::array<double, BSplineKernel<dim>::max_n_functions> B;

    const FunctionDirectory<dim, Sides<dim>> directory(space.communicator());
    typename FunctionDirectory<dim, Sides<dim>>::Table table;
    for (const auto &cell : points.cells())
      {
        // The separable functions of the cell, and where they are.
        std::array<Sides<dim> *, BSplineKernel<dim>::max_n_functions> sides{};
        std::array<Point<dim>, BSplineKernel<dim>::max_n_functions>   origins;
        bool any = false;
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto key = space.cell_function(cell.index, cell.level, i);
            if (partition.side_of(key).norm_square() == 0.)
              continue;
            sides[i]   = &table[key];
            origins[i] = space.lattice().greville_point(key, space.degree());
            any        = true;
          }
        if (!any)
          continue;

        const double h = space.lattice().cell_extents(cell.level)[0];
        for (unsigned int q = cell.begin; q < cell.end; ++q)
          {
            kernel.values(points.unit_point(q), B.data());
            for (unsigned int i = 0; i < n; ++i)
              if (sides[i] != nullptr)
                {
                  // Relative to the function, for the sake of roundoff.
                  const Tensor<1, dim> start = points.location(q) - origins[i];
                  const double         w =
                    B[i] * volumes[q] / Utilities::fixed_power<dim>(h);
                  const unsigned int other = (partition.patterns()[q] >> i) & 1;
                  Side<dim>         &side  = (*sides[i])[other];
                  side.volume += w;
                  for (unsigned int d = 0; d < dim; ++d)
                    {
                      side.x[d] += w * (start[d] + increments[q][d]);
                      side.X[d] += w * (start[d] - displacements[q][d]);
                      for (unsigned int e = 0; e < dim; ++e)
                        side.F[dim * d + e] += w * F[q][d][e];
                    }
                }
          }
      }
    table = directory.reduce(table, [](Sides<dim> a, const Sides<dim> &b) {
      a[0] += b[0];
      a[1] += b[1];
      return a;
    });

    constexpr double none     = std::numeric_limits<double>::max();
    double           smallest = none;
    for (const auto &entry : table)
      if (entry.second[0].volume > least_fraction &&
          entry.second[1].volume > least_fraction)
        smallest =
          std::min(smallest,
                   opening(entry.second, partition.side_of(entry.first)));

    // A function on a border between processes counts more than once, which is
    // of no consequence for the smallest opening.
    CrackOpening result;
    result.smallest = Utilities::MPI::min(smallest, space.communicator());
    if (result.smallest == none)
      result.smallest = 0.;
    return result;
  }



  template CrackOpening
  crack_opening<2>(const CellPoints<2> &,
                   const CrackPartition<2> &,
                   const std::vector<double> &,
                   const std::vector<Tensor<1, 2>> &,
                   const std::vector<Tensor<1, 2>> &,
                   const std::vector<Tensor<2, 2>> &);
  template CrackOpening
  crack_opening<3>(const CellPoints<3> &,
                   const CrackPartition<3> &,
                   const std::vector<double> &,
                   const std::vector<Tensor<1, 3>> &,
                   const std::vector<Tensor<1, 3>> &,
                   const std::vector<Tensor<2, 3>> &);
} // namespace EBSMPM
