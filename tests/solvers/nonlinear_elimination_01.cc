// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// NonlinearElimination takes a disturbance of a few coefficients back, also if
// they belong to several processes, and does nothing if they are many; it never
// makes a guess worse. What it assembles for that is right in the rows it asks
// for.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/solvers/nonlinear_elimination.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include "../tests.h"

#include "../assembly/point_setup.h"



template <int dim>
void
test(const unsigned int n_cells)
{
  deallog << dim << "-D" << std::endl;
  const double                              h = 1. / n_cells;
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, n_cells + 2, -h, 1. + h);
  Point<dim> corner;
  for (unsigned int d = 0; d < dim; ++d)
    corner[d] = 1.;
  BodyOnGrid<dim> body(triangulation, BoxBody<dim>(Point<dim>(), corner), 2, 2);
  body.make_space(0.1);
  const auto              material = make_material<dim>("neo-Hookean",
                                           EnergySplit::volumetric_deviatoric,
                                           175.,
                                           80.);
  const Degradation       degradation(1e-4);
  DisplacementSystem<dim> system(*material, degradation, 1e5);
  body.reinit(system);

  // The solution is zero. A few functions in the middle, where processes meet,
  // have other coefficients.
  Point<dim> middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = 0.5;
  const auto disturbed = [&](const double amplitude) {
    LA::FieldVector x = system.make_vector();
    body.set_coefficients(x,
                          dim,
                          [&](const FunctionKey<dim> &,
                              const Point<dim>  &greville,
                              const unsigned int a) {
                            return greville.distance(middle) < 1.2 * h ?
                                     amplitude * h * scatter(greville, a) :
                                     0.;
                          });
    return x;
  };
  LA::FieldVector residual = system.make_vector();
  const auto      norm     = [&](const LA::FieldVector &x) {
    system.assemble_residual(body.state, body.boundary, x, residual);
    return residual.l2_norm();
  };

  LA::FieldVector x       = disturbed(0.1);
  const double    initial = norm(x);

  // In part: functions in the right half, on all processes that know them.
  LA::FieldVector marks = system.make_vector();
  body.set_coefficients(marks,
                        dim,
                        [&](const FunctionKey<dim> &,
                            const Point<dim> &greville,
                            const unsigned int) {
                          return greville[0] > 0.5 ? 1. : 0.;
                        });
  marks.update_ghost_values();
  const auto       &partitioner = *system.partitioner();
  std::vector<bool> functions(
    (partitioner.locally_owned_size() + partitioner.n_ghost_indices()) / dim);
  for (unsigned int f = 0; f < functions.size(); ++f)
    functions[f] = marks.local_element(dim * f) > 0.;
  LA::FieldVector v = system.make_vector(), Kv = v, part = v;
  body.scatter_coefficients(v, dim, 3);
  system.assemble_tangent(body.state, body.boundary, x, residual);
  system.matrix().vmult(Kv, v);
  system.assemble_tangent(body.state, body.boundary, disturbed(0.05), part);
  system.assemble_tangent(body.state, body.boundary, x, functions, part);
  LA::FieldVector part_of_Kv = system.make_vector();
  system.matrix().vmult(part_of_Kv, v);
  double       error  = 0.;
  unsigned int n_rows = 0;
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
    if (functions[i / dim])
      {
        ++n_rows;
        error = std::max(
          {error,
           std::abs(part.local_element(i) - residual.local_element(i)),
           std::abs(part_of_Kv.local_element(i) - Kv.local_element(i))});
      }
  part_of_Kv -= Kv;
  const double elsewhere = part_of_Kv.linfty_norm();
  deallog << "  assembly in some rows: "
          << verdict(Utilities::MPI::max(error, MPI_COMM_WORLD) /
                       Kv.linfty_norm(),
                     1e-12)
          << ", in all: " << (elsewhere > 0. ? "no" : "FAILED") << std::endl;

  typename NonlinearElimination<dim>::AdditionalData data;
  data.max_iterations             = 30;
  data.max_rows                   = 5000;
  const unsigned int n_iterations = NonlinearElimination<dim>(data).improve(
    system, body.state, body.boundary, x);
  deallog << "  residual below 1 %: "
          << (norm(x) < 0.0101 * initial ? "yes" : "FAILED") << ", iterations: "
          << (n_iterations > 0 && n_iterations < 30 ? "some" : "FAILED")
          << std::endl;

  data.max_rows           = 1;
  x                       = disturbed(0.1);
  LA::FieldVector old     = x;
  const bool      nothing = NonlinearElimination<dim>(data).improve(system,
                                                               body.state,
                                                               body.boundary,
                                                               x) == 0;
  x.zero_out_ghost_values();
  old -= x;
  deallog << "  nothing if there are many rows: "
          << (nothing && old.linfty_norm() == 0. ? "yes" : "FAILED")
          << std::endl;

  bool never_worse = true;
  for (const double amplitude : {0.02, 0.2, 0.4, 0.6, 0.8})
    try
      {
        x                   = disturbed(amplitude);
        const double before = norm(x);
        NonlinearElimination<dim>().improve(system,
                                            body.state,
                                            body.boundary,
                                            x);
        never_worse = never_worse && norm(x) <= before;
      }
    catch (const ExcSolverFailure &)
      {
        // The guess is turned inside out. We go on to the others.
      }
  deallog << "  never worse: " << (never_worse ? "yes" : "FAILED") << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();
  test<2>(16);
  test<3>(7);
}
