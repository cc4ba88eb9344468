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

// With GCC and Linux on x86, the kernel is compiled for several instruction
// sets, and the best one for the machine is taken at run time: a portable
// binary, as Debian builds them, thereby uses AVX where there is AVX.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
  defined(__linux__)
#  define EBSMPM_HAVE_X86_TARGETS
#endif

namespace EBSMPM
{
  namespace DenseKernels
  {
    namespace
    {
      /**
       * Numbers next to each other in memory, as many as fit into a register.
       * Left to itself with arrays, the compiler turns the loops below into
       * shuffles of pairs; with vectors that are longer than a register, it
       * keeps them in memory. Both is five times slower.
       */
      template <unsigned int n_bytes>
      struct Lanes
      {
        typedef double type
          __attribute__((vector_size(n_bytes), aligned(8), may_alias));

        static constexpr unsigned int n = n_bytes / sizeof(double);
      };



      /**
       * Compute a tile of C of n_rows times n_vectors vectors, which stays in
       * registers while the inner dimension is summed up.
       */
      template <unsigned int n_bytes, unsigned int n_rows, unsigned int n_vectors>
      inline __attribute__((always_inline)) void
      tile(const unsigned int n_inner,
           const unsigned int n_columns,
           const double *     A,
           const unsigned int lda,
           const double *     B,
           double *           C)
      {
        using Vector             = typename Lanes<n_bytes>::type;
        constexpr unsigned int n = Lanes<n_bytes>::n;

        Vector sum[n_rows][n_vectors] = {};
        for (unsigned int k = 0; k < n_inner; ++k, A += lda, B += n_columns)
          for (unsigned int v = 0; v < n_vectors; ++v)
            {
              const Vector b = *reinterpret_cast<const Vector *>(B + n * v);
              for (unsigned int i = 0; i < n_rows; ++i)
                sum[i][v] += A[i] * b;
            }
        for (unsigned int i = 0; i < n_rows; ++i)
          for (unsigned int v = 0; v < n_vectors; ++v)
            *reinterpret_cast<Vector *>(C + i * n_columns + n * v) = sum[i][v];
      }



      /** Compute some rows of C, from tiles side by side. */
      template <unsigned int n_bytes, unsigned int n_rows, unsigned int n_vectors>
      inline __attribute__((always_inline)) void
      rows(const unsigned int n_inner,
           const unsigned int n_columns,
           const double *     A,
           const unsigned int lda,
           const double *     B,
           double *           C)
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
      inline __attribute__((always_inline)) void
      product(const unsigned int n_inner,
              const unsigned int n_rows,
              const unsigned int n_columns,
              const double *     A,
              const unsigned int lda,
              const double *     B,
              double *           C)
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



      using Product = void (*)(const unsigned int n_inner,
                               const unsigned int n_rows,
                               const unsigned int n_columns,
                               const double *     A,
                               const unsigned int lda,
                               const double *     B,
                               double *           C);

#ifdef EBSMPM_HAVE_X86_TARGETS
      __attribute__((target("avx512f,avx512vl,avx2,fma"))) void
      product_avx512(const unsigned int n_inner,
                     const unsigned int n_rows,
                     const unsigned int n_columns,
                     const double *     A,
                     const unsigned int lda,
                     const double *     B,
                     double *           C)
      {
        product<64>(n_inner, n_rows, n_columns, A, lda, B, C);
      }



      __attribute__((target("avx2,fma"))) void
      product_avx2(const unsigned int n_inner,
                   const unsigned int n_rows,
                   const unsigned int n_columns,
                   const double *     A,
                   const unsigned int lda,
                   const double *     B,
                   double *           C)
      {
        product<32>(n_inner, n_rows, n_columns, A, lda, B, C);
      }
#endif



      Product
      best_product()
      {
#ifdef EBSMPM_HAVE_X86_TARGETS
        if (__builtin_cpu_supports("avx512f") &&
            __builtin_cpu_supports("avx512vl"))
          return product_avx512;
        if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
          return product_avx2;
#endif
        return product<16>;
      }
    } // namespace



    void
    transposed_product(const unsigned int n_inner,
                       const unsigned int n_rows,
                       const unsigned int n_columns,
                       const double *     A,
                       const unsigned int lda,
                       const double *     B,
                       double *           C)
    {
      Assert(n_columns % padding == 0,
             ExcMessage("Rows are not padded, see DenseKernels::padding."));
      static const Product best = best_product();
      best(n_inner, n_rows, n_columns, A, lda, B, C);
    }
  } // namespace DenseKernels
} // namespace EBSMPM
