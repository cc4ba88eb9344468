// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/lanes.h>

#include <ebsmpm/assembly/dense_kernels.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace EBSMPM
{
  namespace DenseKernels
  {
    namespace
    {
      /**
       * A tile of C of n_rows times n_vectors vectors, which stays in registers
       * while the inner dimension is summed up.
       */
      template <unsigned int n_bytes,
                unsigned int n_rows,
                unsigned int n_vectors>
      EBSMPM_IN_EACH_TARGET void
      tile(const unsigned int n_inner,
           const unsigned int n_columns,
           const double      *A,
           const unsigned int lda,
           const double      *B,
           double            *C,
           const bool         add)
      {
        using L = Lanes<n_bytes>;

        typename L::type sum[n_rows][n_vectors] = {};
        for (unsigned int k = 0; k < n_inner; ++k, A += lda, B += n_columns)
          for (unsigned int v = 0; v < n_vectors; ++v)
            {
              const typename L::type b = L::load(B + L::n * v);
              for (unsigned int i = 0; i < n_rows; ++i)
                sum[i][v] += A[i] * b;
            }
        for (unsigned int i = 0; i < n_rows; ++i)
          for (unsigned int v = 0; v < n_vectors; ++v)
            {
              double *const c = C + i * n_columns + L::n * v;
              L::store(add ? L::load(c) + sum[i][v] : sum[i][v], c);
            }
      }



      /** Rows of tiles, below each other, in some columns of C. */
      template <unsigned int n_bytes, unsigned int n_vectors>
      EBSMPM_IN_EACH_TARGET void
      panel(const unsigned int n_inner,
            const unsigned int n_rows,
            const unsigned int n_columns,
            const double      *A,
            const unsigned int lda,
            const double      *B,
            double            *C,
            const bool         add)
      {
        unsigned int i = 0;
        if (n_rows % 3 == 0)
          for (; i < n_rows; i += 3)
            tile<n_bytes, 3, n_vectors>(
              n_inner, n_columns, A + i, lda, B, C + i * n_columns, add);

        constexpr unsigned int narrow = std::min(n_vectors, 2U);
        for (; i + 4 <= n_rows; i += 4)
          for (unsigned int v = 0; v < n_vectors; v += narrow)
            {
              const unsigned int j = v * Lanes<n_bytes>::n;
              tile<n_bytes, 4, narrow>(n_inner,
                                       n_columns,
                                       A + i,
                                       lda,
                                       B + j,
                                       C + i * n_columns + j,
                                       add);
            }
        for (; i < n_rows; ++i)
          tile<n_bytes, 1, n_vectors>(
            n_inner, n_columns, A + i, lda, B, C + i * n_columns, add);
      }



      /**
       * DenseKernels::transposed_product() for registers of which there are
       * sixteen or more. It goes along columns of the width of a tile, so that
       * these columns of B, and all of A, stay in the first cache. Nine and 27
       * functions make tiles of three rows, others of four. Sums that are too
       * few do not hide the latency of an addition.
       */
      struct TransposedProduct
      {
        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        run(const unsigned int n_inner,
            const unsigned int n_rows,
            const unsigned int n_columns,
            const double      *A,
            const unsigned int lda,
            const double      *B,
            double            *C,
            const bool         add,
            const unsigned int block_size)
        {
          constexpr unsigned int n_vectors = (n_bytes == 64 ? 2 : 4);
          constexpr unsigned int width     = n_vectors * Lanes<n_bytes>::n;
          constexpr unsigned int few       = padding / Lanes<n_bytes>::n;

          const auto rows_of = [&](const unsigned int end_column) {
            // Whole tiles of three rows or of four.
            const unsigned int height = (n_rows % 3 == 0 ? 3 : 4);
            return block_size == 0 ?
                     n_rows :
                     std::min(n_rows,
                              (end_column + height * block_size - 1) /
                                (height * block_size) * height);
          };
          unsigned int j = 0;
          for (; j + width <= n_columns; j += width)
            panel<n_bytes, n_vectors>(n_inner,
                                      rows_of(j + width),
                                      n_columns,
                                      A,
                                      lda,
                                      B + j,
                                      C + j,
                                      add);
          for (; j < n_columns; j += padding)
            panel<n_bytes, few>(n_inner,
                                rows_of(j + padding),
                                n_columns,
                                A,
                                lda,
                                B + j,
                                C + j,
                                add);
        }
      };



      /** See DenseKernels::row_products(). */
      struct RowProducts
      {
        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        run(const unsigned int n_inner,
            const unsigned int n_rows,
            const double      *A,
            const unsigned int n_columns,
            const double      *B,
            const unsigned int ld,
            double            *C)
        {
          using L = Lanes<n_bytes>;
          for (unsigned int j = 0; j < n_columns; ++j)
            for (unsigned int i = 0; i < n_rows; ++i)
              {
                typename L::type sum = {};
                for (unsigned int k = 0; k < n_inner; k += L::n)
                  sum += L::load(A + i * ld + k) * L::load(B + j * ld + k);
                double total = sum[0];
                for (unsigned int l = 1; l < L::n; ++l)
                  total += sum[l];
                C[j * n_rows + i] = total;
              }
        }
      };



      /** See DenseKernels::combine_rows(). */
      template <int dim, int n_rows>
      struct CombineRows
      {
        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        run(const unsigned int n_points,
            const unsigned int n,
            const double      *c,
            const unsigned int ldc,
            const double      *G,
            const unsigned int ldg,
            double            *B,
            const unsigned int ldb)
        {
          using L                       = Lanes<n_bytes>;
          constexpr unsigned int n_both = dim * dim;
          constexpr unsigned int n_v    = (n_both + L::n - 1) / L::n;
          const unsigned int     step   = n_rows * ldc;

          double coefficients[n_rows][n_v * L::n] = {};
          for (unsigned int p = 0; p < n_points; ++p, ++c, G += n_rows * ldg)
            for (unsigned int j = 0; j < n_rows; ++j, B += ldb)
              {
                const double *of_pair = c;
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int k = i; k < dim; ++k)
                    {
                      for (unsigned int l = 0; l < n_rows; ++l)
                        {
                          coefficients[l][i * dim + k] =
                            of_pair[j * step + l * ldc];
                          coefficients[l][k * dim + i] =
                            of_pair[l * step + j * ldc];
                        }
                      of_pair += n_rows * step;
                    }
                typename L::type c_j[n_rows][n_v];
                for (unsigned int l = 0; l < n_rows; ++l)
                  for (unsigned int v = 0; v < n_v; ++v)
                    c_j[l][v] = L::load(coefficients[l] + v * L::n);

                // The last vector reaches into the next block, which is yet to
                // come, or into the padding, with zeros.
                double *b = B;
                for (unsigned int J = 0; J < n; ++J, b += n_both)
                  for (unsigned int v = 0; v < n_v; ++v)
                    {
                      typename L::type sum = c_j[0][v] * G[J];
                      for (unsigned int l = 1; l < n_rows; ++l)
                        sum += c_j[l][v] * G[l * ldg + J];
                      L::store(sum, b + v * L::n);
                    }
              }
        }
      };
    } // namespace



    void
    transposed_product(const unsigned int n_inner,
                       const unsigned int n_rows,
                       const unsigned int n_columns,
                       const double      *A,
                       const unsigned int lda,
                       const double      *B,
                       double            *C,
                       const bool         add,
                       const unsigned int block_size)
    {
      Assert(n_columns % padding == 0,
             ExcMessage("Rows are not padded, see DenseKernels::padding."));
      run_best<TransposedProduct>(
        n_inner, n_rows, n_columns, A, lda, B, C, add, block_size);
    }



    template <int dim>
    void
    complete_symmetric(const unsigned int n, const unsigned int ld, double *C)
    {
      for (unsigned int I = 1; I < n; ++I)
        for (unsigned int J = 0; J < I; ++J)
          {
            const double *from = C + J * ld + I * dim * dim;
            double       *to   = C + I * ld + J * dim * dim;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int k = 0; k < dim; ++k)
                to[i * dim + k] = from[k * dim + i];
          }
    }



    void
    row_products(const unsigned int n_inner,
                 const unsigned int n_rows,
                 const double      *A,
                 const unsigned int n_columns,
                 const double      *B,
                 const unsigned int ld,
                 double            *C)
    {
      Assert(ld >= padded(n_inner),
             ExcMessage("Rows are not padded, see DenseKernels::padding."));
      run_best<RowProducts>(n_inner, n_rows, A, n_columns, B, ld, C);
    }



    template <int dim, int n_rows>
    void
    combine_rows(const unsigned int n_points,
                 const unsigned int n,
                 const double      *c,
                 const unsigned int ldc,
                 const double      *G,
                 const unsigned int ldg,
                 double            *B,
                 const unsigned int ldb)
    {
      run_best<CombineRows<dim, n_rows>>(n_points, n, c, ldc, G, ldg, B, ldb);
    }



    template void
    complete_symmetric<1>(const unsigned int, const unsigned int, double *);
    template void
    complete_symmetric<2>(const unsigned int, const unsigned int, double *);
    template void
    complete_symmetric<3>(const unsigned int, const unsigned int, double *);

    template void
    combine_rows<2, 2>(const unsigned int,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       double *,
                       const unsigned int);
    template void
    combine_rows<2, 3>(const unsigned int,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       double *,
                       const unsigned int);
    template void
    combine_rows<3, 3>(const unsigned int,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       double *,
                       const unsigned int);
    template void
    combine_rows<3, 4>(const unsigned int,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       double *,
                       const unsigned int);
  } // namespace DenseKernels
} // namespace EBSMPM
