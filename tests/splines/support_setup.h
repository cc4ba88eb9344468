// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_tests_splines_support_setup_h
#define ebsmpm_tests_splines_support_setup_h

// A ball, as midpoints of a lattice in each cell, and what it says about the
// functions. Nothing of the particles is needed.

#include <ebsmpm/splines/bspline_kernel.h>
#include <ebsmpm/splines/spline_space.h>

#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <array>
#include <vector>

using namespace dealii;
using namespace EBSMPM;

constexpr unsigned int n_midpoints = 4;



/** The points of a ball in a cell, in unit coordinates. */
template <int dim>
std::vector<Point<dim>>
ball_points(const typename Triangulation<dim>::cell_iterator &cell,
            const Point<dim>                                 &center,
            const double                                      radius)
{
  const Point<dim> lower = cell->vertex(0);
  const Point<dim> upper =
    cell->vertex(GeometryInfo<dim>::vertices_per_cell - 1);
  std::vector<Point<dim>> result;
  for (unsigned int i = 0; i < Utilities::pow(n_midpoints, dim); ++i)
    {
      Point<dim> xi, x;
      for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n_midpoints)
        {
          xi[d] = (rest % n_midpoints + 0.5) / n_midpoints;
          x[d]  = lower[d] + xi[d] * (upper[d] - lower[d]);
        }
      if (x.distance(center) < radius)
        result.push_back(xi);
    }
  return result;
}



/** What these points say about the functions. */
template <int dim>
typename SplineSpace<dim>::SupportTable
ball_supports(const Triangulation<dim> &triangulation,
              const SplineSpace<dim>   &space,
              const Point<dim>         &center,
              const double              radius)
{
  typename SplineSpace<dim>::SupportTable supports;
  const BSplineKernel<dim>                kernel(space.degree());
  std::array<double, BSplineKernel<dim>::max_n_functions> B;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const auto &xi : ball_points<dim>(cell, center, radius))
        {
          kernel.values(xi, B.data());
          for (unsigned int i = 0; i < kernel.n_functions(); ++i)
            supports[space.cell_function(
                       space.lattice().cell_index(cell), cell->level(), i)]
              .fraction += B[i] / Utilities::pow(n_midpoints, dim);
        }
  return supports;
}

#endif
