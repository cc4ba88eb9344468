// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_extension_product_h
#define ebsmpm_assembly_extension_product_h

#include <ebsmpm/base/config.h>

#include <vector>

namespace EBSMPM
{
  /**
   * Resolves the constraints of a group of points in its matrix: $E^T K E$,
   * where $E$ is that of PointGroups, and the entries of $K$ are small blocks
   * (a number per pair of components).
   *
   * Most rows of $E$ are those of the identity, and the others have few
   * entries; so the product is a sum over these.
   *
   * @code
   * ExtensionProduct product;
   * product.initialize(n_functions, max_n_unknown_functions, block_size);
   * const double *R = product.compute(E, m, K, ldk);
   * @endcode
   *
   * Memory is allocated by initialize() only.
   */
  class ExtensionProduct
  {
  public:
    /**
     * Allocate memory.
     *
     * @param n_functions number of functions of a cell, rows of $E$
     * @param max_n_columns the largest number of columns of $E$
     * @param block_size number of entries of a block
     */
    void
    initialize(const unsigned int n_functions,
               const unsigned int max_n_columns,
               const unsigned int block_size);

    /**
     * Compute the product.
     *
     * @param E the matrix, row by row
     * @param m its number of columns
     * @param K block $(I,J)$ begins at <tt>K[I*ldk+J*block_size]</tt>
     * @param ldk distance between two rows
     *
     * Return an array in which block $(i,j)$ begins at
     * <tt>(i*m+j)*block_size</tt>. It is valid until the next call.
     */
    const double *
    compute(const double      *E,
            const unsigned int m,
            const double      *K,
            const unsigned int ldk);

  private:
    /** An entry of E. */
    struct Entry
    {
      unsigned int row;
      unsigned int column;
      double       value;
    };

    unsigned int n    = 0;
    unsigned int size = 0;

    std::vector<Entry>  entries;
    std::vector<double> half;
    std::vector<double> result;
  };
} // namespace EBSMPM

#endif
