// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_renumbered_preconditioner_h
#define ebsmpm_lac_renumbered_preconditioner_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/reusable_preconditioner.h>
#include <ebsmpm/lac/types.h>

#include <deal.II/base/index_set.h>

#include <Epetra_Export.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>

#include <memory>
#include <vector>

namespace EBSMPM
{
  /**
   * A preconditioner $P$ computed with other unknowns than those of today.
   *
   * From one load step to the next, a few functions become deficient or cease
   * to be so, or get a twin; all others have new numbers at most. With the
   * matrix $R$ that picks, for each former unknown, the one that it is today,
   * and a diagonal matrix for those that are new, this class applies
   * @f[
   *   R^T P R + N\,\mathrm{diag}(A)^{-1} N^T ,
   * @f]
   * which is symmetric and positive definite if $P$ is. A former unknown that
   * no longer exists is free, which is little different from being bound to its
   * neighbours where the body hardly reaches.
   */
  class RenumberedPreconditioner
  {
  public:
    /**
     * Constructor. Collective.
     *
     * @param preconditioner $P$; it must live as long as this object
     * @param former_rows_owned the rows of $P$ on this process
     * @param former_rows for each unknown of today, one plus the number that it
     *   had in $P$, or zero if it is new
     * @param A the matrix of today, of which the diagonal is read
     */
    RenumberedPreconditioner(const ReusablePreconditioner &preconditioner,
                             const IndexSet               &former_rows_owned,
                             const LA::FieldVector        &former_rows,
                             const LA::SparseMatrix       &A);

    /**
     * Apply to a vector, both of which are distributed like the unknowns of
     * today. Collective.
     */
    void
    vmult(LA::Vector &dst, const LA::Vector &src) const;

    /**
     * Give each unknown of today the value that it has in @p former, which is
     * distributed like the rows of $P$, and those that are new zero.
     * Collective.
     */
    void
    transfer(const LA::Vector &former, LA::Vector &today) const;

  private:
    const ReusablePreconditioner &preconditioner;

    /** The unknowns that are new, and one over their diagonal entries. */
    std::vector<int>    new_rows;
    std::vector<double> inverse_diagonal;

    /** The others, and the way to the process that had them. */
    std::vector<int>               known_rows;
    std::unique_ptr<Epetra_Map>    known_map;
    std::unique_ptr<Epetra_Export> to_former;

    /** Scratch. */
    std::unique_ptr<Epetra_Vector> known;
    mutable LA::Vector             former_src;
    mutable LA::Vector             former_dst;
  };
} // namespace EBSMPM

#endif
