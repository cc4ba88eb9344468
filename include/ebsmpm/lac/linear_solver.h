// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_linear_solver_h
#define ebsmpm_lac_linear_solver_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/local_correction.h>
#include <ebsmpm/lac/renumbered_preconditioner.h>
#include <ebsmpm/lac/reusable_preconditioner.h>
#include <ebsmpm/lac/types.h>

#include <memory>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * The solver of sequences of symmetric linear systems whose matrices resemble
   * each other, as they do from Newton step to Newton step and from one pass of
   * the staggered scheme to the next.
   *
   * The last factorisation, or multigrid hierarchy, is the preconditioner of
   * the next solves, by the method of conjugate gradients. With the matrix it
   * was computed from, a factorisation makes one iteration of it. With others,
   * the number of iterations measures how much the matrix has changed, and once
   * the surplus is too large, the factorisation is renewed. So the caller need
   * not decide when to factorise, and every solution is as accurate as asked
   * for. It may even have other unknowns than those of today, if renumber()
   * tells which is which. Where the matrix has changed in few rows, as at the
   * tip of a crack, LocalCorrection makes up for that.
   *
   * When is the surplus too large? Say that a new factorisation costs $R$
   * iterations, and that the $n$ solves with the present one took $e_1,\dots,
   * e_n$ iterations more than with a new one, which would have reduced the
   * residual in each by as much as in its first solve. As $e_i$ grows, the
   * average cost $(R+e_1+\dots+e_n)/n$ of a solve first falls, and then rises.
   * It is smallest when $e_n$ gets larger than the average: that is the moment.
   *
   * | Method    | preconditioner                      | where                |
   * | --------- | ----------------------------------- | -------------------- |
   * | mumps     | MumpsFactorization, $LDL^T$         | 2-D, or a crack      |
   * | klu       | KluFactorization, $LU$, serial      | if there is no MUMPS |
   * | cg_amg    | AmgHierarchy                        | large problems       |
   * | gmres_amg | AmgHierarchy, GMRES from the start  | indefinite matrices  |
   * | cg_ic     | IncompleteCholesky                  | the damage           |
   * | automatic | mumps (else klu) below a number of entries, cg_amg above  ||
   *
   * Conjugate gradients need a positive definite matrix, but the tangent of a
   * step that goes too far, or with too small a penalty factor, may be
   * indefinite. This is noticed by negative pivots (MUMPS only), or by a vector
   * $\mathbf p$ with $\mathbf p^T A \mathbf p \le 0$ during the iteration. The
   * solver then changes over to GMRES with a new preconditioner, solves the
   * system nevertheless, and says so in the Report: what an indefinite tangent
   * means is for the caller to decide.
   *
   * @code
   *   LinearSolver::AdditionalData data;
   *   data.method = LinearSolver::Method::automatic;
   *
   *   LinearSolver solver(data);
   *   solver.set_block_size(dim);
   *   for (...)
   *     {
   *       system.assemble(matrix, residual);
   *       increment = 0;
   *       const auto report = solver.solve(matrix, increment, residual);
   *     }
   * @endcode
   *
   * All functions are collective. Failures raise ExcSolverFailure, on all
   * processes: a singular matrix, an iteration that stagnates although the
   * preconditioner is new, a number that is not finite in the matrix, the right
   * hand side or the result. Afterwards, the object can be used on.
   *
   * The matrix may be another object in every call, and of another size; what
   * the preconditioners keep of its sparsity pattern they compare by
   * themselves.
   */
  class LinearSolver
  {
  public:
    /**
     * The methods, see the class.
     */
    enum class Method
    {
      automatic,
      mumps,
      klu,
      cg_amg,
      gmres_amg,
      cg_ic
    };

    /**
     * What can be chosen.
     */
    struct AdditionalData
    {
      /**
       * The method.
       */
      Method method = Method::automatic;

      /**
       * The norm of the residual at which to stop, relative to that of the
       * right hand side.
       */
      double relative_tolerance = 1e-10;

      /**
       * The number of iterations after which an iteration with a new
       * preconditioner counts as stagnating.
       */
      unsigned int max_iterations = 500;

      /**
       * What a new preconditioner costs, in iterations, at least: $R$ above. A
       * factorisation in three dimensions costs more, and MUMPS knows how much.
       * A solve that exceeds the iterations of a new preconditioner by that
       * number is completed with a new one. With zero, it is renewed whenever
       * there is one iteration more, unless it knows better.
       */
      unsigned int refresh_iterations = 15;

      /**
       * The number of entries of the matrix up to which Method::automatic
       * chooses a factorisation; a fifth of it where there is no MUMPS. The
       * default corresponds to a million unknowns of two displacement
       * components in two dimensions, and to 130,000 of three in three, with
       * quadratic splines; there, the factors take some 4 GB.
       */
      double max_entries_for_direct = 5e7;
    };

    /**
     * What happened.
     */
    struct Report
    {
      /**
       * The number of iterations, including those with a preconditioner that
       * was then renewed.
       */
      unsigned int iterations = 0;

      /**
       * Whether a preconditioner was computed.
       */
      bool refreshed = false;

      /**
       * Whether the matrix was found to be indefinite, or the one that the
       * preconditioner is from. A no is certain only with MUMPS and if
       * @p refreshed.
       */
      bool indefinite = false;

      /**
       * The norm of the residual, absolute, before and after the iteration that
       * has led to the solution.
       */
      double initial_residual = 0.;
      double final_residual   = 0.;
    };

    /**
     * Constructor, with the default values of AdditionalData.
     */
    LinearSolver();

    /**
     * Constructor. A tolerance that is not between zero and one, or no
     * iterations at all, raise ExcParameter.
     */
    explicit LinearSolver(const AdditionalData &data);

    /**
     * Destructor.
     */
    ~LinearSolver();

    /**
     * Set the number of unknowns of a function, which are numbered one after
     * the other. Multigrid aggregates them as one. The default is one.
     */
    void
    set_block_size(const unsigned int size);

    /**
     * Set the near null space for multigrid, see AmgHierarchy. The vectors are
     * copied, and must be given anew before the first solve after the number of
     * unknowns has changed.
     */
    void
    set_near_null_space(const std::vector<LA::Vector> &vectors);

    /**
     * Tell that the unknowns are others now, so that the preconditioner can be
     * used on, see RenumberedPreconditioner. Collective.
     *
     * @param former_rows for each unknown of today, what former_rows() said of
     *   it, or zero if it is new
     */
    void
    renumber(const LA::FieldVector &former_rows);

    /**
     * Return, for each unknown, one plus the number of the row that it had when
     * the preconditioner was computed, or zero if there was none. Empty before
     * the first call of renumber().
     */
    const LA::FieldVector &
    former_rows() const;

    /**
     * Forget everything, in order to release memory.
     */
    void
    clear();

    /**
     * Let the next solve compute a new preconditioner. For callers who know
     * that the matrix has changed much.
     */
    void
    invalidate();

    /**
     * Solve $A\mathbf x = \mathbf b$ to the tolerance in AdditionalData.
     *
     * @param A A symmetric matrix.
     * @param x In: where to start. Out: the solution. It has no ghost entries.
     * @param b The right hand side.
     */
    Report
    solve(const LA::SparseMatrix &A, LA::Vector &x, const LA::Vector &b);

    /**
     * The same, to another tolerance.
     */
    Report
    solve(const LA::SparseMatrix &A,
          LA::Vector             &x,
          const LA::Vector       &b,
          const double            relative_tolerance);

    /**
     * Compute a new preconditioner, and return whether negative eigenvalues
     * were found. Certain only with MUMPS; the other methods say no.
     * Collective.
     */
    bool
    is_found_indefinite(const LA::SparseMatrix &A);

    /**
     * Return a method by its name, one of method_names(). Any other name raises
     * ExcParameter.
     */
    static Method
    method_from_name(const std::string &name);

    /**
     * Return the names of the methods, separated by bars as in a
     * Patterns::Selection.
     */
    static std::string
    method_names();

  private:
    /**
     * How an iteration ended.
     */
    enum class Outcome
    {
      converged,
      stagnated,
      singular,
      indefinite,
      not_finite
    };

    /**
     * Return the method for a matrix: not Method::automatic.
     */
    Method
    choose_method(const LA::SparseMatrix &A) const;

    /**
     * Compute the preconditioner.
     */
    void
    refresh(const LA::SparseMatrix &A);

    /**
     * Return whether there is a preconditioner for a matrix, if not computed
     * from it.
     */
    bool
    can_be_reused(const LA::SparseMatrix &A) const;

    /**
     * Correct the preconditioner, which is from another matrix, in the rows
     * that have changed.
     */
    void
    correct(const LA::SparseMatrix &A);

    /**
     * Return how many iterations a new preconditioner costs.
     */
    unsigned int
    cost_of_refresh() const;

    /**
     * Return how many iterations a new preconditioner would need to reduce a
     * residual to another, judging from its first solve.
     */
    unsigned int
    iterations_when_new(const double initial_residual,
                        const double final_residual) const;

    /**
     * Iterate until the residual is small enough or the number of iterations
     * too large, and update the report.
     */
    Outcome
    iterate(const LA::SparseMatrix &A,
            LA::Vector             &x,
            const LA::Vector       &b,
            const double            tolerance,
            const unsigned int      max_iterations,
            const bool              use_gmres,
            Report                 &report) const;

    const AdditionalData additional_data;

    unsigned int            block_size = 1;
    std::vector<LA::Vector> near_null_space;

    /**
     * The method the preconditioner is for.
     */
    Method method;

    std::unique_ptr<ReusablePreconditioner> preconditioner;

    /**
     * Whether the preconditioner can be used, and the rows of the matrix that
     * it was computed from.
     */
    bool     is_initialized = false;
    IndexSet rows;

    /**
     * See former_rows(); whether they are others than the numbers of today; and
     * the preconditioner for these.
     */
    LA::FieldVector                           former_row_numbers;
    bool                                      is_renumbered = false;
    std::unique_ptr<RenumberedPreconditioner> renumbered_preconditioner;

    /**
     * The diagonal of the matrix that the preconditioner was computed from, and
     * its correction where that of today is another.
     */
    LA::Vector      diagonal;
    LocalCorrection correction;

    /**
     * Whether the matrix that the preconditioner was computed from was found
     * indefinite.
     */
    bool is_indefinite = false;

    /**
     * The logarithm of the factor by which an iteration with the new
     * preconditioner has reduced the residual; the number of solves since then,
     * and how many iterations more than with a new one they took in all.
     */
    double       reduction_when_new = 1.;
    unsigned int n_solves           = 0;
    unsigned int surplus            = 0;
  };
} // namespace EBSMPM

#endif
