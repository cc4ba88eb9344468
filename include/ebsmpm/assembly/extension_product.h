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
   * Resolves the constraints of a group of points in its matrix: $E^T K E$ for
   * each block $K$ of a matrix (a pair of components), where $E$ is that of
   * PointGroups.
   *
   * Most rows of $E$ are those of the identity, and the others have few
   * entries; so the product is a sum over these.
   *
   * @code
   * ExtensionProduct product;
   * product.initialize(n_functions, max_n_unknown_functions, n_blocks);
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
     * @param n_blocks number of blocks
     */
    void
    initialize(const unsigned int n_functions,
               const unsigned int max_n_columns,
               const unsigned int n_blocks);

    /**
     * Compute the product of all blocks.
     *
     * @param E the matrix, row by row
     * @param m its number of columns
     * @param K row $I$ of block $b$ begins at <tt>K[I*ldk+b*n_functions]</tt>
     * @param ldk distance between two rows
     *
     * Return an array in which row $i$ of block $b$ begins at
     * <tt>(i*n_blocks+b)*m</tt>. It is valid until the next call.
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

    unsigned int n        = 0;
    unsigned int n_blocks = 0;

    std::vector<Entry>  entries;
    std::vector<double> half;
    std::vector<double> result;
  };
} // namespace EBSMPM

#endif
