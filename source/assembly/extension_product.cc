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
  void
  ExtensionProduct::initialize(const unsigned int n_functions,
                               const unsigned int max_n_columns,
                               const unsigned int block_size)
  {
    n    = n_functions;
    size = block_size;
    entries.reserve(n * max_n_columns);
    half.resize(max_n_columns * size * n);
    result.resize(max_n_columns * size * max_n_columns);
  }



  const double *
  ExtensionProduct::compute(const double      *E,
                            const unsigned int m,
                            const double      *K,
                            const unsigned int ldk)
  {
    entries.clear();
    for (unsigned int I = 0; I < n; ++I)
      for (unsigned int i = 0; i < m; ++i)
        if (E[I * m + i] != 0.)
          entries.push_back({I, i, E[I * m + i]});

    // E^T K, whole rows at once...
    const unsigned int length = size * n;
    std::fill_n(half.begin(), m * length, 0.);
    for (const Entry &entry : entries)
      {
        const double *from = K + entry.row * ldk;
        double       *to   = half.data() + entry.column * length;
        for (unsigned int J = 0; J < length; ++J)
          to[J] += entry.value * from[J];
      }

    // ...and that times E.
    std::fill_n(result.begin(), m * m * size, 0.);
    for (unsigned int row = 0; row < m; ++row)
      {
        const double *from = half.data() + row * length;
        double       *to   = result.data() + row * m * size;
        for (const Entry &entry : entries)
          for (unsigned int k = 0; k < size; ++k)
            to[entry.column * size + k] +=
              entry.value * from[entry.row * size + k];
      }
    return result.data();
  }
} // namespace EBSMPM
