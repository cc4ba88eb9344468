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
   * Rows of other processes are kept here, in the same way, until compress()
   * sends them, in messages whose contents have been agreed on by reinit().
   *
   * @code
   * SystemMatrix matrix;
   * matrix.reinit(functions, unknowns, n_components, lists);
   * matrix = 0;
   * for (l = 0; l < n_lists; ++l)
   *   matrix.add(l, local_matrix, stride);
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
     * Add a symmetric local matrix. Nothing is allocated if all rows are own
     * ones.
     *
     * @param list number of the list of functions that it couples
     * @param values <tt>values[i*stride + pair*n + j]</tt>, where <tt>n</tt> is
     *   the size of the list, couples component $a$ of its function $i$ with
     *   component $b$ of function $j$, and pairs $a\le b$ are in lexicographic
     *   order
     * @param stride distance between two rows
     */
    void
    add(const unsigned int list,
        const double      *values,
        const unsigned int stride);

    /** Send contributions to rows of other processes. Collective. */
    void
    compress();

    /** The matrix itself. */
    const LA::SparseMatrix &
    matrix() const;

    /** Memory in bytes used for the places of entries and for rows of others. */
    std::size_t
    memory_consumption() const;

  private:
    /**
     * Agree with the other processes on what is sent.
     *
     * @param functions the partitioner
     * @param ghost_rows for each function of another process, the global
     *   numbers of those it couples with
     */
    void
    set_up_messages(
      const Utilities::MPI::Partitioner                       &functions,
      const std::vector<std::vector<types::global_dof_index>> &ghost_rows);

    /** Implementation of add(). */
    template <unsigned int n_components>
    void
    add_components(const unsigned int list,
                   const double      *values,
                   const unsigned int stride);

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

    /** Functions one after the other whose entries are neighbours in a row. */
    struct Run
    {
      unsigned int begin;
      unsigned int size;
    };

    /** Scratch for one row. */
    std::vector<double> row_values;
    std::vector<Run>    runs;

    /** A part of an array that goes to another process, or comes from it. */
    struct Message
    {
      unsigned int rank;
      std::size_t  begin;
      std::size_t  size;
    };

    /**
     * The rows of functions of other processes, one after the other, where they
     * begin, and to whom they go.
     */
    std::vector<double>      ghost_entries;
    std::vector<std::size_t> ghost_row_begins;
    std::vector<Message>     outgoing;

    /** What others send, and where it belongs in @p entries. */
    std::vector<double>      arrivals;
    std::vector<std::size_t> arrival_places;
    std::vector<Message>     incoming;
  };
} // namespace EBSMPM

#endif
