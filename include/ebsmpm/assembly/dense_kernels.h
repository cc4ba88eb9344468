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

#include <ebsmpm/base/block_row.h>

namespace EBSMPM
{
  /**
   * Small dense kernels of the assembly. They are compiled for several
   * instruction sets, of which the best one is chosen at run time.
   */
  namespace DenseKernels
  {
    /**
     * Compute $C = A^T B$, or add it to $C$.
     *
     * @param n_inner number of rows of @p A and @p B
     * @param n_rows number of columns of @p A, rows of @p C
     * @param n_columns number of columns of @p B and @p C, padded()
     * @param A row by row, rows being @p lda apart
     * @param B, @p C row by row, rows being @p n_columns apart
     * @param add whether to add to @p C instead of overwriting it
     */
    void
    transposed_product(const unsigned int n_inner,
                       const unsigned int n_rows,
                       const unsigned int n_columns,
                       const double      *A,
                       const unsigned int lda,
                       const double      *B,
                       double            *C,
                       const bool         add = false);

    /**
     * Compute $C = A^T B$, or add it to $C$, if $C$ is symmetric and its rows
     * are rows of blocks, see BlockRow: the product that every stiffness matrix
     * is made of. The sum over all points of a cell is the inner dimension.
     * Blocks before the diagonal are not wanted (but some of them computed),
     * see complete_symmetric().
     *
     * @param n_inner number of rows of @p A and @p B
     * @param n number of rows of @p C, and of blocks in a row of @p B and @p C
     * @param A row by row, rows being @p lda apart
     * @param B, @p C row by row
     * @param add whether to add to @p C instead of overwriting it
     */
    template <int n_components>
    void
    symmetric_product(const unsigned int n_inner,
                      const unsigned int n,
                      const double      *A,
                      const unsigned int lda,
                      const double      *B,
                      double            *C,
                      const bool         add = false);

    /**
     * Complete a symmetric matrix of n x n blocks, of which those on and above
     * the diagonal are there.
     */
    template <int n_components>
    void
    complete_symmetric(const unsigned int n, double *C);

    /**
     * Compute $C = A B^T$, the products of few rows with many: the gradients of
     * the components of a field at all points.
     *
     * @param n_inner length of all rows, which are @p ld apart, and padded()
     *   with zeros
     * @param n_rows, @p A the few rows
     * @param n_columns, @p B the many rows
     * @param C <tt>C[i*ldc+j]</tt> is the product of row $i$ of @p A and row $j$
     *   of @p B
     * @param ldc distance between rows of @p C
     */
    void
    row_products(const unsigned int n_inner,
                 const unsigned int n_rows,
                 const double      *A,
                 const unsigned int n_columns,
                 const double      *B,
                 const unsigned int ld,
                 double            *C,
                 const unsigned int ldc);

    /**
     * Combine rows that belong to the same point, for all pairs of components
     * at once: $B_{(p,j),(Jik)} = \sum_l c_{ijkl}(p)\,G_{(p,l),J}$, with a
     * symmetric $c_{ijkl}=c_{klij}$.
     *
     * @param n_points number of points $p$; there are n_rows rows for each
     * @param n number of functions $J$
     * @param c <tt>c[((b*n_rows+j)*n_rows+l)*ldc+p]</tt> is $c_{ijkl}(p)$ for the
     *   pair $i\le k$ with number $b$ in lexicographic order; these arrays are
     *   read up to the next multiple of #max_n_short_lanes points
     * @param G row by row, rows being @p ldg apart and padded() with zeros
     * @param B row by row, each a BlockRow of @p n blocks
     */
    template <int dim, int n_rows>
    void
    combine_rows(const unsigned int n_points,
                 const unsigned int n,
                 const double      *c,
                 const unsigned int ldc,
                 const double      *G,
                 const unsigned int ldg,
                 double            *B);
  } // namespace DenseKernels
} // namespace EBSMPM

#endif
