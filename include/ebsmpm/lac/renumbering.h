// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_renumbering_h
#define ebsmpm_lac_renumbering_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/reusable_preconditioner.h>
#include <ebsmpm/lac/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/types.h>

#include <vector>

namespace EBSMPM
{
  /**
   * Which numbers unknowns had when a preconditioner was computed: what lets a
   * factorisation outlive a change of the numbering. LinearSolver is its user.
   *
   * When a body moves over the background grid, every now and then a function
   * becomes dependent, or independent again. That renumbers all unknowns behind
   * it, but changes the matrix only next to it. Let $P$ be the matrix of zeros
   * and ones that gives the unknowns their former numbers (a row without a one
   * is an unknown that is no more), and $M$ the preconditioner. Then
   * @f[
   *   P^T M^{-1} P + \operatorname{diag}(A)^{-1}_\text{new}
   * @f]
   * is one for the present numbering, symmetric and positive definite if $M$
   * is; the second term is for the unknowns that $M$ does not know. Each
   * function that changes costs conjugate gradients a few iterations at most.
   *
   * Unknowns may be renumbered any number of times, and move to other
   * processes with that. All functions are collective.
   */
  class Renumbering
  {
  public:
    /**
     * Constructor, for unknowns that still have the numbers of the
     * preconditioner, whose rows are given.
     */
    Renumbering(const IndexSet &rows, const MPI_Comm &communicator);

    /**
     * Give the unknowns new numbers.
     *
     * @param new_rows the new numbers that this process owns
     * @param old_numbers for each of them, the number before, owned by
     *   whichever process; numbers::invalid_dof_index for a new unknown
     */
    void
    renumber(const IndexSet &                            new_rows,
             const std::vector<types::global_dof_index> &old_numbers);

    /**
     * Take the diagonal that is needed for new unknowns from the present
     * matrix.
     */
    void
    set_diagonal(const LA::SparseMatrix &A);

    /**
     * Apply the preconditioner to vectors in the present numbering.
     */
    void
    vmult(const ReusablePreconditioner &M,
          LA::Vector &                  dst,
          const LA::Vector &            src) const;

  private:
    /** Numbers of the preconditioner, and the vectors it works on. */
    const IndexSet     original_rows;
    mutable LA::Vector original_src, original_dst;

    /** The present numbers, and which original ones belong to them. */
    IndexSet                             rows;
    std::vector<types::global_dof_index> original_numbers;

    /** $P^T$. */
    LA::SparseMatrix transposed_permutation;

    /** Rows without an original number, counted locally, and what they get. */
    std::vector<unsigned int> new_unknowns;
    std::vector<double>       inverse_diagonal;
  };
} // namespace EBSMPM

#endif
