// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/lanes.h>

#include <ebsmpm/lac/system_matrix.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace EBSMPM
{
  /** Stores, for each function, the lists and its positions there. */
  class SystemMatrix::Occurrences
  {
  public:
    Occurrences(const unsigned int               n_functions,
                const std::vector<unsigned int> &list_functions,
                const std::vector<std::size_t>  &list_begins)
      : begins(n_functions + 1, 0)
      , places(list_functions.size())
    {
      for (const auto function : list_functions)
        ++begins[function + 1];
      std::partial_sum(begins.begin(), begins.end(), begins.begin());
      std::vector<unsigned int> next(begins.begin(), begins.end() - 1);
      for (unsigned int l = 0; l + 1 < list_begins.size(); ++l)
        for (std::size_t k = list_begins[l]; k < list_begins[l + 1]; ++k)
          places[next[list_functions[k]]++] = {
            l, static_cast<unsigned int>(k - list_begins[l])};
    }

    /** Call <tt>visit(list, position)</tt> for a function, list by list. */
    template <typename Visitor>
    void
    visit(const unsigned int function, const Visitor &visitor) const
    {
      for (unsigned int k = begins[function]; k < begins[function + 1]; ++k)
        visitor(places[k].list, places[k].position);
    }

  private:
    struct Place
    {
      unsigned int list;
      unsigned int position;
    };
    std::vector<unsigned int> begins;
    std::vector<Place>        places;
  };



  bool
  SystemMatrix::reinit(const Utilities::MPI::Partitioner &functions,
                       const unsigned int                 n_components,
                       const std::vector<List>           &lists)
  {
    // Most often, nothing has changed since the last load step.
    const bool is_new = remember(functions, n_components, lists);
    if (Utilities::MPI::max(is_new ? 1U : 0U,
                            functions.get_mpi_communicator()) == 0)
      return false;

    const Occurrences occurrences(global_functions.size(),
                                  list_functions,
                                  list_begins);
    build_matrix(functions, occurrences);
    find_runs(functions, occurrences);
    find_shuffled_rows();
    assign_slots(occurrences);
    set_up_messages(functions);
    return true;
  }



  bool
  SystemMatrix::remember(const Utilities::MPI::Partitioner &functions,
                         const unsigned int                 n_components_,
                         const std::vector<List>           &lists)
  {
    const unsigned int n_known =
      functions.locally_owned_size() + functions.n_ghost_indices();
    std::vector<types::global_dof_index> new_global_functions(n_known);
    for (unsigned int i = 0; i < n_known; ++i)
      new_global_functions[i] = functions.local_to_global(i);

    std::vector<unsigned int> new_list_functions;
    std::vector<std::size_t>  new_list_begins(1, 0);
    for (const auto &list : lists)
      {
        new_list_functions.insert(new_list_functions.end(),
                                  list.begin,
                                  list.begin + list.size);
        new_list_begins.push_back(new_list_functions.size());
      }

    const bool is_new = n_components != n_components_ ||
                        n_owned != functions.locally_owned_size() ||
                        new_global_functions != global_functions ||
                        new_list_functions != list_functions ||
                        new_list_begins != list_begins;
    n_components = n_components_;
    n_owned      = functions.locally_owned_size();
    global_functions.swap(new_global_functions);
    list_functions.swap(new_list_functions);
    list_begins.swap(new_list_begins);
    return is_new;
  }



  void
  SystemMatrix::build_matrix(const Utilities::MPI::Partitioner &functions,
                             const Occurrences                 &occurrences)
  {
    const unsigned int nc      = n_components;
    const unsigned int n_known = global_functions.size();

    // Couple functions first, and their components afterwards.
    const IndexSet &owned    = functions.locally_owned_range();
    IndexSet        relevant = owned;
    relevant.add_indices(functions.ghost_indices());
    DynamicSparsityPattern                            coupling(functions.size(),
                                    functions.size(),
                                    relevant);
    std::vector<types::global_dof_index>              row;
    std::vector<std::vector<types::global_dof_index>> ghost_rows;
    std::vector<unsigned int> seen_by(n_known, numbers::invalid_unsigned_int);
    for (unsigned int f = 0; f < n_known; ++f)
      {
        row.clear();
        occurrences.visit(f, [&](const unsigned int l, const unsigned int) {
          for (std::size_t k = list_begins[l]; k < list_begins[l + 1]; ++k)
            if (seen_by[list_functions[k]] != f)
              {
                seen_by[list_functions[k]] = f;
                row.push_back(global_functions[list_functions[k]]);
              }
        });
        std::sort(row.begin(), row.end());
        coupling.add_entries(global_functions[f], row.begin(), row.end(), true);
        if (f >= n_owned)
          ghost_rows.push_back(row);
      }
    SparsityTools::distribute_sparsity_pattern(coupling,
                                               owned,
                                               functions.get_mpi_communicator(),
                                               relevant);

    // Rows of other processes have the columns that we know.
    row_functions.clear();
    row_functions_begins.assign(1, 0);
    for (unsigned int f = 0; f < n_known; ++f)
      {
        if (f < n_owned)
          for (auto entry = coupling.begin(global_functions[f]);
               entry != coupling.end(global_functions[f]);
               ++entry)
            row_functions.push_back(entry->column());
        else
          row_functions.insert(row_functions.end(),
                               ghost_rows[f - n_owned].begin(),
                               ghost_rows[f - n_owned].end());
        row_functions_begins.push_back(row_functions.size());
      }

    IndexSet rows(nc * functions.size());
    if (n_owned > 0)
      rows.add_range(nc * global_functions[0],
                     nc * (global_functions[0] + n_owned));
    rows.compress();
    DynamicSparsityPattern sparsity(rows.size(), rows.size(), rows);
    for (unsigned int f = 0; f < n_owned; ++f)
      {
        row.clear();
        for (std::size_t k = row_functions_begins[f];
             k < row_functions_begins[f + 1];
             ++k)
          for (unsigned int c = 0; c < nc; ++c)
            row.push_back(nc * row_functions[k] + c);
        for (unsigned int c = 0; c < nc; ++c)
          sparsity.add_entries(nc * global_functions[f] + c,
                               row.begin(),
                               row.end(),
                               true);
      }
    sparse_matrix.reinit(
      rows, rows, sparsity, functions.get_mpi_communicator(), false);

    const Epetra_CrsMatrix &epetra = sparse_matrix.trilinos_matrix();
    int                    *begins, *column_numbers;
    const int               ierr =
      epetra.ExtractCrsDataPointers(begins, column_numbers, entries);
    AssertThrow(ierr == 0, ExcInternalError());
    row_begins = begins;
  }



  void
  SystemMatrix::find_runs(const Utilities::MPI::Partitioner &functions,
                          const Occurrences                 &occurrences)
  {
    // The columns of a list, row by row.
    const unsigned int n_lists = list_begins.size() - 1;
    const auto         size_of = [&](const unsigned int l) {
      return list_begins[l + 1] - list_begins[l];
    };
    std::vector<std::size_t> begins(1, 0);
    for (unsigned int l = 0; l < n_lists; ++l)
      begins.push_back(begins.back() + size_of(l) * size_of(l));
    std::vector<std::uint16_t> columns(begins.back());
    std::vector<std::uint16_t> column_of(global_functions.size());
    for (unsigned int f = 0; f < global_functions.size(); ++f)
      {
        const std::size_t first = row_functions_begins[f];
        const std::size_t width = row_functions_begins[f + 1] - first;
        AssertThrow(width <= std::numeric_limits<std::uint16_t>::max(),
                    ExcInternalError());
        // Functions of other processes that only others see are not known here.
        for (unsigned int c = 0; c < width; ++c)
          if (functions.in_local_range(row_functions[first + c]) ||
              functions.is_ghost_entry(row_functions[first + c]))
            column_of[functions.global_to_local(row_functions[first + c])] = c;
        occurrences.visit(f, [&](const unsigned int l, const unsigned int i) {
          for (unsigned int j = 0; j < size_of(l); ++j)
            columns[begins[l] + i * size_of(l) + j] =
              column_of[list_functions[list_begins[l] + j]];
        });
      }

    // Functions are numbered along lines of the lattice.
    runs.clear();
    run_begins.assign(1, 0);
    for (unsigned int l = 0; l < n_lists; ++l)
      {
        const std::uint16_t *column = columns.data() + begins[l];
        for (unsigned int i = 0; i < size_of(l); ++i)
          for (unsigned int j = 0; j < size_of(l); ++j, ++column)
            if (j > 0 && column[0] == column[-1] + 1)
              ++runs.back().size;
            else
              runs.push_back({column[0], 1});
        run_begins.push_back(runs.size());
      }
  }



  void
  SystemMatrix::find_shuffled_rows()
  {
    // The columns of a row of Epetra's matrix are sorted by their local number,
    // except for those of other processes if there is more than one of these:
    // it sorts them by process, with a sort that is not stable.
    const Epetra_CrsMatrix &epetra = sparse_matrix.trilinos_matrix();
    int                    *begins, *column_numbers;
    double                 *values;
    epetra.ExtractCrsDataPointers(begins, column_numbers, values);

    const unsigned int nc = n_components;
    std::vector<int>   place_of(epetra.NumMyCols());
    shuffled_begins.assign(n_owned, numbers::invalid_unsigned_int);
    shuffled_places.clear();
    for (unsigned int f = 0; f < n_owned; ++f)
      {
        const int first = begins[nc * f];
        for (int k = first; k < begins[nc * f + 1]; ++k)
          place_of[column_numbers[k]] = k - first;

        const unsigned int begin       = shuffled_places.size();
        bool               is_shuffled = false;
        for (std::size_t k = row_functions_begins[f];
             k < row_functions_begins[f + 1];
             ++k)
          for (unsigned int b = 0; b < nc; ++b)
            {
              const int place = place_of[epetra.LCID(
                static_cast<int>(nc * row_functions[k] + b))];
              is_shuffled |=
                place != static_cast<int>(shuffled_places.size() - begin);
              shuffled_places.push_back(place);
            }
        if (is_shuffled)
          shuffled_begins[f] = begin;
        else
          shuffled_places.resize(begin);
      }
  }



  void
  SystemMatrix::assign_slots(const Occurrences &occurrences)
  {
    const unsigned int n_known = global_functions.size();
    std::size_t        width   = 0;
    slots.assign(n_known, 0);
    first_lists.assign(n_known, 1);
    last_lists.assign(n_known, 0);
    for (unsigned int f = 0; f < n_known; ++f)
      {
        width         = std::max(width,
                         row_functions_begins[f + 1] - row_functions_begins[f]);
        bool is_first = true;
        occurrences.visit(f, [&](const unsigned int l, const unsigned int) {
          if (is_first)
            first_lists[f] = l;
          is_first      = false;
          last_lists[f] = l;
        });
      }

    // The slot that was left last is taken first: it is in the caches.
    std::vector<unsigned int> free_slots;
    unsigned int              n_slots = 0, max_size = 0;
    for (unsigned int l = 0; l + 1 < list_begins.size(); ++l)
      {
        for (std::size_t k = list_begins[l]; k < list_begins[l + 1]; ++k)
          {
            const unsigned int f = list_functions[k];
            if (first_lists[f] != l)
              continue;
            if (free_slots.empty())
              free_slots.push_back(n_slots++);
            slots[f] = free_slots.back();
            free_slots.pop_back();
          }
        for (std::size_t k = list_begins[l]; k < list_begins[l + 1]; ++k)
          if (last_lists[list_functions[k]] == l)
            free_slots.push_back(slots[list_functions[k]]);
        max_size =
          std::max<unsigned int>(max_size, list_begins[l + 1] - list_begins[l]);
      }
    slot_size = n_components * n_components * width;
    open_rows.resize(n_slots * slot_size);
    row_pointers.resize(max_size);
  }



  void
  SystemMatrix::begin(const std::vector<bool> *wanted_functions)
  {
    wanted    = wanted_functions;
    next_list = 0;
    for (unsigned int f = 0; f < n_owned; ++f)
      if (last_lists[f] < first_lists[f])
        std::fill(entries + row_begins[n_components * f],
                  entries + row_begins[n_components * (f + 1)],
                  0.);
  }



  void
  SystemMatrix::add(const unsigned int list,
                    const double      *values,
                    const unsigned int stride)
  {
    AssertIndexRange(list + 1, list_begins.size());
    Assert(list >= next_list, ExcMessage("Lists have to be in their order."));
    for (; next_list < list; ++next_list)
      add_list(next_list, nullptr, 0);
    add_list(next_list++, values, stride);
  }



  inline double *
  SystemMatrix::open_row(const unsigned int function)
  {
    return open_rows.data() + slots[function] * slot_size;
  }



  void
  SystemMatrix::close_row(const unsigned int f)
  {
    const unsigned int nc = n_components;
    const std::size_t  width =
      row_functions_begins[f + 1] - row_functions_begins[f];
    const int *places =
      (f < n_owned && shuffled_begins[f] != numbers::invalid_unsigned_int) ?
        shuffled_places.data() + shuffled_begins[f] :
        nullptr;
    for (unsigned int a = 0; a < nc; ++a)
      {
        const double *from = open_row(f) + nc * a;
        double       *to   = (f < n_owned) ?
                               entries + row_begins[nc * f + a] :
                               ghost_entries.data() + ghost_row_begins[f - n_owned] +
                         a * nc * width;
        for (std::size_t k = 0; k < width; ++k, from += nc * nc)
          for (unsigned int b = 0; b < nc; ++b)
            to[places == nullptr ? nc * k + b : places[nc * k + b]] = from[b];
      }
  }



  namespace
  {
    /**
     * Add a local matrix of n x n blocks to rows, along runs of columns that
     * are neighbours.
     */
    struct AddRuns
    {
      template <unsigned int n_bytes, typename Run>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int n,
          const unsigned int block_size,
          const double      *values,
          const unsigned int stride,
          const Run         *run,
          double *const     *rows)
      {
        using L = Lanes<n_bytes>;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; j += run->size, ++run)
            {
              const double      *from   = values + i * stride + j * block_size;
              double            *to     = rows[i] + run->column * block_size;
              const unsigned int length = run->size * block_size;

              unsigned int k = 0;
              for (; k + L::n <= length; k += L::n)
                L::store(L::load(to + k) + L::load(from + k), to + k);
              for (; k < length; ++k)
                to[k] += from[k];
            }
      }
    };
  } // namespace



  void
  SystemMatrix::add_list(const unsigned int list,
                         const double      *values,
                         const unsigned int stride)
  {
    const unsigned int  n          = list_begins[list + 1] - list_begins[list];
    const unsigned int *f          = list_functions.data() + list_begins[list];
    const unsigned int  block_size = n_components * n_components;
    const auto          is_wanted  = [this](const unsigned int function) {
      return wanted == nullptr || (*wanted)[function];
    };

    for (unsigned int i = 0; i < n; ++i)
      {
        row_pointers[i] = open_row(f[i]);
        if (first_lists[f[i]] == list && is_wanted(f[i]))
          std::fill_n(row_pointers[i],
                      block_size * (row_functions_begins[f[i] + 1] -
                                    row_functions_begins[f[i]]),
                      0.);
      }
    if (values != nullptr)
      run_best<AddRuns>(n,
                        block_size,
                        values,
                        stride,
                        runs.data() + run_begins[list],
                        row_pointers.data());
    for (unsigned int i = 0; i < n; ++i)
      if (last_lists[f[i]] == list && is_wanted(f[i]))
        close_row(f[i]);
  }



  const LA::SparseMatrix &
  SystemMatrix::matrix() const
  {
    return sparse_matrix;
  }



  std::size_t
  SystemMatrix::memory_consumption() const
  {
    return list_functions.capacity() * sizeof(unsigned int) +
           (row_functions.capacity() + global_functions.capacity()) *
             sizeof(types::global_dof_index) +
           runs.capacity() * sizeof(Run) +
           (slots.capacity() + first_lists.capacity() + last_lists.capacity() +
            shuffled_begins.capacity()) *
             sizeof(unsigned int) +
           shuffled_places.capacity() * sizeof(int) +
           (list_begins.capacity() + run_begins.capacity() +
            row_functions_begins.capacity() + ghost_row_begins.capacity() +
            arrival_places.capacity()) *
             sizeof(std::size_t) +
           row_pointers.capacity() * sizeof(double *) +
           (open_rows.capacity() + ghost_entries.capacity() +
            arrivals.capacity()) *
             sizeof(double);
  }
} // namespace EBSMPM
