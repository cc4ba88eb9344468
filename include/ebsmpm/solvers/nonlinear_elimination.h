// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_nonlinear_elimination_h
#define ebsmpm_solvers_nonlinear_elimination_h

#include <ebsmpm/lac/types.h>

#include <ebsmpm/assembly/displacement_system.h>

#include <vector>

namespace EBSMPM
{
  /**
   * Improves an initial guess for the displacement that is bad at a few places
   * only, as it is where a crack has just grown.
   *
   * Points that have come to the other side of a crack see other functions than
   * before, and another displacement. Newton's method then spends several
   * iterations, each of which assembles and solves for the whole body, on what
   * happens in a few cells. This class solves the nonlinear equations there
   * first, with everything else held: with the rows $R$ in which the residual
   * is large, and their neighbourhood,
   * @f[
   *   \mathbf x \leftarrow \mathbf x - R^T (R\,\mathbf A(\mathbf x)\,R^T)^{-1}
   *   R\,\mathbf r(\mathbf x)
   * @f]
   * until the residual in these rows is small (nonlinear elimination: Lanzkron,
   * Rose and Wilkes, SIAM J. Sci. Comput. 18 (1997) 538-559; Hwang, Lin and
   * Cai, Comput. Fluids 39 (2010)). What is found is an initial guess; if this
   * fails, the one given is left as it was.
   *
   * Each process inverts its own rows; processes meet in the residual.
   *
   * @code
   * NonlinearElimination<dim> elimination;
   * elimination.improve(system, state, boundary, increment);
   * newton.solve(problem, linear_solver, scale, tolerance, increment);
   * @endcode
   */
  template <int dim>
  class NonlinearElimination
  {
  public:
    /** Parameters. */
    struct AdditionalData
    {
      /** What is a large residual, relative to the largest one. */
      double large_residual = 0.05;

      /**
       * How many times the functions that share a cell with those found so far
       * are taken as well.
       */
      unsigned int n_layers = 2;

      /** More rows than that, on any process, are too many to be few. */
      unsigned int max_rows = 1000;

      /** Iterations after which to leave it at that. */
      unsigned int max_iterations = 5;

      /** By how much the residual in the rows is to be reduced. */
      double reduction = 0.01;
    };

    /** Constructor. */
    explicit NonlinearElimination(
      const AdditionalData &data = AdditionalData());

    /**
     * Improve @p increment. Raises ExcSolverFailure if a point is turned inside
     * out by the guess itself. Collective.
     *
     * Return the number of iterations; zero if nothing has been done.
     */
    unsigned int
    improve(DisplacementSystem<dim>  &system,
            const MaterialState<dim> &state,
            const BoundaryState<dim> &boundary,
            LA::FieldVector          &increment) const;

  private:
    /**
     * Find the functions with a large @p residual and their neighbourhood: for
     * each one that this process knows.
     */
    std::vector<bool>
    find_functions(const DisplacementSystem<dim> &system,
                   const LA::FieldVector         &residual) const;

    const AdditionalData data;
  };
} // namespace EBSMPM

#endif
