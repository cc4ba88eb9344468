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

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <cstdint>
#include <vector>

namespace EBSMPM
{
  /**
   * A symmetric sparse matrix that knows where the entries of each dense local
   * matrix go.
   *
   * The same local matrices, coupling the same unknowns, are added in every
   * Newton step. A general sparse matrix searches for each entry of theirs
   * again and again; here, the places are looked up once, in reinit(). Unknowns
   * come in blocks, <tt>n_components*function+component</tt>, and places are
   * those of functions.
   *
   * Rows that local matrices are being added to are kept aside, as open rows,
   * with all components of a function next to each other, so that a local
   * matrix is added along lines of functions. A row is closed after the last
   * local matrix that has a share in it. As neighbouring cells follow each
   * other, few rows are open at a time, and they stay in the caches. Of each
   * pair of functions, only the row that is closed first is added to; when that
   * is done, the block of the pair goes to the other row, and the row to the
   * sparse matrix.
   *
   * Rows of other processes are kept here, in the same way, until compress()
   * sends them, in messages whose contents have been agreed on by reinit().
   *
   * @code
   * SystemMatrix matrix;
   * matrix.reinit(functions, n_components, lists);
   * matrix.begin();
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
     * @param n_components unknowns per function, from one to three
     * @param lists of functions, by their number in @p functions
     */
    bool
    reinit(const Utilities::MPI::Partitioner &functions,
           const unsigned int                 n_components,
           const std::vector<List>           &lists);

    /**
     * Begin anew, with a matrix of zeros.
     *
     * @param wanted for each function, whether its rows are wanted, the same on
     *   all processes that know it; what is in the others is then undefined. A
     *   null pointer stands for all functions. It must live until compress().
     */
    void
    begin(const std::vector<bool> *wanted = nullptr);

    /**
     * Add a local matrix. Lists have to be added in their order, each at most
     * once; those that are left out add nothing. Nothing is allocated.
     *
     * @param list number of the list of functions that it couples
     * @param values the local matrix, row by row, each a
     *   <tt>BlockRow<n_components></tt> of as many blocks as the list has
     *   functions; those before the diagonal are not read
     */
    void
    add(const unsigned int list, const double *values);

    /**
     * Write the rows that are still open, and send contributions to rows of
     * other processes. Only now, matrix() is complete. Collective.
     */
    void
    compress();

    /** The matrix itself. */
    const LA::SparseMatrix &
    matrix() const;

    /** Memory in bytes used for the places of entries and for rows of others.
     */
    std::size_t
    memory_consumption() const;

  private:
    /** The lists that each function occurs in. */
    class Occurrences;

    /** The rows that other processes have sent. */
    class ArrivingRows;

    /**
     * Functions of a list, one after the other, that are neighbours in a row;
     * or a single one whose block belongs, transposed, to its own row.
     */
    struct Run
    {
      /** The largest size, and with it the largest length of a row. */
      static constexpr unsigned int max_size = (1U << 15) - 1;

      std::uint16_t place;
      std::uint16_t size : 15;
      std::uint16_t is_transposed : 1;
    };

    /**
     * A block of a row that is closed before that of the function it couples
     * with, and its place there.
     */
    struct Mirror
    {
      unsigned int  function;
      std::uint16_t from;
      std::uint16_t to;
    };

    /** A part of an array that goes to another process, or comes from it. */
    struct Message
    {
      unsigned int rank;
      std::size_t  begin;
      std::size_t  size;
    };

    /** Whether anything is different from what reinit() has seen before. */
    bool
    remember(const Utilities::MPI::Partitioner &functions,
             const unsigned int                 n_components,
             const std::vector<List>           &lists);

    /**
     * Find what the functions couple with according to the lists of this
     * process: @p row_columns, for now with local numbers of functions.
     */
    void
    find_rows(const Occurrences &occurrences);

    /**
     * Tell the other processes what the lists of this one couple, learn from
     * them in return what belongs to the rows owned, and number the columns.
     */
    void
    exchange_rows(const Utilities::MPI::Partitioner &functions);

    /** Find all columns, and give them their numbers. */
    void
    number_columns(const Utilities::MPI::Partitioner &functions,
                   const ArrivingRows                &arriving_rows);

    /** The number of the column of a function that is known here. */
    unsigned int
    column(const Utilities::MPI::Partitioner &functions,
           const types::global_dof_index      function) const;

    /**
     * From here on, @p row_columns has numbers of columns, and those that come
     * from other processes.
     */
    void
    add_rows(const Utilities::MPI::Partitioner &functions,
             const ArrivingRows                &arriving_rows);

    /**
     * Find the mirrors of all rows.
     *
     * @param coupled, @p begins the functions that each function couples with
     *   according to the lists of this process
     */
    void
    find_mirrors(const std::vector<unsigned int> &coupled,
                 const std::vector<std::size_t>  &begins);

    /** Find out where the entries that other processes send belong. */
    void
    find_arrival_places(const Utilities::MPI::Partitioner &functions,
                        const ArrivingRows                &arriving_rows);

    /** Build the sparse matrix. */
    void
    build_matrix(const Utilities::MPI::Partitioner &functions);

    /** Find the runs of all lists. */
    void
    find_runs(const Occurrences &occurrences);

    /** Find the first and last list of each row, and the order of closing. */
    void
    number_closings();

    /** Give each row a place among the open rows for the time it needs one. */
    void
    assign_slots();

    /** How many functions the row of a function couples it with. */
    unsigned int
    row_length(const unsigned int function) const;

    /**
     * The first entry of the rows of a function, in the sparse matrix or among
     * those of other processes.
     */
    double *
    row(const unsigned int function);

    /** The open row of a function. */
    double *
    open_row(const unsigned int function);

    /** Add the row of a function to the open ones. */
    template <unsigned int n_components>
    void
    begin_row(const unsigned int function);

    /** Write the row of a function to where it belongs, and to its mirrors. */
    template <unsigned int n_components>
    void
    close_row(const unsigned int function);

    /**
     * Ask the memory for what a list is added to, and what the rows that it
     * closes are mirrored to.
     */
    template <unsigned int n_components>
    void
    fetch_rows(const unsigned int list);

    /**
     * Add a local matrix, or nothing if there is none, and open and close the
     * rows that begin and end with this list.
     */
    void
    add_list(const unsigned int list, const double *values);

    /** Whether little of the matrix is in a cache when it is needed. */
    bool
    is_large() const
    {
      constexpr std::size_t size_of_far_caches = 1U << 24; // bytes
      return n_components * n_components * row_begins[n_owned] *
               sizeof(double) >
             size_of_far_caches;
    }

    unsigned int n_components = 0;
    unsigned int n_owned      = 0;

    LA::SparseMatrix sparse_matrix;

    /** The entries of the rows owned, row by row. */
    double *entries = nullptr;

    /** The functions of all lists, and where lists begin. */
    std::vector<unsigned int> list_functions;
    std::vector<std::size_t>  list_begins;

    /** Global numbers of the functions that this process knows. */
    std::vector<types::global_dof_index> global_functions;

    /**
     * Columns are numbered as the functions owned, followed by these functions
     * of other processes, in ascending order; and the column of each function
     * that this process knows.
     */
    IndexSet                  foreign_columns;
    std::vector<unsigned int> columns;

    /**
     * The columns of the row of each of these functions, in ascending order,
     * and where they begin.
     */
    std::vector<unsigned int> row_columns;
    std::vector<std::size_t>  row_begins;

    /** The runs of each function of each list. */
    std::vector<Run>         runs;
    std::vector<std::size_t> run_begins;

    /** The mirrors of the row of each function. */
    std::vector<Mirror>      mirrors;
    std::vector<std::size_t> mirror_begins;

    /** The first place in each row that does not come from a mirror. */
    std::vector<std::uint16_t> first_places;

    /**
     * For each function, the first and the last list that needs its row, the
     * number of the row in the order in which rows are closed, and its place
     * among the open rows. Own functions that no list needs have a last list
     * before the first one.
     */
    std::vector<unsigned int> first_lists;
    std::vector<unsigned int> last_lists;
    std::vector<unsigned int> closing_numbers;
    std::vector<unsigned int> slots;

    /**
     * The open rows, each a BlockRow; how long one is at most, where the tails
     * begin, and the list that is next.
     */
    AlignedVector<double> open_rows;
    std::size_t           slot_size  = 0;
    std::size_t           open_tails = 0;
    unsigned int          next_list  = 0;

    /** See begin(), and the rows that these need. */
    const std::vector<bool> *wanted = nullptr;
    std::vector<bool>        needed;

    /** Scratch: the open rows of a list. */
    std::vector<double *> row_pointers;

    /** Scratch: a row as it is in the sparse matrix. */
    std::vector<double> split_row;

    /** The rows of functions of other processes, and to whom they go. */
    std::vector<double>  ghost_entries;
    std::vector<Message> outgoing;

    /** What others send, and where it belongs in @p entries. */
    std::vector<double>      arrivals;
    std::vector<std::size_t> arrival_places;
    std::vector<Message>     incoming;
  };



  inline unsigned int
  SystemMatrix::row_length(const unsigned int function) const
  {
    return row_begins[function + 1] - row_begins[function];
  }
} // namespace EBSMPM

#endif
