// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_dense_kernels_h
#define ebsmpm_assembly_dense_kernels_h

#include <ebsmpm/base/config.h>

namespace EBSMPM
{
  /**
   * Small dense kernels of the assembly. They are compiled for several
   * instruction sets, of which the best one is chosen at run time.
   */
  namespace DenseKernels
  {
    /**
     * Row lengths of the arrays below must be multiples of this number of
     * doubles; the padding must be zero.
     */
    constexpr unsigned int padding = 16;

    /** Return @p n rounded up to a multiple of #padding. */
    inline constexpr unsigned int
    padded(const unsigned int n)
    {
      return (n + padding - 1) / padding * padding;
    }

    /**
     * Compute $C = A^T B$, the product that every stiffness matrix is made of:
     * the sum over all points of a cell, $k$, is the inner dimension.
     *
     * @param n_inner number of rows of @p A and @p B
     * @param n_rows number of columns of @p A, rows of @p C
     * @param n_columns number of columns of @p B and @p C, a multiple of
     *   #padding
     * @param A row by row, rows being @p lda apart
     * @param B row by row, rows being @p n_columns apart
     * @param C row by row, rows being @p n_columns apart
     */
    void
    transposed_product(const unsigned int n_inner,
                       const unsigned int n_rows,
                       const unsigned int n_columns,
                       const double *     A,
                       const unsigned int lda,
                       const double *     B,
                       double *           C);
  } // namespace DenseKernels
} // namespace EBSMPM

#endif
