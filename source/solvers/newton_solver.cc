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



      /** A point on the search line. */
      struct Trial
      {
        double step  = 0.;
        double norm  = std::numeric_limits<double>::infinity();
        double slope = std::numeric_limits<double>::infinity();
      };



      /**
       * Look for a good step length: the full one if it reduces the residual,
       * compared with the last few ones, or the slope of the energy; otherwise
       * the point between where the slope is about zero. The energy has kinks
       * in its second derivative, where points change from compression to
       * expansion; there, the norm of the residual alone leads to cycles or to
       * tiny steps.
       */
      template <typename Evaluate>
      Trial
      search(const Evaluate    &evaluate,
             const double       initial_norm,
             const double       allowed_norm,
             const double       target,
             const double       initial_slope,
             const unsigned int max_bisections,
             unsigned int      &n_trials)
      {
        const auto is_good = [&](const Trial &trial) {
          return trial.norm <= std::max(0.9 * initial_norm, target) ||
                 (initial_slope < 0. &&
                  std::abs(trial.slope) <= 0.5 * std::abs(initial_slope));
        };

        Trial trial = evaluate(1.);
        for (n_trials = 1;
             !std::isfinite(trial.norm) && n_trials <= max_bisections;
             ++n_trials)
          trial = evaluate(0.5 * trial.step);
        if (is_good(trial) || trial.norm <= allowed_norm ||
            !std::isfinite(trial.norm) ||
            (initial_slope < 0. && trial.slope < 0.))
          return trial;

        // Regula falsi with the Illinois modification, or, for an indefinite
        // tangent, bisection until the residual decreases.
        Trial best = trial;
        Trial lower, upper = trial;
        lower.step  = 0.;
        lower.slope = initial_slope;
        int side    = 0;
        for (; n_trials <= max_bisections; ++n_trials)
          {
            double fraction = 0.5;
            if (initial_slope < 0.)
              fraction =
                std::min(0.95,
                         std::max(0.05,
                                  -lower.slope / (upper.slope - lower.slope)));
            trial = evaluate(lower.step + fraction * (upper.step - lower.step));
            if (initial_slope < 0. ?
                  std::abs(trial.slope) < std::abs(best.slope) :
                  trial.norm < best.norm)
              best = trial;
            if (is_good(trial))
              return trial;
            if (initial_slope < 0. && trial.slope < 0.)
              {
                lower = trial;
                if (side == -1)
                  upper.slope *= 0.5;
                side = -1;
              }
            else
              {
                upper = trial;
                if (side == 1)
                  lower.slope *= 0.5;
                side = 1;
              }
          }

        // Where the slope jumps, stop behind the kink: the next tangent has to
        // know what is there.
        return (initial_slope < 0. && upper.norm < initial_norm) ? upper : best;
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
  NewtonSolver::solve(const Problem   &problem,
                      LinearSolver    &linear_solver,
                      const double     scale,
                      const double     tolerance,
                      LA::FieldVector &x) const
  {
    const double target = tolerance * scale;

    // With the tangent at x_{k-1}, the error at x_k is reduced about as much as
    // the residual has been from x_{k-1} to x_k: in theory, by no less than
    // half of that.
    const auto old_will_do = [target](const double norm, const double ratio) {
      return 4. * ratio * norm <= target;
    };

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
        // Points that change between compression and expansion all the time
        // keep the iteration going in circles.
        const auto last = report.residuals.end();
        if (problem.smooth && !report.smoothed && report.residuals.size() > 8 &&
            norm > 0.3 * *(last - 5))
          {
            problem.smooth(x);
            report.smoothed = true;
            tangent_is_here = false;
          }
        const double ratio = norm / previous;
        const bool   spare =
          !tangent_is_here && tangent_is_new && old_will_do(norm, ratio);
        if (!tangent_is_here && !spare)
          problem.tangent(x, residual);
        tangent_is_new = !spare;

        // As accurate as the nonlinear convergence can make use of.
        double eta = std::min(0.1, 0.9 * ratio * ratio);
        if (report.iterations == 0)
          {
            eta = problem.first_tolerance;
            // If that falls short of the target by little, go there at once.
            if (eta * norm > target && eta * norm < 100. * target)
              eta = 0.3 * target / norm;
          }
        eta = std::max({eta, 0.1 * target / norm, 1e-12});

        // The residual that is expected next. If it will take another tangent,
        // have that together with the residual; unless the full step is not
        // likely to be the right one.
        const double next_ratio = report.iterations == 0 ? eta : ratio * ratio;
        const bool   go_on = last_step == 1. && next_ratio * norm > target &&
                           !old_will_do(next_ratio * norm, next_ratio);

        update.zero_out_ghost_values();
        update = 0.;
        residual *= -1.;
        const auto linear = solve_linear_system(
          linear_solver, problem.matrix(), residual, eta, update);
        report.linear_iterations += linear.iterations;
        report.refreshes += linear.refreshed;
        report.indefinite_at_end = linear.indefinite;
        report.indefinite        = report.indefinite || linear.indefinite;

        // R.update is the slope of the energy along the search direction, which
        // is negative at its beginning unless the tangent is indefinite.
        const double initial_slope = -(residual * update);
        tangent_is_here            = go_on;
        const auto evaluate        = [&](const double step) {
          trial.zero_out_ghost_values();
          trial = x;
          trial.zero_out_ghost_values();
          trial.add(step, update);
          Trial result;
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
        const double recent_norm =
          *std::max_element(report.residuals.end() -
                              std::min<std::size_t>(4, report.residuals.size()),
                            report.residuals.end());

        unsigned int n_trials = 0;
        const Trial  best     = search(evaluate,
                                  norm,
                                  1.5 * recent_norm,
                                  target,
                                  initial_slope,
                                  data.max_bisections,
                                  n_trials);
        report.bisections += n_trials - 1;
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
