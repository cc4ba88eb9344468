// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// LocalCorrection: it inverts the matrix in its rows, makes a factorisation
// from before a patch became soft good again, has nothing to say about a
// singular part, and LinearSolver makes use of it.

#include <ebsmpm/lac/klu_factorization.h>
#include <ebsmpm/lac/linear_solver.h>
#include <ebsmpm/lac/local_correction.h>
#include <ebsmpm/lac/local_factorization.h>

#include <deal.II/lac/solver_cg.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "../tests.h"

#include "spline_matrix.h"

// What an advancing crack tip does to the stiffness.
const auto sound = [](double, double) { return 1.; };
const auto soft  = [](const double x, const double y) {
  return std::abs(x - 0.5) < 0.07 && std::abs(y - 0.5) < 0.07 ? 1e-3 : 1.;
};



struct Corrected
{
  void
  vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    correction.vmult(factorization, dst, src);
  }

  const KluFactorization &factorization;
  const LocalCorrection  &correction;
};



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  SplineMatrix     problem(40);
  const LA::Vector exact = problem.solution();
  LA::Vector       b = problem.vector(), x = problem.vector(), diagonal(b);

  KluFactorization factorization;
  problem.assemble(sound);
  factorization.initialize(problem.matrix);
  for (const auto i : problem.matrix.locally_owned_range_indices())
    diagonal(i) = problem.matrix.diag_element(i);
  diagonal.compress(VectorOperation::insert);

  problem.assemble(soft);
  std::vector<int> rows;
  for (const auto i : problem.matrix.locally_owned_range_indices())
    if (problem.matrix.diag_element(i) < 0.9 * diagonal(i))
      rows.push_back(
        problem.matrix.locally_owned_range_indices().index_within_set(i));
  deallog << "rows that have changed: "
          << Utilities::MPI::sum(rows.size(), MPI_COMM_WORLD) << " of "
          << problem.matrix.m() << std::endl;

  // If nothing but these rows is loaded, and the preconditioner does nothing,
  // what is left is in other rows.
  struct Zero
  {
    void
    vmult(LA::Vector &dst, const LA::Vector &) const
    {
      dst = 0.;
    }
  };
  LocalCorrection correction;
  correction.reinit(problem.matrix, rows);
  b = 0.;
  for (const int i : rows)
    b.begin()[i] = exact.begin()[i];
  for (unsigned int n = 0; n < 30; ++n)
    {
      LA::Vector rest(b);
      problem.matrix.residual(rest, x, b);
      LA::Vector update(b);
      correction.vmult(Zero(), update, rest);
      x += update;
    }
  LA::Vector rest(b);
  problem.matrix.residual(rest, x, b);
  double error = 0.;
  for (const int i : rows)
    error = std::max(error, std::abs(rest.begin()[i]));
  deallog << "inverts the matrix in its rows: "
          << (Utilities::MPI::max(error, MPI_COMM_WORLD) < 1e-10 ? "yes" :
                                                                   "FAILED")
          << std::endl;

  problem.matrix.vmult(b, exact);
  const auto iterations = [&](const LocalCorrection &L) {
    SolverControl control(500, 1e-8 * b.l2_norm(), false, false);
    x = 0.;
    SolverCG<LA::Vector>(control).solve(problem.matrix,
                                        x,
                                        b,
                                        Corrected{factorization, L});
    return control.last_step();
  };
  const unsigned int with    = iterations(correction);
  const unsigned int without = iterations(LocalCorrection());
  deallog << "fewer iterations than a third: "
          << (3 * with < without ? "yes" : "FAILED") << std::endl;

  // The same within the solver, which need not factorise anew.
  LinearSolver solver;
  problem.assemble(sound);
  problem.matrix.vmult(b, exact);
  x = 0.;
  solver.solve(problem.matrix, x, b, 1e-8);
  problem.assemble(soft);
  problem.matrix.vmult(b, exact);
  x                 = 0.;
  const auto report = solver.solve(problem.matrix, x, b, 1e-8);
  x -= exact;
  deallog << "solver: " << (x.l2_norm() < 1e-4 ? "solved" : "FAILED")
          << (report.refreshed ? ", refreshed" : "") << std::endl;

  // Few rows, and so many that another method does it, in single precision.
  // Where only these, of one process, are not zero, a part of the matrix times
  // a part of the vector is all there is.
  const unsigned int me = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  for (const unsigned int most : {100U, 1050U})
    {
      const unsigned int n_rows =
        std::min<unsigned int>(most, problem.matrix.local_size());
      std::vector<int> first_rows(n_rows);
      std::iota(first_rows.begin(), first_rows.end(), 0);
      LocalFactorization inverse;
      inverse.reinit(problem.matrix, first_rows);

      double error = 0.;
      for (unsigned int p = 0;
           p < Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
           ++p)
        {
          x = 0.;
          if (p == me)
            std::copy_n(exact.begin(), n_rows, x.begin());
          problem.matrix.vmult(b, x);
          std::vector<double> values(b.begin(), b.begin() + n_rows);
          inverse.solve(values.data());
          if (p == me)
            for (unsigned int k = 0; k < n_rows; ++k)
              error = std::max(error, std::abs(values[k] - x.begin()[k]));
        }
      deallog << most << " rows of a process: "
              << (Utilities::MPI::max(error, MPI_COMM_WORLD) <
                      1e-3 * exact.linfty_norm() ?
                    "solved" :
                    "FAILED")
              << std::endl;
    }

  // A part that is singular.
  problem.matrix = 0.;
  correction.reinit(problem.matrix, rows);
  correction.vmult(Zero(), x, b);
  deallog << "nothing where the matrix is singular: "
          << (x.l2_norm() == 0. ? "yes" : "FAILED") << std::endl;
}
