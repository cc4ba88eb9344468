// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// FE_BSpline: partition of unity, agreement with BSplineKernel, continuity of
// all derivatives up to p-1 across cells under the numbering of SplineSpace,
// and use with deal.II's DoFHandler, FEValues and Mapping classes.

#include <ebsmpm/splines/bspline_kernel.h>
#include <ebsmpm/splines/fe_bspline.h>
#include <ebsmpm/splines/spline_space.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../tests.h"

#include "verdict.h"



/** All derivatives of the order 'order' of a function on the reference cell. */
template <int dim>
std::vector<double>
derivatives(const FE_BSpline<dim> &fe,
            const unsigned int     i,
            const Point<dim>      &x,
            const unsigned int     order)
{
  std::vector<double> result;
  if (order == 0)
    result.push_back(fe.shape_value(i, x));
  else
    for (unsigned int d = 0; d < dim; ++d)
      if (order == 1)
        result.push_back(fe.shape_grad(i, x)[d]);
      else
        for (unsigned int e = 0; e < dim; ++e)
          result.push_back(fe.shape_grad_grad(i, x)[d][e]);
  return result;
}



/** The largest jump of a derivative between two cells of a lattice. */
template <int dim>
double
jump(const FE_BSpline<dim>  &fe,
     const SplineSpace<dim> &space,
     const unsigned int      direction,
     const Point<dim>       &on_left_cell,
     const unsigned int      order)
{
  typename CartesianLattice<dim>::Index left{}, right{};
  right[direction]         = 1;
  Point<dim> on_right_cell = on_left_cell;
  on_right_cell[direction] = 0.;

  double             maximum = 0.;
  const unsigned int n       = space.n_functions_per_cell();
  for (unsigned int side = 0; side < 2; ++side)
    for (unsigned int i = 0; i < n; ++i)
      {
        // The derivative here, and that of the same function on the other
        // cell: zero if the other cell does not see it.
        const auto here =
          derivatives(fe, i, side == 0 ? on_left_cell : on_right_cell, order);
        std::vector<double> there(here.size(), 0.);
        const auto key = space.cell_function(side == 0 ? left : right, 0, i);
        for (unsigned int j = 0; j < n; ++j)
          if (space.cell_function(side == 0 ? right : left, 0, j) == key)
            there = derivatives(fe,
                                j,
                                side == 0 ? on_right_cell : on_left_cell,
                                order);
        for (unsigned int k = 0; k < here.size(); ++k)
          maximum = std::max(maximum, std::abs(here[k] - there[k]));
      }
  return maximum;
}



template <int dim>
void
test(const unsigned int degree)
{
  const FE_BSpline<dim>    fe(degree);
  const BSplineKernel<dim> kernel(degree);
  const unsigned int       n = fe.n_dofs_per_cell();
  AssertThrow(n == kernel.n_functions(), ExcInternalError());

  Triangulation<dim> triangulation;
  GridGenerator::subdivided_hyper_cube(triangulation, 2, 0., 0.5);
  DoFHandler<dim> dof_handler(triangulation);
  dof_handler.distribute_dofs(fe);
  deallog << fe.get_name() << ": " << n << " functions, "
          << dof_handler.n_dofs() << " of the DoFHandler" << std::endl;

  const QGauss<dim>          quadrature(3);
  const MappingQ1<dim>       mapping;
  FEValues<dim>              values(mapping,
                       fe,
                       quadrature,
                       update_values | update_gradients);
  constexpr unsigned int     stride = BSplineKernel<dim>::max_n_functions + 1;
  std::array<double, stride> B, B2;
  std::array<double, dim * stride> G;
  Tensor<1, dim>                   inverse_h;
  for (unsigned int d = 0; d < dim; ++d)
    inverse_h[d] = 4.;

  double unity = 0., difference = 0.;
  values.reinit(dof_handler.begin_active());
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      kernel.values(quadrature.point(q), B.data());
      kernel.values_and_gradients(
        quadrature.point(q), inverse_h, B2.data(), G.data(), stride);
      double         sum = -1.;
      Tensor<1, dim> gradient_sum;
      for (unsigned int i = 0; i < n; ++i)
        {
          sum += values.shape_value(i, q);
          gradient_sum += values.shape_grad(i, q);
          difference = std::max({difference,
                                 std::abs(B[i] - values.shape_value(i, q)),
                                 std::abs(B[i] - B2[i])});
          for (unsigned int d = 0; d < dim; ++d)
            difference = std::max(difference,
                                  std::abs(G[d * stride + i] -
                                           values.shape_grad(i, q)[d]));
        }
      unity = std::max({unity, std::abs(sum), gradient_sum.norm()});
    }
  deallog << "  partition of unity " << verdict(unity, 1e-13) << ", kernel "
          << verdict(difference, 1e-13);

  const SplineSpace<dim> space(triangulation, degree);
  for (unsigned int order = 0; order < degree + 1 && order < 3; ++order)
    {
      double maximum = 0.;
      for (unsigned int direction = 0; direction < dim; ++direction)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = d == direction ? 1. : 0.3 + 0.1 * d;
          maximum = std::max(maximum, jump(fe, space, direction, x, order));
        }
      deallog << ", derivative " << order << ' '
              << (order < degree ? "continuous " + verdict(maximum, 1e-13) :
                                   "jumps by " + digits(maximum, 4));
    }
  deallog << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  initlog();

  deallog << "middle of an interval:";
  for (unsigned int degree = 1; degree <= 3; ++degree)
    for (unsigned int i = 0; i <= degree; ++i)
      deallog << ' ' << FE_BSpline<1>(degree).shape_value(i, Point<1>(0.5));
  deallog << std::endl;

  for (unsigned int degree = 1; degree <= 3; ++degree)
    {
      test<1>(degree);
      test<2>(degree);
      test<3>(degree);
    }
}
