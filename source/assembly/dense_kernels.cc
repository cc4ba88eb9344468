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
       * Eight numbers next to each other in memory. The compiler makes of them
       * what the instruction set has; left to itself with arrays, it turns the
       * loops below into shuffles of pairs and spills the sums.
       */
      using Lanes = double __attribute__((vector_size(64), aligned(8), may_alias));
      constexpr unsigned int n_lanes = 8;
      constexpr unsigned int n_vectors = padding / n_lanes;



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
        Lanes sum[n_rows][n_vectors] = {};
        for (unsigned int k = 0; k < n_inner; ++k, A += lda, B += n_columns)
          for (unsigned int v = 0; v < n_vectors; ++v)
            {
              const Lanes b =
                *reinterpret_cast<const Lanes *>(B + n_lanes * v);
              for (unsigned int i = 0; i < n_rows; ++i)
                sum[i][v] += A[i] * b;
            }
        for (unsigned int i = 0; i < n_rows; ++i)
          for (unsigned int v = 0; v < n_vectors; ++v)
            *reinterpret_cast<Lanes *>(C + i * n_columns + n_lanes * v) =
              sum[i][v];
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
          // Sums that are too few do not hide the latency of an addition.
          // Nine and 27 functions are tiles of three rows, the others of four.
          unsigned int i = 0;
          if (n_rows % 3 == 0)
            for (; i < n_rows; i += 3)
              tile<3>(
                n_inner, n_columns, A + i, lda, B + j, C + i * n_columns + j);
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
