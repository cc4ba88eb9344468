// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Times of the linear solvers, on the matrix of plane elasticity with quadratic
// B-splines on n x n cells (the argument; 128 by default, 32,760 unknowns): the
// first solve, one with the same matrix, one that renews the preconditioner,
// one with a preconditioner from a matrix that differs by up to 10 %, one for
// a body with a crack that is softer by a factor of 10^4, and one after the
// crack has grown by one cell.

#include <ebsmpm/lac/linear_solver.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>

#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "../lac/spline_matrix.h"

using namespace EBSMPM;



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  ConditionalOStream out(
    std::cout, dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);

  const unsigned int n = (argc > 1 ? std::atoi(argv[1]) : 128);
  SplineMatrix       problem(n);
  out << problem.matrix.m() << " unknowns, "
      << problem.matrix.n_nonzero_elements() << " entries, "
      << dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)
      << " processes\n"
      << "method      case            seconds  iterations     error\n";

  const auto sound   = [](double, double) { return 1.; };
  const auto changed = [](double x, double y) {
    return 1. + 0.1 * std::sin(10. * x) * std::sin(7. * y);
  };
  const auto crack = [n](const double length) {
    return [=](const double x, const double y) {
      return (std::abs(y - 0.5) * n < 1. && x < length) ? 1e-4 : 1.;
    };
  };

  const LA::Vector exact = problem.solution();
  LA::Vector       b = problem.vector(), x = problem.vector();

  for (const std::string name :
       {"MUMPS", "KLU", "CG+AMG", "GMRES+AMG", "CG+IC"})
    {
      LinearSolver::AdditionalData data;
      data.method             = LinearSolver::method_from_name(name);
      data.refresh_iterations = 100;
      LinearSolver solver(data);
      solver.set_block_size(2);
      solver.set_near_null_space(problem.near_null_space());

      const auto solve = [&](const std::string &what) {
        problem.matrix.vmult(b, exact);
        x = 0.;
        Timer      timer(MPI_COMM_WORLD, true);
        const auto report = solver.solve(problem.matrix, x, b);
        timer.stop();
        x -= exact;
        const double error = x.l2_norm() / exact.l2_norm();
        out << std::left << std::setw(12) << name << std::setw(16) << what
            << std::setw(9) << std::setprecision(3) << timer.wall_time()
            << std::setw(11) << report.iterations << error << std::endl;
      };

      problem.assemble(sound);
      solve("first");
      solve("again");
      solver.invalidate();
      solve("renewed");
      problem.assemble(changed);
      solve("10 % changed");
      problem.assemble(crack(0.5));
      solver.invalidate();
      solve("crack");
      problem.assemble(crack(0.5 + 1. / n));
      solve("crack grown");
    }
}
