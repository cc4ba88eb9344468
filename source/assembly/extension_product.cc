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
#include <ebsmpm/assembly/extension_product.h>

namespace EBSMPM
{
  template <unsigned int block_size>
  void
  ExtensionProduct<block_size>::initialize(const unsigned int n_functions,
                                           const unsigned int max_n_columns)
  {
    n           = n_functions;
    half_stride = DenseKernels::padded(block_size * n);
    entries.resize(n * max_n_columns);
    column_ends.resize(max_n_columns);
    half.resize(max_n_columns * half_stride);
    result.resize(max_n_columns * block_size * max_n_columns);
  }



  template <unsigned int block_size>
  struct ExtensionProduct<block_size>::Multiply
  {
    /**
     * Compute the sum of pieces of rows, each times a number, in @p n_vectors
     * registers.
     */
    template <unsigned int n_bytes, unsigned int n_vectors>
    static EBSMPM_IN_EACH_TARGET void
    combine(const Entry       *entry,
            const Entry       *end,
            const double      *rows,
            const unsigned int stride,
            double            *to)
    {
      using L                          = Lanes<n_bytes>;
      typename L::type sums[n_vectors] = {};
      for (; entry != end; ++entry)
        for (unsigned int v = 0; v < n_vectors; ++v)
          sums[v] +=
            entry->value * L::load(rows + entry->row * stride + v * L::n);
      for (unsigned int v = 0; v < n_vectors; ++v)
        L::store(sums[v], to + v * L::n);
    }

    /** A block of the result, with registers that become smaller. */
    template <unsigned int n_bytes, unsigned int length>
    static EBSMPM_IN_EACH_TARGET void
    combine_blocks(const Entry  *entry,
                   const Entry  *end,
                   const double *rows,
                   double       *to)
    {
      if constexpr (length > 0)
        {
          constexpr unsigned int n_lanes   = n_bytes / sizeof(double);
          constexpr unsigned int n_vectors = length / n_lanes;
          if constexpr (n_vectors > 0)
            combine<n_bytes, n_vectors>(entry, end, rows, block_size, to);
          if constexpr (length % n_lanes > 0)
            combine_blocks<n_bytes / 2, length % n_lanes>(
              entry, end, rows + n_vectors * n_lanes, to + n_vectors * n_lanes);
        }
    }

    template <unsigned int n_bytes>
    static EBSMPM_IN_EACH_TARGET void
    run(ExtensionProduct  *product,
        const unsigned int m,
        const double      *K,
        const unsigned int ldk)
    {
      constexpr unsigned int n_lanes   = Lanes<n_bytes>::n;
      constexpr unsigned int n_vectors = 4;

      const Entry        *entries = product->entries.data();
      const unsigned int *ends    = product->column_ends.data();
      const unsigned int  length  = product->half_stride;
      for (unsigned int i = 0; i < m; ++i)
        {
          const Entry *begin = entries + (i == 0 ? 0 : ends[i - 1]);
          const Entry *end   = entries + ends[i];
          double      *half  = product->half.data() + i * length;
          unsigned int J     = 0;
          for (; J + n_vectors * n_lanes <= length; J += n_vectors * n_lanes)
            combine<n_bytes, n_vectors>(begin, end, K + J, ldk, half + J);
          for (; J < length; J += n_lanes)
            combine<n_bytes, 1>(begin, end, K + J, ldk, half + J);

          // All of this row of E^T K is there, and its product with E needs no
          // other.
          double *to = product->result.data() + i * m * block_size;
          for (unsigned int j = i; j < m; ++j)
            combine_blocks<n_bytes, block_size>(entries +
                                                  (j == 0 ? 0 : ends[j - 1]),
                                                entries + ends[j],
                                                half,
                                                to + j * block_size);
        }
    }
  };



  template <unsigned int block_size>
  const double *
  ExtensionProduct<block_size>::compute(const double      *E,
                                        const unsigned int m,
                                        const double      *K,
                                        const unsigned int ldk)
  {
    Assert(ldk >= half_stride,
           ExcMessage("Rows are not padded, see DenseKernels::padding."));
    unsigned int n_entries = 0;
    for (unsigned int i = 0; i < m; ++i)
      {
        for (unsigned int I = 0; I < n; ++I)
          if (E[I * m + i] != 0.)
            entries[n_entries++] = {E[I * m + i], I};
        column_ends[i] = n_entries;
      }
    run_best<Multiply>(this, m, K, ldk);
    return result.data();
  }



  template class ExtensionProduct<1>;
  template class ExtensionProduct<4>;
  template class ExtensionProduct<9>;
} // namespace EBSMPM
