// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Solutions and reuse with every method of LinearSolver, on any number of
// processes, of which one may have no rows: the same matrix again, one that has
// changed little, one that has changed much, one of another size, an indefinite
// one, and none of the information that the methods may need in order to be
// fast.

#include <ebsmpm/lac/linear_solver.h>

#include "../tests.h"

#include "spline_matrix.h"

const auto sound = [](double, double) { return 1.; };

const auto slightly_changed = [](double x, double y) {
  return 1. + 0.1 * std::sin(10. * x) * std::sin(7. * y);
};

const auto much_changed = [](double x, double) { return x < 0.5 ? 1. : 1e4; };

// A strip of negative stiffness
const auto indefinite = [](double x, double y) {
  return (x < 0.5 && y < 0.3) ? -0.8 : 1.;
};



void
solve(LinearSolver                                &solver,
      SplineMatrix                                &problem,
      const std::function<double(double, double)> &stiffness,
      const std::string                           &what)
{
  problem.assemble(stiffness);
  const LA::Vector exact = problem.solution();
  LA::Vector       b = problem.vector(), x = problem.vector();
  problem.matrix.vmult(b, exact);

  const auto report = solver.solve(problem.matrix, x, b);

  x -= exact;
  const double error = x.l2_norm() / exact.l2_norm();
  deallog << what << ": "
          << (error < 1e-6 ? "solved" : "FAILED, " + std::to_string(error))
          << (report.iterations <= 3   ? ", at once" :
              report.iterations <= 300 ? ", by iterations" :
                                         ", by too many iterations")
          << (report.refreshed ? ", refreshed" : "")
          << (report.indefinite ? ", indefinite" : "") << std::endl;
}



void
test(const std::string &name, const unsigned int empty)
{
  deallog.push(name);

  LinearSolver::AdditionalData data;
  data.method             = LinearSolver::method_from_name(name);
  data.refresh_iterations = 20;
  LinearSolver solver(data);

  SplineMatrix problem(24, true, empty);
  SplineMatrix other_problem(12, true, empty);
  solver.set_block_size(2);
  solver.set_near_null_space(problem.near_null_space());

  solve(solver, problem, sound, "first");
  solve(solver, problem, sound, "again");
  solve(solver, problem, slightly_changed, "changed slightly");
  solve(solver, problem, much_changed, "changed much");
  solve(solver, problem, much_changed, "again");
  solver.invalidate();
  solve(solver, problem, much_changed, "invalidated");
  solve(solver, problem, indefinite, "indefinite");
  solve(solver, problem, sound, "definite");

  solver.set_near_null_space({});
  solve(solver, other_problem, sound, "another size");
  solver.clear();
  solve(solver, other_problem, sound, "cleared");

  LA::Vector x = other_problem.solution(), b = other_problem.vector();
  const auto report = solver.solve(other_problem.matrix, x, b);
  deallog << "no right hand side: " << report.iterations << " iterations, "
          << (x.l2_norm() == 0. ? "zero" : "FAILED") << std::endl;

  deallog.pop();
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  for (const std::string name :
       {"MUMPS", "KLU", "CG+AMG", "GMRES+AMG", "CG+IC"})
    {
      test(name, numbers::invalid_unsigned_int);
      if (n_ranks > 1)
        {
          deallog << "Without rows on one process:" << std::endl;
          test(name, n_ranks == 2 ? 0 : 1);
        }
    }
}
