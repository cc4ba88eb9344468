// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// What LinearSolver says when it cannot solve, on all processes: a singular
// matrix, numbers that are not finite, an iteration that stagnates. Afterwards
// it solves again. Parameters out of range.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/lac/linear_solver.h>

#include <limits>
#include <sstream>

#include "../tests.h"

#include "spline_matrix.h"

// deal.II's own functions refuse this number in debug mode.
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

const auto sound = [](double, double) { return 1.; };



/**
 * Print the message of an exception up to its numbers, which depend on
 * round-off; or, where the whole message does, only that there is one.
 */
template <typename Function>
void
expect_failure(const std::string &what,
               const Function    &function,
               const bool         print_message = true)
{
  std::string text = "FAILED: no exception";
  try
    {
      function();
    }
  catch (const ExceptionBase &exc)
    {
      std::ostringstream message;
      exc.print_info(message);
      text = message.str();
      text.erase(0, text.find_first_not_of(" \n"));
      text.erase(text.find_last_not_of(" \n") + 1);
      if (!print_message)
        text = "refused";
      for (const std::string cut : {"MUMPS found", "after", "residual of"})
        {
          const auto position = text.find(cut);
          if (position != std::string::npos)
            text.erase(position + cut.size());
        }
    }
  const auto texts = dealii::Utilities::MPI::gather(MPI_COMM_WORLD, text);
  bool       same  = true;
  for (const std::string &other : texts)
    same = same && (other == texts[0]);
  deallog << what << ": " << text << (same ? "" : " NOT ON ALL PROCESSES")
          << std::endl;
}



void
test(const std::string &name)
{
  deallog.push(name);

  LinearSolver::AdditionalData data;
  data.method = LinearSolver::method_from_name(name);
  LinearSolver solver(data);
  solver.set_block_size(2);

  SplineMatrix     problem(24), loose(24, false);
  const LA::Vector exact = problem.solution();
  LA::Vector       b = problem.vector(), x = problem.vector();

  const auto solve_regular = [&]() {
    problem.assemble(sound);
    problem.matrix.vmult(b, exact);
    x                 = 0.;
    const auto report = solver.solve(problem.matrix, x, b);
    x -= exact;
    deallog << (x.l2_norm() < 1e-6 ? "solved" : "FAILED")
            << (report.refreshed ? ", refreshed" : "") << std::endl;
  };
  solve_regular();

  expect_failure("NaN in the right hand side", [&]() {
    LA::Vector wrong(b);
    wrong.trilinos_vector()[0][0] = not_a_number;
    solver.solve(problem.matrix, x, wrong);
  });
  solve_regular();

  expect_failure("NaN in the matrix", [&]() {
    int     n_entries;
    double *entries;
    problem.matrix.trilinos_matrix().ExtractMyRowView(3, n_entries, entries);
    entries[0] = not_a_number;
    x          = 0.;
    solver.solve(problem.matrix, x, b);
  });
  solve_regular();

  // Only MUMPS tells small pivots from zero ones. With the other methods, it
  // is the result that is wrong.
  const bool finds_null_pivots = (name == "automatic" || name == "MUMPS");
  expect_failure(
    "loose body",
    [&]() {
      loose.assemble(sound);
      LA::Vector force = loose.vector(), displacement = loose.vector();
      force = 1.;
      solver.solve(loose.matrix, displacement, force);
    },
    finds_null_pivots);
  solve_regular();

  expect_failure(
    "empty rows",
    [&]() {
      problem.assemble([](double, double y) { return y < 0.3 ? 0. : 1.; });
      x = 0.;
      solver.solve(problem.matrix, x, b);
    },
    finds_null_pivots);
  solve_regular();

  deallog.pop();
}



/**
 * Unknowns that go from one process to another, as many as before: the rigid
 * body motions of now have to be taken, in their distribution.
 */
void
test_near_null_space()
{
  const auto solve = [](LinearSolver &solver, const unsigned int empty_rank) {
    SplineMatrix problem(24, true, empty_rank);
    problem.assemble(sound);
    solver.set_block_size(2);
    solver.set_near_null_space(problem.near_null_space());
    LA::Vector x = problem.vector(), b = problem.vector();
    problem.matrix.vmult(b, problem.solution());
    const auto report = solver.solve(problem.matrix, x, b);
    x -= problem.solution();
    AssertThrow(x.l2_norm() < 1e-6 * problem.solution().l2_norm(),
                ExcInternalError());
    return report.iterations;
  };

  LinearSolver::AdditionalData data;
  data.method = LinearSolver::Method::cg_amg;
  LinearSolver moved(data), fresh(data);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    solve(moved, 0);
  const unsigned int expected = solve(fresh, numbers::invalid_unsigned_int);
  const unsigned int found    = solve(moved, numbers::invalid_unsigned_int);
  deallog << "the same iterations after unknowns have moved: "
          << (found == expected ? "yes" : "NO") << std::endl;
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  for (const std::string name :
       {"automatic", "MUMPS", "KLU", "CG+AMG", "GMRES+AMG"})
    test(name);

  test_near_null_space();

  for (const std::string name : {"CG+AMG", "GMRES+AMG"})
    expect_failure("three iterations of " + name, [&]() {
      LinearSolver::AdditionalData data;
      data.method         = LinearSolver::method_from_name(name);
      data.max_iterations = 3;
      LinearSolver solver(data);
      SplineMatrix problem(24);
      problem.assemble(sound);
      LA::Vector x = problem.vector();
      solver.solve(problem.matrix, x, problem.solution());
    });

  expect_failure("method", []() { LinearSolver::method_from_name("Gauss"); });
  expect_failure("tolerance", []() {
    LinearSolver::AdditionalData data;
    data.relative_tolerance = 0.;
    LinearSolver solver(data);
  });
  expect_failure("iterations", []() {
    LinearSolver::AdditionalData data;
    data.max_iterations = 0;
    LinearSolver solver(data);
  });
}
