// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>
#include <ebsmpm/solvers/newton_solver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace EBSMPM
{
  namespace internal
  {
    namespace NewtonSolverImplementation
    {
      /**
       * The norm of a residual, infinite where it cannot be computed.
       */
      double
      try_residual(
        const std::function<void(const LA::FieldVector &, LA::FieldVector &)>
          &                    evaluate,
        const LA::FieldVector &x,
        LA::FieldVector &      residual)
      {
        double norm = std::numeric_limits<double>::infinity();
        try
          {
            evaluate(x, residual);
            norm = residual.l2_norm();
          }
        catch (const ExcSolverFailure &)
          {}
        return std::isfinite(norm) ? norm :
                                     std::numeric_limits<double>::infinity();
      }
    } // namespace NewtonSolverImplementation
  }   // namespace internal

  using namespace internal::NewtonSolverImplementation;



  NewtonSolver::AdditionalData::AdditionalData(
    const double       tolerance,
    const unsigned int max_iterations,
    const unsigned int max_bisections)
    : tolerance(tolerance)
    , max_iterations(max_iterations)
    , max_bisections(max_bisections)
  {}



  NewtonSolver::NewtonSolver(const AdditionalData &data)
    : data(data)
  {}



  NewtonSolver::Report
  NewtonSolver::solve(const Problem &  problem,
                      LinearSolver &   linear_solver,
                      const double     scale,
                      const double     tolerance,
                      LA::FieldVector &x) const
  {
    const double target = tolerance * scale;

    Report          report;
    LA::FieldVector residual, update, trial;
    residual.reinit(x);
    update.reinit(x);
    trial.reinit(x);

    double norm     = try_residual(problem.residual, x, residual);
    double previous = norm;
    report.residuals.push_back(norm);
    AssertThrow(std::isfinite(norm),
                ExcSolverFailure(
                  "The residual at the initial guess is not finite."));

    for (; report.iterations < data.max_iterations && norm > target;
         ++report.iterations)
      {
        problem.tangent(x, residual);

        // As accurate as the nonlinear convergence can make use of.
        const double ratio = norm / previous;
        double       eta   = (report.iterations == 0) ?
                               1e-4 :
                               std::min(1e-3, 0.9 * ratio * ratio);
        eta                = std::max({eta, 0.1 * target / norm, 1e-12});

        update.zero_out_ghost_values();
        update = 0.;
        residual *= -1.;
        const auto linear = solve_linear_system(
          linear_solver, problem.matrix(), residual, eta, update);
        report.linear_iterations += linear.iterations;
        report.refreshes += linear.refreshed;
        report.indefinite = report.indefinite || linear.indefinite;

        // Backtrack until the residual decreases; a state in which it does not
        // exist counts as infinitely bad.
        double       step       = 1.;
        double       best_norm  = std::numeric_limits<double>::infinity();
        double       best_step  = 1.;
        unsigned int bisections = 0;
        for (;; ++bisections, step *= 0.5)
          {
            trial.zero_out_ghost_values();
            trial = x;
            trial.zero_out_ghost_values();
            trial.add(step, update);
            const double trial_norm =
              try_residual(problem.residual, trial, residual);
            if (trial_norm < best_norm)
              {
                best_norm = trial_norm;
                best_step = step;
              }
            if (trial_norm <= (1. - 1e-4 * step) * norm ||
                trial_norm <= target || bisections == data.max_bisections)
              break;
          }
        report.bisections += bisections;
        AssertThrow(std::isfinite(best_norm),
                    ExcSolverFailure("Newton's method met only states that are "
                                     "turned inside out."));
        x.zero_out_ghost_values();
        x.add(best_step, update);
        previous = norm;
        norm     = best_norm;
        report.residuals.push_back(norm);
      }

    report.residual = norm;
    AssertThrow(norm <= target,
                ExcSolverFailure(
                  "Newton's method did not converge in " +
                  std::to_string(report.iterations) +
                  " iterations: the residual is " + std::to_string(norm / target) +
                  " times what is allowed."));
    return report;
  }



  LinearSolver::Report
  solve_linear_system(LinearSolver &          solver,
                      const LA::SparseMatrix &matrix,
                      const LA::FieldVector & right_hand_side,
                      const double            relative_tolerance,
                      LA::FieldVector &       solution)
  {
    const IndexSet  rows = matrix.locally_owned_range_indices();
    LA::Vector      x(rows, matrix.get_mpi_communicator());
    LA::Vector      b(x);
    double *const   x_values = x.begin();
    double *const   b_values = b.begin();
    const auto      n        = rows.n_elements();
    for (unsigned int i = 0; i < n; ++i)
      {
        x_values[i] = solution.local_element(i);
        b_values[i] = right_hand_side.local_element(i);
      }
    const auto report = solver.solve(matrix, x, b, relative_tolerance);
    solution.zero_out_ghost_values();
    for (unsigned int i = 0; i < n; ++i)
      solution.local_element(i) = x_values[i];
    return report;
  }
} // namespace EBSMPM
