// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/solvers/line_search.h>
#include <ebsmpm/solvers/newton_solver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace EBSMPM
{
  namespace
  {
    /**
     * The norm of a residual, infinite where it cannot be computed.
     */
    double
    try_residual(const std::function<void(const LA::FieldVector &,
                                          LA::FieldVector &)> &evaluate,
                 const LA::FieldVector                        &x,
                 LA::FieldVector                              &residual)
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



    /**
     * Whether the residual is about what it was four iterations ago: points
     * that change between compression and expansion all the time keep the
     * iteration going in circles.
     */
    bool
    goes_in_circles(const std::vector<double> &residuals)
    {
      return residuals.size() > 8 &&
             residuals.back() > 0.3 * residuals[residuals.size() - 5];
    }



    /** The largest of the last four residuals. */
    double
    recent_norm(const std::vector<double> &residuals)
    {
      return *std::max_element(residuals.end() -
                                 std::min<std::size_t>(4, residuals.size()),
                               residuals.end());
    }



    /**
     * The tolerance for the first linear system. If that given falls short of
     * the target by little, go there at once.
     */
    double
    first_forcing_term(const double first_tolerance,
                       const double norm,
                       const double target)
    {
      const double falls_short_by = first_tolerance * norm / target;
      return (falls_short_by > 1. && falls_short_by < 100.) ?
               0.3 * target / norm :
               first_tolerance;
    }



    /**
     * Whether the tangent of the iteration before will do for the last one.
     * With the tangent at $x_{k-1}$, the error at $x_k$ is reduced about as
     * much as the residual has been from $x_{k-1}$ to $x_k$, @p ratio: in
     * theory, by no less than half of that.
     */
    bool
    old_tangent_will_do(const double norm,
                        const double ratio,
                        const double target)
    {
      return 4. * ratio * norm <= target;
    }
  } // namespace



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
  NewtonSolver::solve(const Problem   &problem,
                      LinearSolver    &linear_solver,
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

    // The tangent comes with the residual. Where there is a predictor, there is
    // something to do for it.
    bool tangent_is_here = static_cast<bool>(problem.predictor);
    bool tangent_is_new  = true;

    double norm =
      try_residual(tangent_is_here ? problem.predictor : problem.residual,
                   x,
                   residual);
    double previous  = norm;
    double last_step = 1.;
    report.residuals.push_back(norm);
    AssertThrow(std::isfinite(norm),
                ExcSolverFailure(
                  "The residual at the initial guess is not finite."));

    for (; report.iterations < data.max_iterations && norm > target;
         ++report.iterations)
      {
        if (problem.smooth && !report.smoothed &&
            goes_in_circles(report.residuals))
          {
            problem.smooth(x);
            report.smoothed = true;
            tangent_is_here = false;
          }
        const double ratio   = norm / previous;
        const bool   keep_it = !tangent_is_here && tangent_is_new &&
                             old_tangent_will_do(norm, ratio, target);
        if (!tangent_is_here && !keep_it)
          problem.tangent(x, residual);
        tangent_is_new = !keep_it;

        // As accurate as the nonlinear convergence can make use of.
        double eta =
          report.iterations == 0 ?
            first_forcing_term(problem.first_tolerance, norm, target) :
            std::min(0.1, 0.9 * ratio * ratio);
        eta = std::max({eta, 0.1 * target / norm, 1e-12});

        update.zero_out_ghost_values();
        update = 0.;
        residual *= -1.;
        const auto linear = solve_linear_system(
          linear_solver, problem.matrix(), residual, eta, update);
        report.linear_iterations += linear.iterations;
        report.refreshes += linear.refreshed;
        report.indefinite_at_end = linear.indefinite;
        report.indefinite        = report.indefinite || linear.indefinite;

        // The residual that is expected next. If it will take another tangent,
        // have that together with the residual; unless the full step is not
        // likely to be the right one.
        const double next_ratio = report.iterations == 0 ? eta : ratio * ratio;
        const double next_norm  = next_ratio * norm;
        tangent_is_here         = last_step == 1. && next_norm > target &&
                          !old_tangent_will_do(next_norm, next_ratio, target);

        // R.update is the slope of the energy along the search direction, which
        // is negative at its beginning unless the tangent is indefinite.
        const LineSearch::Trial start    = {0., norm, -(residual * update)};
        const auto              evaluate = [&](const double step) {
          trial.zero_out_ghost_values();
          trial = x;
          trial.zero_out_ghost_values();
          trial.add(step, update);
          LineSearch::Trial result;
          result.step     = step;
          tangent_is_here = tangent_is_here && step == 1.;
          result.norm =
            try_residual(tangent_is_here ? problem.tangent : problem.residual,
                         trial,
                         residual);
          result.slope =
            std::isfinite(result.norm) ? residual * update : result.norm;
          return result;
        };
        // An increase for a few iterations is fine.
        LineSearch line(data.max_bisections, evaluate);
        const auto best =
          line.search(start, 1.5 * recent_norm(report.residuals), target);
        report.bisections += line.n_trials() - 1;
        AssertThrow(std::isfinite(best.norm),
                    ExcSolverFailure("Newton's method met only states that are "
                                     "turned inside out."));
        x.zero_out_ghost_values();
        x.add(best.step, update);
        last_step = best.step;
        previous  = norm;
        norm      = best.norm;
        report.residuals.push_back(norm);
      }

    report.residual = norm;
    AssertThrow(norm <= target,
                ExcSolverFailure("Newton's method did not converge in " +
                                 std::to_string(report.iterations) +
                                 " iterations: the residual is " +
                                 std::to_string(norm / target) +
                                 " times what is allowed."));
    return report;
  }



  LinearSolver::Report
  solve_linear_system(LinearSolver           &solver,
                      const LA::SparseMatrix &matrix,
                      const LA::FieldVector  &right_hand_side,
                      const double            relative_tolerance,
                      LA::FieldVector        &solution)
  {
    const IndexSet rows = matrix.locally_owned_range_indices();
    LA::Vector     x(rows, matrix.get_mpi_communicator());
    LA::Vector     b(x);
    double *const  x_values = x.begin();
    double *const  b_values = b.begin();
    const auto     n        = rows.n_elements();
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
