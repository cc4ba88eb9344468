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
       * DenseKernels::transposed_product() for some columns of B and C. It goes
       * along panels, columns of the width of a tile, so that these columns of
       * B, and all of A, stay in the first cache; and in a panel downwards from
       * tile to tile, numbers of C that stay in registers while the inner
       * dimension is summed up. Tiles have as many sums as there are registers
       * for them: sums that are too few do not hide the latency of an addition.
       * But with wide tiles, much is computed in vain before the diagonal of a
       * symmetric matrix; where registers are long, one of them is enough.
       */
      template <unsigned int n_bytes>
      struct TransposedProductTiles
      {
        using L = Lanes<n_bytes>;

        /** Number of registers for the sums, the height beyond which tiles do
         * not become faster, and the width in registers. */
        static constexpr unsigned int n_registers   = 12;
        static constexpr unsigned int max_height    = 9;
        static constexpr unsigned int max_n_vectors = (n_bytes == 64 ? 1 : 4);

        const unsigned int n_inner;
        const unsigned int n_rows;
        const unsigned int n_columns;
        const double      *A;
        const unsigned int lda;
        const double      *B;
        double            *C;
        const unsigned int ld;
        const bool         add;
        const unsigned int block_size;

        /** Panels of so many vectors from column j on, then narrower ones. */
        template <unsigned int n_vectors = max_n_vectors>
        EBSMPM_IN_EACH_TARGET void
        panels(unsigned int j = 0) const
        {
          constexpr unsigned int width = n_vectors * L::n;
          for (; j + width <= n_columns; j += width)
            tiles<n_vectors, std::min(max_height, n_registers / n_vectors)>(
              n_rows_until(j + width), j);
          if constexpr (n_vectors > 1)
            panels<n_vectors - 1>(j);
        }

        /** The number of rows that are wanted in the columns before this. */
        EBSMPM_IN_EACH_TARGET unsigned int
        n_rows_until(const unsigned int end_column) const
        {
          return block_size == 0 ?
                   n_rows :
                   std::min(n_rows, (end_column + block_size - 1) / block_size);
        }

        /** Tiles of this height, as long as they fit, then lower ones. */
        template <unsigned int n_vectors, unsigned int height>
        EBSMPM_IN_EACH_TARGET void
        tiles(const unsigned int end_row,
              const unsigned int j,
              unsigned int       i = 0) const
        {
          for (; i + height <= end_row; i += height)
            tile<n_vectors, height>(A + i, B + j, C + i * ld + j);
          if constexpr (height > 1)
            tiles<n_vectors, height - 1>(end_row, j, i);
        }

        template <unsigned int n_vectors, unsigned int height>
        EBSMPM_IN_EACH_TARGET void
        tile(const double *a, const double *b, double *c) const
        {
          typename L::type sums[height][n_vectors] = {};
          for (unsigned int k = 0; k < n_inner; ++k, a += lda, b += ld)
            for (unsigned int v = 0; v < n_vectors; ++v)
              {
                const typename L::type b_v = L::load(b + L::n * v);
                for (unsigned int i = 0; i < height; ++i)
                  sums[i][v] += a[i] * b_v;
              }
          for (unsigned int i = 0; i < height; ++i, c += ld)
            for (unsigned int v = 0; v < n_vectors; ++v)
              {
                double *const to = c + L::n * v;
                L::store(add ? L::load(to) + sums[i][v] : sums[i][v], to);
              }
        }
      };



      /**
       * See DenseKernels::transposed_product() and symmetric_product(). If
       * there is a block size, columns of C are blocks of this size, one per
       * row, and those before the block of the row itself are not wanted.
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
            const unsigned int ld,
            const bool         add,
            const unsigned int block_size)
        {
          const TransposedProductTiles<n_bytes> product = {
            n_inner, n_rows, n_columns, A, lda, B, C, ld, add, block_size};
          product.panels();
        }
      };



      /**
       * See DenseKernels::row_products(). Registers of four numbers suffice for
       * rows of nine or 27. As many columns as a register has numbers are
       * summed up side by side.
       */
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
            double            *C,
            const unsigned int ldc)
        {
          using L = ShortLanes<n_bytes>;

          unsigned int j = 0;
          for (; j + L::n <= n_columns; j += L::n, B += L::n * ld)
            for (unsigned int i = 0; i < n_rows; ++i)
              {
                typename L::type sums[L::n] = {};
                for (unsigned int k = 0; k < n_inner; k += L::n)
                  {
                    const typename L::type a = L::load(A + i * ld + k);
                    for (unsigned int l = 0; l < L::n; ++l)
                      sums[l] += a * L::load(B + l * ld + k);
                  }
                L::store(L::totals(sums), C + i * ldc + j);
              }
          for (; j < n_columns; ++j, B += ld)
            for (unsigned int i = 0; i < n_rows; ++i)
              {
                double sum = 0.;
                for (unsigned int k = 0; k < n_inner; ++k)
                  sum += A[i * ld + k] * B[k];
                C[i * ldc + j] = sum;
              }
        }
      };



      /** See DenseKernels::combine_rows(). */
      template <int dim, int n_rows>
      struct CombineRows
      {
        using Row = BlockRow<dim>;

        static constexpr unsigned int head_size = Row::head_size;

        /**
         * The coefficients of the row $(p,j)$ for row $(p,l)$, the head of a
         * block for each pair of them, for some points.
         */
        struct Coefficients
        {
          static constexpr unsigned int n_points = max_n_short_lanes;

          double heads[n_points][n_rows][n_rows][head_size];

          template <unsigned int n_bytes>
          EBSMPM_IN_EACH_TARGET void
          fill(const double *c, const unsigned int ldc)
          {
            for (unsigned int j = 0; j < n_rows; ++j)
              for (unsigned int l = 0; l < n_rows; ++l)
                {
                  const double *of_pair[Row::block_size];
                  for (unsigned int i = 0, b = 0; i < dim; ++i)
                    for (unsigned int k = i; k < dim; ++k, ++b)
                      {
                        of_pair[k * dim + i] =
                          c + ((b * n_rows + l) * n_rows + j) * ldc;
                        of_pair[i * dim + k] =
                          c + ((b * n_rows + j) * n_rows + l) * ldc;
                      }
                  fill_pair<n_bytes>(of_pair, j, l);
                }
          }

          /** The heads of a pair of rows, from arrays over the points. */
          template <unsigned int n_bytes>
          EBSMPM_IN_EACH_TARGET void
          fill_pair(const double *const *of_pair,
                    const unsigned int   j,
                    const unsigned int   l)
          {
            using L = ShortLanes<n_bytes>;
            for (unsigned int p = 0; p < n_points; p += L::n)
              for (unsigned int b = 0; b < head_size; b += L::n)
                {
                  typename L::type v[L::n];
                  for (unsigned int w = 0; w < L::n; ++w)
                    v[w] = L::load(of_pair[b + w] + p);
                  L::transpose(v);
                  for (unsigned int w = 0; w < L::n; ++w)
                    L::store(v[w], heads[p + w][j][l] + b);
                }
          }
        };

        /** The heads of a row: the row of G is read number by number. */
        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        combine_heads(const double (&heads)[n_rows][head_size],
                      const unsigned int n,
                      const double      *G,
                      const unsigned int ldg,
                      double            *B)
        {
          constexpr unsigned int head_bytes = head_size * sizeof(double);
          using L = Lanes<(n_bytes < head_bytes ? n_bytes : head_bytes)>;
          constexpr unsigned int n_vectors = head_size / L::n;

          typename L::type c[n_rows][n_vectors];
          for (unsigned int l = 0; l < n_rows; ++l)
            for (unsigned int v = 0; v < n_vectors; ++v)
              c[l][v] = L::load(heads[l] + v * L::n);

          for (unsigned int J = 0; J < n; ++J, ++G, B += head_size)
            for (unsigned int v = 0; v < n_vectors; ++v)
              {
                typename L::type sum = c[0][v] * G[0];
                for (unsigned int l = 1; l < n_rows; ++l)
                  sum += c[l][v] * G[l * ldg];
                L::store(sum, B + v * L::n);
              }
        }

        /** The tails of a row, from the coefficients of the last pair. */
        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        combine_tails(const double      *c,
                      const unsigned int ldc,
                      const unsigned int n,
                      const double      *G,
                      const unsigned int ldg,
                      double            *B)
        {
          using L = Lanes<n_bytes>;
          for (unsigned int J = 0; J < n; J += L::n)
            {
              typename L::type sums = c[0] * L::load(G + J);
              for (unsigned int l = 1; l < n_rows; ++l)
                sums += c[l * ldc] * L::load(G + l * ldg + J);
              L::store(sums, B + J);
            }
        }

        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        run(const unsigned int n_points,
            const unsigned int n,
            const double      *c,
            const unsigned int ldc,
            const double      *G,
            const unsigned int ldg,
            double            *B)
        {
          constexpr unsigned int last_pair = dim * (dim + 1) / 2 - 1;

          Coefficients of_some;
          for (unsigned int p = 0; p < n_points; ++p, G += n_rows * ldg)
            {
              const unsigned int in_block = p % Coefficients::n_points;
              if (in_block == 0)
                of_some.template fill<n_bytes>(c + p, ldc);
              for (unsigned int j = 0; j < n_rows; ++j, B += Row::length(n))
                {
                  combine_heads<n_bytes>(
                    of_some.heads[in_block][j], n, G, ldg, B);
                  if constexpr (Row::has_tails)
                    combine_tails<n_bytes>(
                      c + (last_pair * n_rows + j) * n_rows * ldc + p,
                      ldc,
                      n,
                      G,
                      ldg,
                      B + Row::tails(n));
                }
            }
        }
      };



      /** See DenseKernels::complete_symmetric(). */
      template <int n_components>
      struct CompleteSymmetric
      {
        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        run(const unsigned int n, double *C)
        {
          using Row                = BlockRow<n_components>;
          const unsigned int ld    = Row::length(n);
          const unsigned int tails = Row::tails(n);
          for (unsigned int I = 1; I < n; ++I)
            for (unsigned int J = 0; J < I; ++J)
              {
                transpose_head<n_components, n_bytes>(C + J * ld +
                                                        I * Row::head_size,
                                                      C + I * ld +
                                                        J * Row::head_size);
                if constexpr (Row::has_tails)
                  C[I * ld + tails + J] = C[J * ld + tails + I];
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
                       const bool         add)
    {
      AssertDimension(n_columns, padded(n_columns));
      run_best<TransposedProduct>(
        n_inner, n_rows, n_columns, A, lda, B, C, n_columns, add, 0U);
    }



    template <int n_components>
    void
    symmetric_product(const unsigned int n_inner,
                      const unsigned int n,
                      const double      *A,
                      const unsigned int lda,
                      const double      *B,
                      double            *C,
                      const bool         add)
    {
      using Row = BlockRow<n_components>;

      const auto product = [&](const unsigned int begin,
                               const unsigned int end,
                               const unsigned int block_size) {
        run_best<TransposedProduct>(n_inner,
                                    n,
                                    end - begin,
                                    A,
                                    lda,
                                    B + begin,
                                    C + begin,
                                    Row::length(n),
                                    add,
                                    block_size);
      };
      if constexpr (Row::head_size > 0)
        product(0, Row::tails(n), Row::head_size);
      if constexpr (Row::has_tails)
        product(Row::tails(n), Row::length(n), 1);
    }



    template <int n_components>
    void
    complete_symmetric(const unsigned int n, double *C)
    {
      run_best<CompleteSymmetric<n_components>>(n, C);
    }



    void
    row_products(const unsigned int n_inner,
                 const unsigned int n_rows,
                 const double      *A,
                 const unsigned int n_columns,
                 const double      *B,
                 const unsigned int ld,
                 double            *C,
                 const unsigned int ldc)
    {
      Assert(ld >= padded(n_inner), ExcMessage("Rows are not padded."));
      run_best<RowProducts>(n_inner, n_rows, A, n_columns, B, ld, C, ldc);
    }



    template <int dim, int n_rows>
    void
    combine_rows(const unsigned int n_points,
                 const unsigned int n,
                 const double      *c,
                 const unsigned int ldc,
                 const double      *G,
                 const unsigned int ldg,
                 double            *B)
    {
      Assert(ldg >= padded(n), ExcMessage("Rows are not padded."));
      run_best<CombineRows<dim, n_rows>>(n_points, n, c, ldc, G, ldg, B);
    }



    template void
    symmetric_product<1>(const unsigned int,
                         const unsigned int,
                         const double *,
                         const unsigned int,
                         const double *,
                         double *,
                         const bool);
    template void
    symmetric_product<2>(const unsigned int,
                         const unsigned int,
                         const double *,
                         const unsigned int,
                         const double *,
                         double *,
                         const bool);
    template void
    symmetric_product<3>(const unsigned int,
                         const unsigned int,
                         const double *,
                         const unsigned int,
                         const double *,
                         double *,
                         const bool);
    template void
    complete_symmetric<1>(const unsigned int, double *);
    template void
    complete_symmetric<2>(const unsigned int, double *);
    template void
    complete_symmetric<3>(const unsigned int, double *);

    template void
    combine_rows<2, 2>(const unsigned int,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       double *);
    template void
    combine_rows<2, 3>(const unsigned int,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       double *);
    template void
    combine_rows<3, 3>(const unsigned int,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       double *);
    template void
    combine_rows<3, 4>(const unsigned int,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       const double *,
                       const unsigned int,
                       double *);
  } // namespace DenseKernels
} // namespace EBSMPM
