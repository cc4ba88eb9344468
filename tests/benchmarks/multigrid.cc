// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// How the iterations of CG with algebraic multigrid grow as the cells get
// smaller: the displacement of a block whose boundary, all of it prescribed by
// Nitsche's method, cuts the first cells such that 2 % of them is left. With
// the threshold 0.1 of the extension, and with none.
//
// Arguments: dimension (3), cells across the block for the coarsest grid (8),
// number of grids (3), and the method ("CG+AMG").

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/lac/linear_solver.h>

#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/assembly/displacement_system.h>
#include <ebsmpm/assembly/rigid_motions.h>

#include <ebsmpm/solvers/newton_solver.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "../assembly/point_setup.h"



/** Solve on one grid. Return the number of iterations. */
template <int dim>
unsigned int
run(const unsigned int  n_cells,
    const double        threshold,
    const std::string  &method,
    ConditionalOStream &out)
{
  const double                              h = 1. / n_cells;
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation,
                                       n_cells + 4,
                                       -1.98 * h,
                                       1. + 2.02 * h);
  Point<dim> upper;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = 1.;
  BodyOnGrid<dim> body(triangulation, BoxBody<dim>(Point<dim>(), upper), 2, 2);
  body.make_space(threshold);

  const auto material =
    make_material<dim>("linear elastic", EnergySplit::none, 175., 80.77);
  const Degradation       degradation(1e-4);
  DisplacementSystem<dim> system(*material,
                                 degradation,
                                 20. * material->nitsche_stiffness() / h);
  body.reinit(system);
  LA::FieldVector exact    = system.make_vector();
  LA::FieldVector residual = exact, solution = exact;
  body.scatter_coefficients(exact, dim);
  exact *= 1e-3;
  Timer assembly(MPI_COMM_WORLD, true);
  system.assemble_tangent(body.state, body.boundary, exact, residual);
  assembly.stop();

  LinearSolver::AdditionalData data;
  data.method = LinearSolver::method_from_name(method);
  LinearSolver solver(data);
  solver.set_block_size(dim);
  solver.set_near_null_space(
    RigidMotions::coefficients(body.space,
                               system.matrix().locally_owned_range_indices()));

  // The second solve has its preconditioner already.
  Timer first(MPI_COMM_WORLD, true), second(MPI_COMM_WORLD, false);
  LinearSolver::Report report;
  try
    {
      solve_linear_system(solver, system.matrix(), residual, 1e-8, solution);
      first.stop();
      solution = 0.;
      second.start();
      report =
        solve_linear_system(solver, system.matrix(), residual, 1e-8, solution);
      second.stop();
      solution -= exact;
      AssertThrow(solution.l2_norm() < 1e-4 * exact.l2_norm(),
                  ExcMessage("The solution is wrong."));
    }
  catch (const ExcSolverFailure &)
    {
      out << "    no convergence:" << std::endl;
      report.iterations = data.max_iterations;
    }

  const double n_points =
    Utilities::MPI::sum(double(body.points.n_points()), MPI_COMM_WORLD);
  Utilities::System::MemoryStats memory;
  Utilities::System::get_memory_stats(memory);
  const double bytes =
    1024. * Utilities::MPI::sum(double(memory.VmHWM), MPI_COMM_WORLD);
  out << std::setw(6) << n_cells << std::setw(10) << n_points << std::setw(10)
      << system.matrix().m() << std::setw(12)
      << double(system.matrix().n_nonzero_elements()) << std::setw(8)
      << threshold << std::setw(12) << report.iterations << std::setw(10)
      << assembly.wall_time() << std::setw(10)
      << std::max(0., first.wall_time() - second.wall_time()) << std::setw(10)
      << second.wall_time() << std::setw(8) << 1e-9 * bytes << std::endl;
  return report.iterations;
}



template <int dim>
void
run_all(const unsigned int  n_cells,
        const unsigned int  n_grids,
        const std::string  &method,
        ConditionalOStream &out)
{
  for (const double threshold : {0.1, 0.})
    {
      double previous = 0.;
      for (unsigned int grid = 0, n = n_cells; grid < n_grids; ++grid, n *= 2)
        {
          const double iterations = run<dim>(n, threshold, method, out);
          if (previous > 0.)
            out << "    iterations grow by a factor of "
                << iterations / previous << std::endl;
          previous = iterations;
        }
    }
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  ConditionalOStream               out(std::cout,
                         Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
  out << std::setprecision(3);

  const auto argument = [&](const int i, const unsigned int default_value) {
    return argc > i ? static_cast<unsigned int>(std::atoi(argv[i])) :
                      default_value;
  };
  const unsigned int dim     = argument(1, 3);
  const unsigned int n_cells = argument(2, 8);
  const unsigned int n_grids = argument(3, 3);
  const std::string  method  = argc > 4 ? argv[4] : "CG+AMG";

  out << dim << "-D, " << method << ", "
      << Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) << " processes\n"
      << " cells    points  unknowns     entries  phi_cr  iterations"
      << "  assembly    set-up     solve      GB" << std::endl;
  if (dim == 2)
    run_all<2>(n_cells, n_grids, method, out);
  else
    run_all<3>(n_cells, n_grids, method, out);
}
