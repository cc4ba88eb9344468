// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The extension reproduces polynomials: with the coefficients of a polynomial
// of degree p in the independent functions, the field is that polynomial at all
// points, also where deficient functions contribute. And the splines layer is
// of use by itself: a projection onto the splines on a ball, with constraints,
// sparsity pattern and matrix as for any finite element of deal.II.

#include <ebsmpm/lac/types.h>

#include <ebsmpm/splines/bspline_kernel.h>
#include <ebsmpm/splines/extension.h>
#include <ebsmpm/splines/fe_bspline.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../tests.h"

#include "support_setup.h"
#include "verdict.h"

constexpr double radius = 0.81;



/** A polynomial of degree p in each coordinate. */
template <int dim>
double
polynomial(const Point<dim> &x, const unsigned int p)
{
  double result = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    result *= 1. + (0.5 + 0.2 * d) * x[d] + (0.8 - 0.3 * d) * std::pow(x[d], p);
  return result;
}



/**
 * Its coefficient: for each factor, the polar form at the p knots inside the
 * support of the function, where a monomial of degree p becomes the product of
 * the knots, and one of degree 1 their mean value.
 */
template <int dim>
double
coefficient(const FunctionKey<dim> &key, const SplineSpace<dim> &space)
{
  const unsigned int   p      = space.degree();
  const Tensor<1, dim> h      = space.lattice().cell_extents(key.level);
  double               result = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    {
      double mean = 0., product = 1.;
      for (unsigned int k = 1; k <= p; ++k)
        {
          const double knot =
            space.lattice().origin()[d] +
            (key.index[d] - static_cast<int>(p) + static_cast<int>(k)) * h[d];
          mean += knot / p;
          product *= knot;
        }
      result *= 1. + (0.5 + 0.2 * d) * mean + (0.8 - 0.3 * d) * product;
    }
  return result;
}



/** The indices of the functions that a cell sees. */
template <int dim>
std::vector<types::global_dof_index>
cell_indices(const SplineSpace<dim>                           &space,
             const typename Triangulation<dim>::cell_iterator &cell)
{
  std::vector<types::global_dof_index> indices;
  for (unsigned int i = 0; i < space.n_functions_per_cell(); ++i)
    indices.push_back(space
                        .find(space.cell_function(
                          space.lattice().cell_index(cell), cell->level(), i))
                        ->index);
  return indices;
}



/** A vector of the values of the independent functions, with ghost entries. */
template <int dim>
LA::FieldVector
make_field(const SplineSpace<dim>          &space,
           const AffineConstraints<double> &constraints)
{
  IndexSet relevant(space.n_independent());
  for (const auto &entry : space.functions())
    if (entry.second.index < space.n_independent())
      relevant.add_index(entry.second.index);
    else
      for (const auto &term :
           *constraints.get_constraint_entries(entry.second.index))
        relevant.add_index(term.first);
  return LA::FieldVector(space.locally_owned_independent(),
                         relevant,
                         space.communicator());
}



template <int dim>
void
test(const unsigned int degree)
{
  const MPI_Comm                            comm = MPI_COMM_WORLD;
  parallel::distributed::Triangulation<dim> triangulation(comm);
  GridGenerator::subdivided_hyper_cube(triangulation,
                                       dim == 2 ? 5 : 3 + degree,
                                       -1.,
                                       1.);
  triangulation.refine_global(dim == 2 ? 2 : 1);
  SplineSpace<dim> space(triangulation, degree);
  const auto       supports =
    ball_supports(triangulation, space, Point<dim>(), radius);
  space.reinit(supports, 0.1);
  AffineConstraints<double> constraints;
  const auto report = make_extension_constraints(space, constraints);

  deallog << dim << "-D, degree " << degree << ": " << space.n_functions()
          << " functions, " << space.n_deficient() << " deficient, "
          << report.n_lower_degree << " of lower degree, "
          << report.n_wrong_side << " wrong, Lebesgue constant "
          << digits(report.max_lebesgue, 5) << std::endl;

  // The coefficients of all functions, dependent ones by the constraints.
  LA::FieldVector field     = make_field(space, constraints);
  const auto      set_exact = [&](LA::FieldVector &field) {
    for (const auto &entry : space.functions())
      if (space.locally_owned_independent().size() > entry.second.index &&
          space.locally_owned().is_element(entry.second.index))
        field(entry.second.index) = coefficient(entry.first, space);
    field.update_ghost_values();
  };
  set_exact(field);

  double dependent = 0.;
  for (const auto &entry : space.functions())
    if (constraints.is_constrained(entry.second.index))
      {
        double value = 0.;
        for (const auto &term :
             *constraints.get_constraint_entries(entry.second.index))
          value += term.second * field(term.first);
        dependent = std::max(dependent,
                             std::abs(value - coefficient(entry.first, space)));
      }

  const BSplineKernel<dim> kernel(degree);
  const unsigned int       n = kernel.n_functions();
  std::vector<double>      B(n), c(n);
  const auto               error_of = [&](const LA::FieldVector &field) {
    double error = 0.;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto points = ball_points<dim>(cell, Point<dim>(), radius);
          if (points.empty())
            continue;
          const auto I = cell_indices(space, cell);
          constraints.get_dof_values(field, I.begin(), c.begin(), c.end());
          for (const auto &xi : points)
            {
              kernel.values(xi, B.data());
              double value = 0.;
              for (unsigned int i = 0; i < n; ++i)
                value += B[i] * c[i];
              Point<dim> x = cell->vertex(0);
              for (unsigned int d = 0; d < dim; ++d)
                x[d] += xi[d] * space.lattice().cell_extents(cell->level())[d];
              error = std::max(error, std::abs(value - polynomial(x, degree)));
            }
        }
    return Utilities::MPI::max(error, comm);
  };
  deallog << "  reproduction: coefficients "
          << verdict(Utilities::MPI::max(dependent, comm), 1e-11) << ", field "
          << verdict(error_of(field), 1e-12);

  // Project the polynomial, given at the points only.
  const IndexSet &rows          = space.locally_owned_independent();
  IndexSet        relevant_rows = rows;
  relevant_rows.add_indices(field.get_partitioner()->ghost_indices());
  DynamicSparsityPattern dsp(rows.size(), rows.size(), relevant_rows);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() &&
        !ball_points<dim>(cell, Point<dim>(), radius).empty())
      {
        const auto I = cell_indices(space, cell);
        constraints.add_entries_local_to_global(I, I, dsp, false);
      }
  SparsityTools::distribute_sparsity_pattern(dsp, rows, comm, relevant_rows);
  LA::SparseMatrix matrix;
  matrix.reinit(rows, rows, dsp, comm);

  LA::Vector rhs(rows, comm), solution(rows, comm);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const auto points = ball_points<dim>(cell, Point<dim>(), radius);
        if (points.empty())
          continue;
        FullMatrix<double> M(n, n);
        Vector<double>     f(n);
        for (const auto &xi : points)
          {
            kernel.values(xi, B.data());
            Point<dim> x = cell->vertex(0);
            for (unsigned int d = 0; d < dim; ++d)
              x[d] += xi[d] * space.lattice().cell_extents(cell->level())[d];
            for (unsigned int i = 0; i < n; ++i)
              {
                f(i) += B[i] * polynomial(x, degree);
                // Not M(i,j), which is slow in debug mode.
                double *row = &M(i, 0);
                for (unsigned int j = 0; j < n; ++j)
                  row[j] += B[i] * B[j];
              }
          }
        const auto I = cell_indices(space, cell);
        constraints.distribute_local_to_global(M, I, I, matrix);
        constraints.distribute_local_to_global(f, I, rhs, M);
      }
  matrix.compress(VectorOperation::add);
  rhs.compress(VectorOperation::add);

  SolverControl        control(3000, 1e-14 * rhs.l2_norm(), false, false);
  SolverCG<LA::Vector> cg(control);
  TrilinosWrappers::PreconditionJacobi jacobi;
  jacobi.initialize(matrix);
  cg.solve(matrix, solution, rhs, jacobi);

  LA::FieldVector projection = make_field(space, constraints);
  for (const auto i : rows)
    projection(i) = solution(i);
  projection.update_ghost_values();
  // Rows of zeros would be there if constrained functions were in the matrix.
  deallog << ", projection " << verdict(error_of(projection), 1e-9) << ", "
          << matrix.m() << " rows" << std::endl;

  // The same field, cell by cell, in a DoFHandler.
  const FE_BSpline<dim> fe(degree);
  DoFHandler<dim>       dof_handler(triangulation);
  dof_handler.distribute_dofs(fe);
  LA::FieldVector cell_wise(dof_handler.locally_owned_dofs(), comm);
  double          error = 0.;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const auto points = ball_points<dim>(cell, Point<dim>(), radius);
        if (points.empty())
          continue;
        std::vector<types::global_dof_index> dofs(n);
        cell->get_dof_indices(dofs);
        const auto I = cell_indices(space, cell);
        constraints.get_dof_values(field, I.begin(), c.begin(), c.end());
        for (unsigned int i = 0; i < n; ++i)
          cell_wise(dofs[i]) = c[i];

        const Quadrature<dim> quadrature(points);
        const MappingQ1<dim>  mapping;
        FEValues<dim>         values(mapping,
                             fe,
                             quadrature,
                             update_values | update_quadrature_points);
        values.reinit(cell);
        std::vector<double> u(points.size());
        values.get_function_values(cell_wise, u);
        for (unsigned int q = 0; q < points.size(); ++q)
          error =
            std::max(error,
                     std::abs(u[q] -
                              polynomial(values.quadrature_point(q), degree)));
      }
  deallog << "  in a DoFHandler "
          << verdict(Utilities::MPI::max(error, comm), 1e-12) << std::endl;
}



/** Small and thin bodies: lower degrees, and none at all. */
void
test_fallbacks()
{
  parallel::distributed::Triangulation<2> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 10, -1., 1.);
  for (const double size : {0.29, 0.19, 0.11})
    for (const double threshold : {0.1, 0.3, 0.999})
      {
        SplineSpace<2> space(triangulation, 2);
        space.reinit(
          ball_supports(triangulation, space, Point<2>(0.03, 0.01), size),
          threshold);
        AffineConstraints<double> constraints;
        deallog << "radius " << size << ", threshold " << threshold << ": "
                << space.n_functions() << " functions, "
                << space.n_independent() << " independent";
        try
          {
            const auto report = make_extension_constraints(space, constraints);
            double     error  = 0.;
            for (const auto &entry : space.functions())
              if (constraints.is_constrained(entry.second.index))
                {
                  double sum = -1.;
                  for (const auto &term :
                       *constraints.get_constraint_entries(entry.second.index))
                    sum += term.second;
                  error = std::max(error, std::abs(sum));
                }
            deallog << ", lower degree " << report.n_lower_degree
                    << ", nearest " << report.n_nearest << ", constants "
                    << verdict(Utilities::MPI::max(error, MPI_COMM_WORLD),
                               1e-12)
                    << std::endl;
          }
        catch (const ExcNoStandardFunction &exception)
          {
            // Everybody must be here: this does not return otherwise.
            const unsigned int n = Utilities::MPI::sum(1U, MPI_COMM_WORLD);
            deallog << ", nothing to extrapolate from, thrown by "
                    << (n == Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) ?
                          "all" :
                          "some")
                    << std::endl;
          }
      }
}



/**
 * A thin strip and a thick body, three cells apart, and a crack between them
 * that the functions of the strip know of, if @p with_sides. The thick body has
 * blocks of full degree, but beyond the crack.
 */
void
test_beyond_crack(const bool with_sides)
{
  parallel::distributed::Triangulation<2> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 16, 0., 16.);
  SplineSpace<2>                        space(triangulation, 2);
  typename SplineSpace<2>::SupportTable supports;
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      const double x        = cell->center()[0];
      const bool   in_strip = (x > 3. && x < 5.);
      if (!cell->is_locally_owned() || !(in_strip || x > 8.))
        continue;
      // The integrals of the splines over a cell.
      const std::array<double, 3> integral = {{1. / 6., 2. / 3., 1. / 6.}};
      for (unsigned int i = 0; i < 9; ++i)
        {
          auto &support = supports[space.cell_function(
            space.lattice().cell_index(cell), cell->level(), i)];
          support.fraction += integral[i % 3] * integral[i / 3];
          if (in_strip && with_sides)
            support.side = {{1., 0.}};
        }
    }
  space.reinit(supports, 0.3);
  AffineConstraints<double> constraints;
  const auto report = make_extension_constraints(space, constraints);

  unsigned int n_beyond = 0;
  const auto   greville = [&](const FunctionKey<2> &key) {
    return space.lattice().greville_point(key, 2)[0];
  };
  IndexSet in_strip(space.n_functions());
  for (const auto &entry : space.functions())
    if (greville(entry.first) < 6.)
      in_strip.add_index(entry.second.index);
  // What a process does not see of the strip, others do.
  const auto strips = Utilities::MPI::all_gather(MPI_COMM_WORLD, in_strip);
  for (const auto &other : strips)
    in_strip.add_indices(other);
  for (const auto &entry : space.functions())
    if (space.locally_owned().is_element(entry.second.index) &&
        constraints.is_constrained(entry.second.index) &&
        in_strip.is_element(entry.second.index))
      for (const auto &term :
           *constraints.get_constraint_entries(entry.second.index))
        if (!in_strip.is_element(term.first))
          {
            ++n_beyond;
            break;
          }
  deallog << "strip " << (with_sides ? "at a crack" : "without sides") << ": "
          << space.n_deficient() << " deficient, " << report.n_lower_degree
          << " of lower degree, " << report.n_wrong_side << " wrong, "
          << Utilities::MPI::sum(n_beyond, MPI_COMM_WORLD)
          << " from beyond the gap" << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  for (unsigned int degree = 1; degree <= 3; ++degree)
    {
      test<2>(degree);
      test<3>(degree);
    }
  test_fallbacks();
  test_beyond_crack(false);
  test_beyond_crack(true);
}
