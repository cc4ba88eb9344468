// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_system_matrix_h
#define ebsmpm_lac_system_matrix_h

#include <ebsmpm/lac/types.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <vector>

namespace EBSMPM
{
  /**
   * A sparse matrix that knows where the entries of each dense local matrix go.
   *
   * The same local matrices, coupling the same unknowns, are added in every
   * Newton step. A general sparse matrix searches for each entry of theirs
   * again and again; here, the places are looked up once, in reinit(), so that
   * adding costs little more than reading and writing. Unknowns come in blocks,
   * <tt>n_components*function+component</tt>, and one place is stored per pair
   * of functions.
   *
   * Rows of other processes are left to the matrix class itself.
   *
   * @code
   * SystemMatrix matrix;
   * matrix.reinit(functions, unknowns, n_components, lists);
   * matrix = 0;
   * for (l = 0; l < n_lists; ++l)
   *   matrix.add(l, local_matrix);
   * matrix.compress();
   * @endcode
   */
  class SystemMatrix
  {
  public:
    /** A list of functions whose unknowns couple with each other. */
    struct List
    {
      const unsigned int *begin;
      unsigned int        size;
    };

    /**
     * Build the sparsity pattern and remember the places of the entries, unless
     * these are the same as before. Return whether anything is new, and with it
     * the object returned by matrix(). Collective.
     *
     * @param functions distribution of the functions
     * @param n_components unknowns per function
     * @param lists of functions, by their number in @p functions
     */
    bool
    reinit(const Utilities::MPI::Partitioner &functions,
           const unsigned int                 n_components,
           const std::vector<List>           &lists);

    /** Set all entries to zero. */
    void
    set_zero();

    /**
     * Add a dense matrix.
     *
     * @param list number of the list of functions that it couples
     * @param values row by row, the unknowns of a function one after the other
     */
    void
    add(const unsigned int list, const double *values);

    /** Send contributions to rows of other processes. Collective. */
    void
    compress();

    /** The matrix itself. */
    const LA::SparseMatrix &
    matrix() const;

    /** Memory in bytes used for the places of the entries. */
    std::size_t
    memory_consumption() const;

  private:
    unsigned int n_components = 0;
    unsigned int n_owned      = 0;

    LA::SparseMatrix sparse_matrix;

    /** The entries of the rows owned, row by row, and where rows begin. */
    double    *entries    = nullptr;
    const int *row_begins = nullptr;

    /** The functions of all lists, where lists begin, and their places. */
    std::vector<unsigned int> list_functions;
    std::vector<std::size_t>  list_begins;
    std::vector<std::size_t>  place_begins;
    std::vector<int>          places;

    /**
     * Where the columns of the components of a function are not consecutive in
     * a row, @p places has minus one minus the position here of their places.
     */
    std::vector<int> scattered_places;

    /** Global numbers of the functions that this process knows. */
    std::vector<types::global_dof_index> global_functions;

    /** Scratch for the rows of other processes. */
    std::vector<types::global_dof_index> columns;
  };
} // namespace EBSMPM

#endif
