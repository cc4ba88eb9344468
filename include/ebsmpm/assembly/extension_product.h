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

#include <ebsmpm/base/block_row.h>

#include <deal.II/base/aligned_vector.h>

#include <vector>

namespace EBSMPM
{
  /**
   * Resolves the constraints of a group of points in its matrix: $E^T K E$,
   * where $E$ is that of PointGroups, and the entries of $K$ are small blocks
   * (a number per pair of components). As $K$ is symmetric, one half of the
   * product is computed.
   *
   * Most columns of $E$ have few entries, and the product is a sum over these,
   * first $E^T K$ row by row, and then that times $E$ block by block.
   *
   * @code
   * ExtensionProduct<n_components> product;
   * product.initialize(n_functions, max_n_unknown_functions);
   * const double *R = product.compute(E, m, K);
   * @endcode
   *
   * Memory is allocated by initialize() only.
   *
   * @tparam n_components number of rows and columns of a block, one to three
   */
  template <unsigned int n_components>
  class ExtensionProduct
  {
  public:
    /**
     * Allocate memory.
     *
     * @param n_functions number of functions of a cell, rows of $E$
     * @param max_n_columns the largest number of columns of $E$
     */
    void
    initialize(const unsigned int n_functions,
               const unsigned int max_n_columns);

    /**
     * Compute the product.
     *
     * @param E the matrix, row by row
     * @param m its number of columns
     * @param K the whole matrix, whose rows are each a BlockRow
     *
     * Return a matrix whose rows are each a BlockRow of @p m blocks. Those
     * before the diagonal do not matter. It is valid until the next call.
     */
    const double *
    compute(const double *E, const unsigned int m, const double *K);

  private:
    /** An entry of a column of E. */
    struct Entry
    {
      double       value;
      unsigned int row;
    };

    /** The computation, for several instruction sets. */
    struct Multiply;
    friend struct Multiply;

    using Row = BlockRow<n_components>;

    unsigned int n = 0;

    std::vector<Entry>        entries;
    std::vector<unsigned int> column_ends;
    AlignedVector<double>     half;
    AlignedVector<double>     result;
  };
} // namespace EBSMPM

#endif
