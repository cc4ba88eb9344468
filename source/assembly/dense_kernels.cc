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
            tile<n_vectors, height>(A + i, B + j, C + i * n_columns + j);
          if constexpr (height > 1)
            tiles<n_vectors, height - 1>(end_row, j, i);
        }

        template <unsigned int n_vectors, unsigned int height>
        EBSMPM_IN_EACH_TARGET void
        tile(const double *a, const double *b, double *c) const
        {
          typename L::type sums[height][n_vectors] = {};
          for (unsigned int k = 0; k < n_inner; ++k, a += lda, b += n_columns)
            for (unsigned int v = 0; v < n_vectors; ++v)
              {
                const typename L::type b_v = L::load(b + L::n * v);
                for (unsigned int i = 0; i < height; ++i)
                  sums[i][v] += a[i] * b_v;
              }
          for (unsigned int i = 0; i < height; ++i, c += n_columns)
            for (unsigned int v = 0; v < n_vectors; ++v)
              {
                double *const to = c + L::n * v;
                L::store(add ? L::load(to) + sums[i][v] : sums[i][v], to);
              }
        }
      };



      /** See DenseKernels::transposed_product(). */
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
          const TransposedProductTiles<n_bytes> product = {
            n_inner, n_rows, n_columns, A, lda, B, C, add, block_size};
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



      /**
       * See DenseKernels::combine_rows(). Registers of four numbers suffice,
       * since blocks have four or nine. The ninth numbers of several blocks are
       * computed side by side.
       */
      template <int dim, int n_rows>
      struct CombineRows
      {
        static constexpr unsigned int n_both = dim * dim;

        /**
         * The coefficients of the row $(p,j)$ for row $(p,l)$, a block for each
         * pair of them, for some points.
         */
        struct Coefficients
        {
          static constexpr unsigned int n_points = max_n_short_lanes;

          double blocks[n_points][n_rows][n_rows][n_both];

          template <unsigned int n_bytes>
          EBSMPM_IN_EACH_TARGET void
          fill(const double *c, const unsigned int ldc)
          {
            for (unsigned int j = 0; j < n_rows; ++j)
              for (unsigned int l = 0; l < n_rows; ++l)
                {
                  const double *of_pair[n_both];
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

          /** The blocks of a pair of rows, from arrays over the points. */
          template <unsigned int n_bytes>
          EBSMPM_IN_EACH_TARGET void
          fill_pair(const double *const *of_pair,
                    const unsigned int   j,
                    const unsigned int   l)
          {
            using L = ShortLanes<n_bytes>;
            for (unsigned int p = 0; p < n_points; p += L::n)
              {
                unsigned int b = 0;
                for (; b + L::n <= n_both; b += L::n)
                  {
                    typename L::type v[L::n];
                    for (unsigned int w = 0; w < L::n; ++w)
                      v[w] = L::load(of_pair[b + w] + p);
                    L::transpose(v);
                    for (unsigned int w = 0; w < L::n; ++w)
                      L::store(v[w], blocks[p + w][j][l] + b);
                  }
                for (; b < n_both; ++b)
                  for (unsigned int w = 0; w < L::n; ++w)
                    blocks[p + w][j][l][b] = of_pair[b][p + w];
              }
          }
        };

        /** Combine the rows of a point for one row of B. */
        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        combine(const double (&blocks)[n_rows][n_both],
                const unsigned int n,
                const double      *G,
                const unsigned int ldg,
                double            *B)
        {
          using L                          = ShortLanes<n_bytes>;
          using Vector                     = typename L::type;
          constexpr unsigned int n_vectors = n_both / L::n;
          constexpr unsigned int last      = n_both - 1;

          Vector c[n_rows][n_vectors];
          for (unsigned int l = 0; l < n_rows; ++l)
            for (unsigned int v = 0; v < n_vectors; ++v)
              c[l][v] = L::load(blocks[l] + v * L::n);

          for (unsigned int begin = 0; begin < n; begin += L::n)
            {
              // Some are computed twice if there are not as many left.
              const unsigned int J = std::min(begin, n - L::n);
              const double      *g = G + J;
              double            *b = B + J * n_both;
              for (unsigned int w = 0; w < L::n; ++w)
                for (unsigned int v = 0; v < n_vectors; ++v)
                  {
                    Vector sum = c[0][v] * g[w];
                    for (unsigned int l = 1; l < n_rows; ++l)
                      sum += c[l][v] * g[l * ldg + w];
                    L::store(sum, b + w * n_both + v * L::n);
                  }
              if constexpr (n_both > n_vectors * L::n)
                {
                  Vector sums = blocks[0][last] * L::load(g);
                  for (unsigned int l = 1; l < n_rows; ++l)
                    sums += blocks[l][last] * L::load(g + l * ldg);
                  for (unsigned int w = 0; w < L::n; ++w)
                    b[w * n_both + last] = sums[w];
                }
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
            double            *B,
            const unsigned int ldb)
        {
          Coefficients of_some;
          for (unsigned int begin = 0; begin < n_points;
               begin += Coefficients::n_points)
            {
              of_some.template fill<n_bytes>(c + begin, ldc);
              const unsigned int n_here =
                std::min(n_points - begin, Coefficients::n_points);
              for (unsigned int p = 0; p < n_here; ++p, G += n_rows * ldg)
                for (unsigned int j = 0; j < n_rows; ++j, B += ldb)
                  combine<n_bytes>(of_some.blocks[p][j], n, G, ldg, B);
            }
        }
      };



      /** See DenseKernels::complete_symmetric(). */
      template <int dim>
      struct CompleteSymmetric
      {
        template <unsigned int n_bytes>
        static EBSMPM_IN_EACH_TARGET void
        run(const unsigned int n, const unsigned int ld, double *C)
        {
          for (unsigned int I = 1; I < n; ++I)
            for (unsigned int J = 0; J < I; ++J)
              transpose_block<dim, n_bytes>(C + J * ld + I * dim * dim,
                                            C + I * ld + J * dim * dim);
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
      run_best<CompleteSymmetric<dim>>(n, ld, C);
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
      Assert(ld >= padded(n_inner),
             ExcMessage("Rows are not padded, see DenseKernels::padding."));
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
                 double            *B,
                 const unsigned int ldb)
    {
      Assert(n >= max_n_short_lanes,
             ExcMessage("Rows are shorter than a vector."));
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
