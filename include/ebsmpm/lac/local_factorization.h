// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_local_factorization_h
#define ebsmpm_lac_local_factorization_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/types.h>

#include <memory>
#include <vector>

namespace EBSMPM
{
  class ReusablePreconditioner;

  /**
   * The inverse of a small part of a matrix: of some rows of this process, in
   * the columns of the same numbers. Nothing is communicated.
   *
   * @code
   * LocalFactorization inverse;
   * inverse.reinit(A, rows);
   * inverse.solve(values); // in place
   * @endcode
   *
   * KLU is the quicker one for up to a thousand rows, and MUMPS beyond.
   */
  class LocalFactorization
  {
  public:
    LocalFactorization();

    ~LocalFactorization();

    /** The number of rows up to which it is quick: tenths of a second. */
    static unsigned int
    largest_size();

    /**
     * Factorise.
     *
     * @param A the matrix; it is not needed any more afterwards
     * @param rows the local numbers of the rows, in ascending order
     */
    void
    reinit(const LA::SparseMatrix &A, const std::vector<int> &rows);

    /**
     * Solve for a right hand side of as many entries as there are rows, in
     * place. The solution is zero if the part is singular.
     */
    void
    solve(double *values) const;

  private:
    unsigned int                            n = 0;
    std::unique_ptr<ReusablePreconditioner> factorization;
    mutable LA::Vector                      src;
    mutable LA::Vector                      dst;
  };
} // namespace EBSMPM

#endif
