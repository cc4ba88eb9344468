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
                       const double      *A,
                       const unsigned int lda,
                       const double      *B,
                       double            *C);

    /**
     * Compute $C^T = A B^T$, the products of few rows with many: the gradients
     * of the components of a field at all points.
     *
     * @param n_inner length of all rows, which are @p ld apart; up to the next
     *   multiple of #padding, they are zero
     * @param n_rows, @p A the few rows
     * @param n_columns, @p B the many rows
     * @param C <tt>C[j*n_rows+i]</tt> is the product of row $i$ of @p A and row
     *   $j$ of @p B
     */
    void
    row_products(const unsigned int n_inner,
                 const unsigned int n_rows,
                 const double      *A,
                 const unsigned int n_columns,
                 const double      *B,
                 const unsigned int ld,
                 double            *C);

    /**
     * Combine rows that belong to the same point: block $b$ of row $(p,j)$ of
     * @p B becomes $\sum_l c^b_{jl}(p)\,G_{(p,l)}$.
     *
     * @param n_points number of points $p$; there are n_rows rows for each
     * @param n_blocks number of blocks; block $b$ begins at column $bn$
     * @param n length of a row of @p G
     * @param c <tt>c[((b*n_rows+j)*n_rows+l)*ldc+p]</tt> is $c^b_{jl}(p)$
     * @param G, @p B row by row, rows being @p ldg and @p ldb apart; rows of
     *   @p G are zero up to the next multiple of #padding, and those of @p B
     *   will be; behind the last row of @p B, there must be room for #padding
     *   numbers
     */
    template <int n_rows>
    void
    combine_rows(const unsigned int n_points,
                 const unsigned int n_blocks,
                 const unsigned int n,
                 const double      *c,
                 const unsigned int ldc,
                 const double      *G,
                 const unsigned int ldg,
                 double            *B,
                 const unsigned int ldb);
  } // namespace DenseKernels
} // namespace EBSMPM

#endif
