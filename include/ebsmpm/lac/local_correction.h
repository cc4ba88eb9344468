// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_local_correction_h
#define ebsmpm_lac_local_correction_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/local_factorization.h>
#include <ebsmpm/lac/types.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>

#include <memory>
#include <vector>

namespace EBSMPM
{
  /**
   * What makes a preconditioner that is out of date in a few rows good again:
   * the inverse of the present matrix there.
   *
   * When a crack runs, the matrix changes a lot at its tip, and hardly
   * elsewhere. A factorisation $P$ from before has then some hundred wrong rows
   * among ten thousands of good ones. With the matrix $R$ that picks the wrong
   * ones, and $L=R^T(RAR^T)^{-1}R$, this class solves there, then applies $P$
   * to what is left, and solves there again:
   * @f[
   *   I - MA = (I-LA)\,(I-PA)\,(I-LA),
   * @f]
   * a multiplicative Schwarz preconditioner $M$ whose coarse space is almost
   * everything. It is symmetric if $A$ and $P$ are. (The sum $P+L$ would be
   * simpler, but takes twice as many iterations.)
   *
   * Each process inverts its own rows, independently of the others; only
   * products with rows of the matrix communicate. All functions are collective.
   */
  class LocalCorrection
  {
  public:
    /**
     * Factorise a part of the matrix @p A, which is symmetric. A process whose
     * part is singular corrects nothing.
     *
     * @param A the matrix; it is not needed any more afterwards
     * @param rows the local numbers of the rows, in ascending order
     */
    void
    reinit(const LA::SparseMatrix &A, const std::vector<int> &rows);

    /** Correct nothing. */
    void
    clear();

    /** Apply the corrected @p preconditioner $P$: @p dst $=M$ @p src. */
    template <typename Preconditioner>
    void
    vmult(const Preconditioner &preconditioner,
          LA::Vector           &dst,
          const LA::Vector     &src) const
    {
      if (!rows_of_matrix)
        {
          preconditioner.vmult(dst, src);
          return;
        }
      begin(src);
      preconditioner.vmult(dst, remainder);
      finish(dst, src);
    }

  private:
    /** Solve in the rows for @p src, and find the #remainder. */
    void
    begin(const LA::Vector &src) const;

    /** Add that solution to @p dst, and that for what is still left. */
    void
    finish(LA::Vector &dst, const LA::Vector &src) const;

    /** The rows of this process, in all columns, and the inverse. */
    std::vector<int>                  rows;
    std::unique_ptr<Epetra_CrsMatrix> rows_of_matrix;
    LocalFactorization                inverse;

    /** Scratch: in the rows, and everywhere. */
    std::unique_ptr<Epetra_Vector> part;
    mutable LA::Vector             remainder;
    mutable LA::Vector             product;
  };
} // namespace EBSMPM

#endif
