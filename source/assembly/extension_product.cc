// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/extension_product.h>

#include <algorithm>

namespace EBSMPM
{
  template <unsigned int n_components>
  void
  ExtensionProduct<n_components>::initialize(const unsigned int n_functions,
                                             const unsigned int max_n_columns)
  {
    n = n_functions;
    entries.resize(n * max_n_columns);
    column_ends.resize(max_n_columns);
    half.resize(Row::length(n));
    result.resize(max_n_columns * Row::length(max_n_columns));
  }



  template <unsigned int n_components>
  struct ExtensionProduct<n_components>::Multiply
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

    template <unsigned int n_bytes>
    static EBSMPM_IN_EACH_TARGET void
    run(ExtensionProduct *product, const unsigned int m, const double *K)
    {
      constexpr unsigned int n_lanes   = Lanes<n_bytes>::n;
      constexpr unsigned int n_vectors = 4;
      constexpr unsigned int head_size = Row::head_size;
      constexpr unsigned int head_bytes =
        std::min<unsigned int>(head_size * sizeof(double), n_bytes);

      const unsigned int  n       = product->n;
      const Entry        *entries = product->entries.data();
      const unsigned int *ends    = product->column_ends.data();
      const unsigned int  length  = Row::length(n);
      double *const       half    = product->half.data();
      double             *to      = product->result.data();
      for (unsigned int i = 0; i < m; ++i, to += Row::length(m))
        {
          const Entry *begin = entries + (i == 0 ? 0 : ends[i - 1]);
          const Entry *end   = entries + ends[i];
          unsigned int J     = 0;
          for (; J + n_vectors * n_lanes <= length; J += n_vectors * n_lanes)
            combine<n_bytes, n_vectors>(begin, end, K + J, length, half + J);
          for (; J < length; J += n_lanes)
            combine<n_bytes, 1>(begin, end, K + J, length, half + J);

          // All of this row of E^T K is there, and its product with E needs no
          // other.
          for (unsigned int j = i; j < m; ++j)
            {
              begin = entries + (j == 0 ? 0 : ends[j - 1]);
              end   = entries + ends[j];
              if constexpr (head_size > 0)
                combine<head_bytes, head_size * sizeof(double) / head_bytes>(
                  begin, end, half, head_size, to + j * head_size);
              if constexpr (Row::has_tails)
                {
                  double sum = 0.;
                  for (; begin != end; ++begin)
                    sum += begin->value * half[Row::tails(n) + begin->row];
                  to[Row::tails(m) + j] = sum;
                }
            }
        }
    }
  };



  template <unsigned int n_components>
  const double *
  ExtensionProduct<n_components>::compute(const double      *E,
                                          const unsigned int m,
                                          const double      *K)
  {
    unsigned int n_entries = 0;
    for (unsigned int i = 0; i < m; ++i)
      {
        for (unsigned int I = 0; I < n; ++I)
          if (E[I * m + i] != 0.)
            entries[n_entries++] = {E[I * m + i], I};
        column_ends[i] = n_entries;
      }
    run_best<Multiply>(this, m, K);
    return result.data();
  }



  template class ExtensionProduct<1>;
  template class ExtensionProduct<2>;
  template class ExtensionProduct<3>;
} // namespace EBSMPM
