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

namespace EBSMPM
{
  namespace DenseKernels
  {
    namespace
    {
      /**
       * Compute a tile of C of n_rows times n_vectors vectors, which stays in
       * registers while the inner dimension is summed up.
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
           double            *C)
      {
        using Vector             = typename Lanes<n_bytes>::type;
        constexpr unsigned int n = Lanes<n_bytes>::n;

        Vector sum[n_rows][n_vectors] = {};
        for (unsigned int k = 0; k < n_inner; ++k, A += lda, B += n_columns)
          for (unsigned int v = 0; v < n_vectors; ++v)
            {
              const Vector b = Lanes<n_bytes>::load(B + n * v);
              for (unsigned int i = 0; i < n_rows; ++i)
                sum[i][v] += A[i] * b;
            }
        for (unsigned int i = 0; i < n_rows; ++i)
          for (unsigned int v = 0; v < n_vectors; ++v)
            Lanes<n_bytes>::store(sum[i][v], C + i * n_columns + n * v);
      }



      /** Compute some rows of C, from tiles side by side. */
      template <unsigned int n_bytes,
                unsigned int n_rows,
                unsigned int n_vectors>
      EBSMPM_IN_EACH_TARGET void
      rows(const unsigned int n_inner,
           const unsigned int n_columns,
           const double      *A,
           const unsigned int lda,
           const double      *B,
           double            *C)
      {
        constexpr unsigned int width = n_vectors * Lanes<n_bytes>::n;
        static_assert(padding % width == 0, "Rows are whole tiles.");
        for (unsigned int j = 0; j < n_columns; j += width)
          tile<n_bytes, n_rows, n_vectors>(
            n_inner, n_columns, A, lda, B + j, C + j);
      }



      /**
       * The kernel for registers of the given size, of which there are sixteen
       * or more. Nine and 27 functions make tiles of three rows, others of
       * four. Sums that are too few do not hide the latency of an addition.
       */
      template <unsigned int n_bytes>
      EBSMPM_IN_EACH_TARGET void
      product(const unsigned int n_inner,
              const unsigned int n_rows,
              const unsigned int n_columns,
              const double      *A,
              const unsigned int lda,
              const double      *B,
              double            *C)
      {
        constexpr unsigned int wide   = (n_bytes == 64 ? 2 : 4);
        constexpr unsigned int narrow = 2;

        unsigned int i = 0;
        if (n_rows % 3 == 0)
          for (; i < n_rows; i += 3)
            rows<n_bytes, 3, wide>(
              n_inner, n_columns, A + i, lda, B, C + i * n_columns);
        for (; i + 4 <= n_rows; i += 4)
          rows<n_bytes, 4, narrow>(
            n_inner, n_columns, A + i, lda, B, C + i * n_columns);
        for (; i < n_rows; ++i)
          rows<n_bytes, 1, wide>(
            n_inner, n_columns, A + i, lda, B, C + i * n_columns);
      }



      EBSMPM_TARGET_AVX512 void
      product_avx512(const unsigned int n_inner,
                     const unsigned int n_rows,
                     const unsigned int n_columns,
                     const double      *A,
                     const unsigned int lda,
                     const double      *B,
                     double            *C)
      {
        product<64>(n_inner, n_rows, n_columns, A, lda, B, C);
      }



      EBSMPM_TARGET_AVX2 void
      product_avx2(const unsigned int n_inner,
                   const unsigned int n_rows,
                   const unsigned int n_columns,
                   const double      *A,
                   const unsigned int lda,
                   const double      *B,
                   double            *C)
      {
        product<32>(n_inner, n_rows, n_columns, A, lda, B, C);
      }



      /** See DenseKernels::row_products(). */
      template <unsigned int n_bytes>
      EBSMPM_IN_EACH_TARGET void
      dot_rows(const unsigned int n_inner,
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



      EBSMPM_TARGET_AVX512 void
      dot_rows_avx512(const unsigned int n_inner,
                      const unsigned int n_rows,
                      const double      *A,
                      const unsigned int n_columns,
                      const double      *B,
                      const unsigned int ld,
                      double            *C)
      {
        dot_rows<64>(n_inner, n_rows, A, n_columns, B, ld, C);
      }



      EBSMPM_TARGET_AVX2 void
      dot_rows_avx2(const unsigned int n_inner,
                    const unsigned int n_rows,
                    const double      *A,
                    const unsigned int n_columns,
                    const double      *B,
                    const unsigned int ld,
                    double            *C)
      {
        dot_rows<32>(n_inner, n_rows, A, n_columns, B, ld, C);
      }



      /** See DenseKernels::combine_rows(). */
      template <int n_rows, unsigned int n_bytes>
      EBSMPM_IN_EACH_TARGET void
      combine(const unsigned int n_points,
              const unsigned int n_blocks,
              const unsigned int n,
              const double      *c,
              const unsigned int ldc,
              const double      *G,
              const unsigned int ldg,
              double            *B,
              const unsigned int ldb)
      {
        using L = Lanes<n_bytes>;
        for (unsigned int p = 0; p < n_points; ++p, G += n_rows * ldg)
          for (unsigned int j = 0; j < n_rows; ++j, B += ldb)
            for (unsigned int block = 0; block < n_blocks; ++block)
              {
                const double *c_p = c + (block * n_rows + j) * n_rows * ldc + p;
                double       *row = B + block * n;
                // The last vector reaches into the next block or row, which is
                // yet to come, or into the padding, with zeros.
                for (unsigned int J = 0; J < n; J += L::n)
                  {
                    typename L::type sum = c_p[0] * L::load(G + J);
                    for (unsigned int l = 1; l < n_rows; ++l)
                      sum += c_p[l * ldc] * L::load(G + l * ldg + J);
                    L::store(sum, row + J);
                  }
              }
      }



      template <int n_rows>
      EBSMPM_TARGET_AVX512 void
      combine_avx512(const unsigned int n_points,
                     const unsigned int n_blocks,
                     const unsigned int n,
                     const double      *c,
                     const unsigned int ldc,
                     const double      *G,
                     const unsigned int ldg,
                     double            *B,
                     const unsigned int ldb)
      {
        combine<n_rows, 64>(n_points, n_blocks, n, c, ldc, G, ldg, B, ldb);
      }



      template <int n_rows>
      EBSMPM_TARGET_AVX2 void
      combine_avx2(const unsigned int n_points,
                   const unsigned int n_blocks,
                   const unsigned int n,
                   const double      *c,
                   const unsigned int ldc,
                   const double      *G,
                   const unsigned int ldg,
                   double            *B,
                   const unsigned int ldb)
      {
        combine<n_rows, 32>(n_points, n_blocks, n, c, ldc, G, ldg, B, ldb);
      }
    } // namespace



    void
    transposed_product(const unsigned int n_inner,
                       const unsigned int n_rows,
                       const unsigned int n_columns,
                       const double      *A,
                       const unsigned int lda,
                       const double      *B,
                       double            *C)
    {
      Assert(n_columns % padding == 0,
             ExcMessage("Rows are not padded, see DenseKernels::padding."));
      static const auto best =
        select_kernel(product_avx512, product_avx2, product<16>);
      best(n_inner, n_rows, n_columns, A, lda, B, C);
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
      static const auto best =
        select_kernel(dot_rows_avx512, dot_rows_avx2, dot_rows<16>);
      best(n_inner, n_rows, A, n_columns, B, ld, C);
    }



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
                 const unsigned int ldb)
    {
      Assert(ldg >= padded(n) && ldb >= padded(n_blocks * n),
             ExcMessage("Rows are not padded, see DenseKernels::padding."));
      static const auto best = select_kernel(combine_avx512<n_rows>,
                                             combine_avx2<n_rows>,
                                             combine<n_rows, 16>);
      best(n_points, n_blocks, n, c, ldc, G, ldg, B, ldb);
    }



    template void
    combine_rows<2>(const unsigned int,
                    const unsigned int,
                    const unsigned int,
                    const double *,
                    const unsigned int,
                    const double *,
                    const unsigned int,
                    double *,
                    const unsigned int);
    template void
    combine_rows<3>(const unsigned int,
                    const unsigned int,
                    const unsigned int,
                    const double *,
                    const unsigned int,
                    const double *,
                    const unsigned int,
                    double *,
                    const unsigned int);
    template void
    combine_rows<4>(const unsigned int,
                    const unsigned int,
                    const unsigned int,
                    const double *,
                    const unsigned int,
                    const double *,
                    const unsigned int,
                    double *,
                    const unsigned int);
  } // namespace DenseKernels
} // namespace EBSMPM
