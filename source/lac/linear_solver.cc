// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/lac/amg_hierarchy.h>
#include <ebsmpm/lac/diagonal.h>
#include <ebsmpm/lac/incomplete_cholesky.h>
#include <ebsmpm/lac/klu_factorization.h>
#include <ebsmpm/lac/linear_solver.h>
#include <ebsmpm/lac/local_factorization.h>
#include <ebsmpm/lac/mumps_factorization.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

namespace EBSMPM
{
  namespace
  {
    // The residual, relative to the right hand side, at which a solution is
    // accepted although round-off prevents a smaller one.
    constexpr double acceptable_residual = 1e-5;

    // No residual is smaller, relative to the right hand side.
    constexpr double round_off = 1e-16;

    // The change of a diagonal entry, relative to it, that makes a row worth
    // correcting, and the part of the rows of a process that may be corrected.
    constexpr double least_change = 0.03;
    constexpr double most_changed = 0.25;



    /**
     * Thrown by ObservedOperator, caught where the iteration was started.
     */
    enum class Observation
    {
      indefinite_matrix,
      indefinite_preconditioner,
      not_finite
    };



    /**
     * A matrix or a preconditioner as the iterations see it: with every product
     * it looks at the Rayleigh quotient. SolverCG computes the same numbers,
     * but does not tell their signs, and neither it nor SolverGMRES likes a
     * NaN.
     */
    template <typename Operator>
    class ObservedOperator
    {
    public:
      ObservedOperator(const Operator   &A,
                       const bool        must_be_definite,
                       const Observation if_indefinite)
        : A(A)
        , must_be_definite(must_be_definite)
        , if_indefinite(if_indefinite)
      {}

      void
      vmult(LA::Vector &dst, const LA::Vector &src) const
      {
        A.vmult(dst, src);
        const double quotient = src * dst;
        if (!std::isfinite(quotient))
          throw Observation::not_finite;
        if (must_be_definite && quotient <= 0. && src.l2_norm() > 0.)
          throw if_indefinite;
      }

    private:
      const Operator   &A;
      const bool        must_be_definite;
      const Observation if_indefinite;
    };



    /** A preconditioner together with its correction. */
    template <typename Preconditioner>
    class CorrectedPreconditioner
    {
    public:
      CorrectedPreconditioner(const Preconditioner  &P,
                              const LocalCorrection &correction)
        : P(P)
        , correction(correction)
      {}

      void
      vmult(LA::Vector &dst, const LA::Vector &src) const
      {
        correction.vmult(P, dst, src);
      }

    private:
      const Preconditioner  &P;
      const LocalCorrection &correction;
    };



    /**
     * The logarithm of the factor by which the residual was reduced; no more
     * than what round-off allows, and not less than zero.
     */
    double
    logarithmic_reduction(const double initial_residual,
                          const double final_residual)
    {
      if (!(final_residual < initial_residual))
        return 0.;
      return std::log(1. /
                      std::max(final_residual / initial_residual, round_off));
    }
  } // namespace



  LinearSolver::LinearSolver()
    : LinearSolver(AdditionalData())
  {}



  LinearSolver::LinearSolver(const AdditionalData &data)
    : additional_data(data)
    , method(data.method)
  {
    AssertThrow(data.relative_tolerance > 0. && data.relative_tolerance < 1.,
                ExcParameter("Linear solver/Relative tolerance",
                             std::to_string(data.relative_tolerance),
                             "larger than 0 and smaller than 1"));
    AssertThrow(data.max_iterations > 0,
                ExcParameter("Linear solver/Maximum iterations",
                             std::to_string(data.max_iterations),
                             "positive"));
  }



  LinearSolver::~LinearSolver() = default;



  void
  LinearSolver::set_block_size(const unsigned int size)
  {
    if (size != block_size)
      clear();
    block_size = size;
  }



  void
  LinearSolver::set_near_null_space(const std::vector<LA::Vector> &vectors)
  {
    // Assigned one by one, vectors of the same size would keep their former
    // distribution.
    near_null_space = std::vector<LA::Vector>(vectors);
  }



  void
  LinearSolver::renumber(const LA::FieldVector &former_rows)
  {
    former_row_numbers.reinit(former_rows);
    former_row_numbers = former_rows;
    renumbered_preconditioner.reset();
    is_renumbered = true;
  }



  const LA::FieldVector &
  LinearSolver::former_rows() const
  {
    return former_row_numbers;
  }



  void
  LinearSolver::clear()
  {
    invalidate();
    renumbered_preconditioner.reset();
    preconditioner.reset();
  }



  void
  LinearSolver::invalidate()
  {
    is_initialized = false;
  }



  LinearSolver::Method
  LinearSolver::choose_method(const LA::SparseMatrix &A) const
  {
    if (additional_data.method != Method::automatic)
      return additional_data.method;
    const bool   has_mumps = MumpsFactorization::is_available();
    const double max_entries =
      (has_mumps ? 1. : 0.2) * additional_data.max_entries_for_direct;
    if (A.n_nonzero_elements() > max_entries)
      return Method::cg_amg;
    return has_mumps ? Method::mumps : Method::klu;
  }



  void
  LinearSolver::refresh(const LA::SparseMatrix &A)
  {
    is_initialized = false;
    AssertThrow(std::isfinite(A.frobenius_norm()),
                ExcSolverFailure(
                  "The matrix has an entry that is not a finite number."));

    const Method new_method = choose_method(A);
    if (!preconditioner || new_method != method)
      {
        preconditioner.reset();
        if (new_method == Method::mumps)
          preconditioner = std::make_unique<MumpsFactorization>();
        else if (new_method == Method::klu)
          preconditioner = std::make_unique<KluFactorization>();
        else if (new_method == Method::cg_ic)
          preconditioner = std::make_unique<IncompleteCholesky>();
        else
          preconditioner = std::make_unique<AmgHierarchy>();
        method = new_method;
      }
    preconditioner->set_block_size(block_size);
    if (auto *amg = dynamic_cast<AmgHierarchy *>(preconditioner.get()))
      amg->set_near_null_space(near_null_space);

    preconditioner->initialize(A);
    correction.clear();
    diagonal.reinit(A.locally_owned_range_indices(), A.get_mpi_communicator());
    copy_diagonal(A, diagonal);
    is_indefinite  = preconditioner->is_indefinite();
    rows           = A.locally_owned_range_indices();
    is_initialized = true;
    n_solves       = 0;
    surplus        = 0;

    renumbered_preconditioner.reset();
    is_renumbered = false;
    if (former_row_numbers.size() == A.m())
      std::iota(former_row_numbers.begin(),
                former_row_numbers.end(),
                rows.n_elements() > 0 ? 1. + rows.nth_index_in_set(0) : 1.);
    else
      former_row_numbers.reinit(0);
  }



  bool
  LinearSolver::can_be_reused(const LA::SparseMatrix &A) const
  {
    bool fits = is_initialized;
    if (is_renumbered)
      fits = fits && former_row_numbers.size() == A.m() &&
             former_row_numbers.locally_owned_size() == A.local_size();
    else
      fits =
        fits && rows.size() == A.m() && rows == A.locally_owned_range_indices();
    return dealii::Utilities::MPI::min(fits ? 1 : 0,
                                       A.get_mpi_communicator()) == 1 &&
           choose_method(A) == method;
  }



  void
  LinearSolver::correct(const LA::SparseMatrix &A)
  {
    LA::Vector today(A.locally_owned_range_indices(), A.get_mpi_communicator());
    LA::Vector former(today);
    copy_diagonal(A, today);
    if (renumbered_preconditioner)
      renumbered_preconditioner->transfer(diagonal, former);
    else
      former = diagonal;

    std::vector<int> changed_rows;
    for (unsigned int i = 0; i < today.locally_owned_size(); ++i)
      if (std::abs(today.begin()[i] - former.begin()[i]) >
          least_change * std::abs(today.begin()[i]))
        changed_rows.push_back(i);
    if (changed_rows.size() > most_changed * A.local_size() ||
        changed_rows.size() > LocalFactorization::largest_size())
      changed_rows.clear();
    correction.reinit(A, changed_rows);
  }



  unsigned int
  LinearSolver::cost_of_refresh() const
  {
    return std::max(additional_data.refresh_iterations, preconditioner->cost());
  }



  unsigned int
  LinearSolver::iterations_when_new(const double initial_residual,
                                    const double final_residual) const
  {
    return std::ceil(logarithmic_reduction(initial_residual, final_residual) /
                     reduction_when_new);
  }



  LinearSolver::Outcome
  LinearSolver::iterate(const LA::SparseMatrix &A,
                        LA::Vector             &x,
                        const LA::Vector       &b,
                        const double            tolerance,
                        const unsigned int      max_iterations,
                        const bool              use_gmres,
                        Report                 &report) const
  {
    const ObservedOperator<LA::SparseMatrix> matrix(
      A, !use_gmres, Observation::indefinite_matrix);

    SolverControl control(max_iterations, tolerance, false, false);
    Outcome       outcome = Outcome::converged;

    const auto solve_with = [&](const auto &stale) {
      using Corrected = CorrectedPreconditioner<std::decay_t<decltype(stale)>>;
      const Corrected                   P(stale, correction);
      const ObservedOperator<Corrected> inverse(
        P, !use_gmres, Observation::indefinite_preconditioner);
      if (use_gmres)
        {
          // Right preconditioning: the residual that is tested is the true
          // one.
          const SolverGMRES<LA::Vector>::AdditionalData data(52, true);
          SolverGMRES<LA::Vector>(control, data).solve(matrix, x, b, inverse);
        }
      else
        SolverCG<LA::Vector>(control).solve(matrix, x, b, inverse);
    };
    try
      {
        if (renumbered_preconditioner)
          solve_with(*renumbered_preconditioner);
        else
          solve_with(*preconditioner);
      }
    catch (const SolverControl::NoConvergence &)
      {
        outcome = Outcome::stagnated;
      }
    catch (const Observation observation)
      {
        if (observation == Observation::not_finite)
          outcome = Outcome::not_finite;
        else
          outcome = Outcome::indefinite;
        if (observation == Observation::indefinite_matrix)
          report.indefinite = true;
      }
    report.iterations += control.last_step();
    report.initial_residual = control.initial_value();
    report.final_residual   = control.last_value();

    // The iteration only updates its residual. With a matrix that is singular
    // up to round-off, that has nothing to do with the true one.
    if (outcome == Outcome::converged)
      {
        LA::Vector residual(b);
        report.final_residual = A.residual(residual, x, b);
        if (!(report.final_residual <=
              std::max(10. * tolerance, acceptable_residual * b.l2_norm())))
          outcome = Outcome::singular;
      }
    return outcome;
  }



  LinearSolver::Report
  LinearSolver::solve(const LA::SparseMatrix &A,
                      LA::Vector             &x,
                      const LA::Vector       &b)
  {
    return solve(A, x, b, additional_data.relative_tolerance);
  }



  LinearSolver::Report
  LinearSolver::solve(const LA::SparseMatrix &A,
                      LA::Vector             &x,
                      const LA::Vector       &b,
                      const double            relative_tolerance)
  {
    Report report;

    const double norm_of_b = b.l2_norm();
    AssertThrow(std::isfinite(norm_of_b),
                ExcSolverFailure("The right hand side has an entry that is not "
                                 "a finite number."));
    if (norm_of_b == 0.)
      {
        x = 0.;
        return report;
      }
    const double     tolerance = relative_tolerance * norm_of_b;
    const LA::Vector start(x);

    // First with what is there, if it fits. If it belongs to an indefinite
    // matrix, it is no preconditioner for conjugate gradients.
    if (can_be_reused(A))
      {
        if (is_renumbered && !renumbered_preconditioner)
          renumbered_preconditioner =
            std::make_unique<RenumberedPreconditioner>(*preconditioner,
                                                       rows,
                                                       former_row_numbers,
                                                       A);
        if (method != Method::cg_ic && !is_indefinite)
          correct(A);
        const Outcome outcome =
          iterate(A,
                  x,
                  b,
                  tolerance,
                  std::min(additional_data.max_iterations,
                           iterations_when_new(1., relative_tolerance) +
                             cost_of_refresh()),
                  is_indefinite || method == Method::gmres_amg,
                  report);
        if (outcome == Outcome::converged)
          {
            report.indefinite = is_indefinite;

            // Was this one too many?
            const unsigned int least =
              iterations_when_new(report.initial_residual,
                                  report.final_residual);
            const unsigned int excess =
              std::max(report.iterations, least) - least;
            ++n_solves;
            surplus += excess;
            if (n_solves * excess > cost_of_refresh() + surplus)
              invalidate();
            return report;
          }
        x = start;
      }

    // Then with a new one.
    refresh(A);
    is_indefinite    = is_indefinite || report.indefinite;
    report.refreshed = true;

    const unsigned int iterations_before = report.iterations;
    const auto         iterate_once      = [&]() {
      return iterate(A,
                     x,
                     b,
                     tolerance,
                     additional_data.max_iterations,
                     is_indefinite || method == Method::gmres_amg,
                     report);
    };
    Outcome outcome = iterate_once();
    if (outcome == Outcome::indefinite)
      {
        is_indefinite = true;
        x             = start;
        outcome       = iterate_once();
      }
    report.indefinite             = report.indefinite || is_indefinite;
    const unsigned int iterations = report.iterations - iterations_before;
    if (iterations > 0 && report.final_residual < report.initial_residual)
      reduction_when_new =
        logarithmic_reduction(report.initial_residual, report.final_residual) /
        iterations;

    if (outcome != Outcome::converged)
      {
        is_initialized = false;
        AssertThrow(outcome != Outcome::not_finite &&
                      std::isfinite(report.final_residual),
                    ExcSolverFailure(
                      "The linear solver (" + preconditioner->name() +
                      ") produced numbers that are not finite."));
        const std::string residual =
          std::to_string(report.final_residual / norm_of_b);
        AssertThrow(outcome != Outcome::singular,
                    ExcSolverFailure("The matrix is singular up to round-off: "
                                     "the linear solver (" +
                                     preconditioner->name() +
                                     ") leaves a relative residual of " +
                                     residual + "."));
        AssertThrow(false,
                    ExcSolverFailure(
                      "The linear solver (" + preconditioner->name() +
                      ") stagnates: after " + std::to_string(iterations) +
                      " iterations the relative residual is " + residual +
                      "."));
      }
    return report;
  }



  bool
  LinearSolver::is_found_indefinite(const LA::SparseMatrix &A)
  {
    refresh(A);
    return is_indefinite;
  }



  LinearSolver::Method
  LinearSolver::method_from_name(const std::string &name)
  {
    if (name == "automatic")
      return Method::automatic;
    if (name == "MUMPS")
      return Method::mumps;
    if (name == "KLU")
      return Method::klu;
    if (name == "CG+AMG")
      return Method::cg_amg;
    if (name == "CG+IC")
      return Method::cg_ic;
    AssertThrow(name == "GMRES+AMG",
                ExcParameter("Linear solver/Method",
                             name,
                             "one of " + method_names()));
    return Method::gmres_amg;
  }



  std::string
  LinearSolver::method_names()
  {
    return "automatic|MUMPS|KLU|CG+AMG|GMRES+AMG|CG+IC";
  }
} // namespace EBSMPM
