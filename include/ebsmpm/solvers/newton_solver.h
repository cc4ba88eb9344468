// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_newton_solver_h
#define ebsmpm_solvers_newton_solver_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/linear_solver.h>
#include <ebsmpm/lac/types.h>

#include <functional>

namespace EBSMPM
{
  /**
   * Newton's method with a line search, for the displacement.
   *
   * The linear systems are solved inexactly, as far as it pays off: the
   * relative tolerance follows the convergence of the residual (Eisenstat and
   * Walker, SIAM J. Sci. Comput. 17 (1996) 16-32, choice 2), so that the last
   * steps are still quadratic. A trial step that turns a point inside out is
   * halved; one that reduces neither the residual nor the slope of the energy
   * is replaced by one where that slope is about zero. An indefinite tangent on
   * the way is no reason to give up; whether one at the end is, the report
   * leaves to the caller.
   *
   * Where a trial step is expected to be good, but not good enough, its
   * residual is computed together with the tangent that the next iteration
   * needs. Where the tangent of the iteration before is expected to be good
   * enough for the last one, it is kept.
   *
   * @code
   * NewtonSolver newton(data);
   * const auto report = newton.solve(problem, linear_solver, scale, x);
   * @endcode
   *
   * Raises ExcSolverFailure if the iteration does not converge; @p x is then
   * undefined. Collective.
   */
  class NewtonSolver
  {
  public:
    /** Parameters. */
    struct AdditionalData
    {
      /** Constructor, with the defaults. */
      AdditionalData(const double       tolerance      = 1e-9,
                     const unsigned int max_iterations = 25,
                     const unsigned int max_bisections = 8);

      /** Tolerance for the residual, relative to a scale given to solve(). */
      double tolerance;

      /** Iterations after which to give up. */
      unsigned int max_iterations;

      /** Number of trial steps of the line search. */
      unsigned int max_bisections;
    };

    /** The problem to solve, $R(x)=0$. */
    struct Problem
    {
      /** Compute the residual. May raise ExcSolverFailure. */
      std::function<void(const LA::FieldVector &x, LA::FieldVector &residual)>
        residual;

      /** Compute the residual and the tangent. */
      std::function<void(const LA::FieldVector &x, LA::FieldVector &residual)>
        tangent;

      /**
       * The same for the first iteration, with an approximation of the tangent
       * that is good although the initial guess does not yet meet the Dirichlet
       * conditions, as is then taken for granted. May be empty; residual() and,
       * if need be, tangent() are called then.
       */
      std::function<void(const LA::FieldVector &x, LA::FieldVector &residual)>
        predictor;

      /** The tangent. */
      std::function<const LA::SparseMatrix &()> matrix;

      /**
       * How accurate the first linear solve is, relative to its right hand
       * side. From a good initial guess, an accurate one reaches the solution
       * almost at once; from a bad one, it is a waste.
       */
      double first_tolerance = 1e-5;

      /**
       * Make the problem smooth, by holding at @p x what switches between
       * branches. Called at most once, when the iteration goes in circles; may
       * be empty.
       */
      std::function<void(const LA::FieldVector &x)> smooth;
    };

    /** What happened. */
    struct Report
    {
      unsigned int iterations        = 0;
      unsigned int linear_iterations = 0;
      unsigned int refreshes         = 0;
      unsigned int bisections        = 0;
      bool         smoothed          = false;

      /** Whether the tangent of any iteration was found to be indefinite. */
      bool indefinite = false;

      /** The same of the last iteration, i.e., next to the solution. */
      bool indefinite_at_end = false;

      /** The norm of the residual at the end. */
      double residual = 0.;

      /** Norms of the residual, before each iteration and at the end. */
      std::vector<double> residuals;
    };

    /** Constructor. */
    explicit NewtonSolver(const AdditionalData &data = AdditionalData());

    /**
     * Solve. The iteration has converged when the norm of the residual is below
     * <tt>tolerance*scale</tt>.
     *
     * @param problem the functions to call
     * @param linear_solver for the tangents
     * @param scale of the residual, for example the largest force so far
     * @param tolerance the relative tolerance, if not that of the constructor
     * @param x the initial guess, and the solution
     */
    Report
    solve(const Problem   &problem,
          LinearSolver    &linear_solver,
          const double     scale,
          const double     tolerance,
          LA::FieldVector &x) const;

  private:
    const AdditionalData data;
  };



  /**
   * Solve a linear system given in the vectors of the assembly.
   */
  LinearSolver::Report
  solve_linear_system(LinearSolver           &solver,
                      const LA::SparseMatrix &matrix,
                      const LA::FieldVector  &right_hand_side,
                      const double            relative_tolerance,
                      LA::FieldVector        &solution);
} // namespace EBSMPM

#endif
