// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/dense_kernels.h>

#include <deal.II/base/exceptions.h>

namespace EBSMPM
{
  namespace DenseKernels
  {
    namespace
    {
      /**
       * A tile of C, n_rows times 'padding', which stays in registers while the
       * inner dimension is summed up.
       */
      template <unsigned int n_rows>
      inline __attribute__((always_inline)) void
      tile(const unsigned int n_inner,
           const unsigned int n_columns,
           const double *     A,
           const unsigned int lda,
           const double *     B,
           double *           C)
      {
        double sum[n_rows][padding] = {};
        for (unsigned int k = 0; k < n_inner; ++k, A += lda, B += n_columns)
          for (unsigned int i = 0; i < n_rows; ++i)
            {
              const double a = A[i];
              for (unsigned int j = 0; j < padding; ++j)
                sum[i][j] += a * B[j];
            }
        for (unsigned int i = 0; i < n_rows; ++i)
          for (unsigned int j = 0; j < padding; ++j)
            C[i * n_columns + j] = sum[i][j];
      }
    } // namespace



    EBSMPM_TARGET_CLONES
    void
    transposed_product(const unsigned int n_inner,
                       const unsigned int n_rows,
                       const unsigned int n_columns,
                       const double *     A,
                       const unsigned int lda,
                       const double *     B,
                       double *           C)
    {
      for (unsigned int j = 0; j < n_columns; j += padding)
        {
          unsigned int i = 0;
          for (; i + 4 <= n_rows; i += 4)
            tile<4>(
              n_inner, n_columns, A + i, lda, B + j, C + i * n_columns + j);
          for (; i < n_rows; ++i)
            tile<1>(
              n_inner, n_columns, A + i, lda, B + j, C + i * n_columns + j);
        }
    }
  } // namespace DenseKernels
} // namespace EBSMPM
