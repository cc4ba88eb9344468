// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of SystemMatrix that finds out where things belong: rows, the order
// in which they are closed, mirrors, and runs.

#include <ebsmpm/base/block_row.h>
#include <ebsmpm/base/constant.h>
#include <ebsmpm/base/large_pages.h>

#include <ebsmpm/lac/system_matrix.h>

#include <Epetra_CrsGraph.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <algorithm>
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
    find_rows(occurrences);
    number_closings();
    exchange_rows(functions);
    build_matrix(functions);
    find_runs(occurrences);
    assign_slots();
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
  SystemMatrix::find_rows(const Occurrences &occurrences)
  {
    const unsigned int        n_known = global_functions.size();
    std::vector<unsigned int> seen_by(n_known, numbers::invalid_unsigned_int);
    row_columns.clear();
    row_begins.assign(1, 0);
    for (unsigned int f = 0; f < n_known; ++f)
      {
        occurrences.visit(f, [&](const unsigned int l, const unsigned int) {
          for (std::size_t k = list_begins[l]; k < list_begins[l + 1]; ++k)
            if (seen_by[list_functions[k]] != f)
              {
                seen_by[list_functions[k]] = f;
                row_columns.push_back(list_functions[k]);
              }
        });
        std::sort(row_columns.begin() + row_begins.back(), row_columns.end());
        row_begins.push_back(row_columns.size());
      }
  }



  void
  SystemMatrix::find_mirrors(const std::vector<unsigned int> &coupled,
                             const std::vector<std::size_t>  &begins)
  {
    std::vector<std::uint16_t> places;
    places.reserve(coupled.size());
    for (unsigned int f = 0; f < global_functions.size(); ++f)
      {
        AssertThrow(row_length(f) <= Run::max_size, ExcInternalError());
        std::size_t k = row_begins[f];
        for (std::size_t c = begins[f]; c < begins[f + 1]; ++c, ++k)
          {
            while (row_columns[k] != columns[coupled[c]])
              ++k;
            places.push_back(k - row_begins[f]);
          }
      }

    // Functions and what they couple with are in ascending order: in each row,
    // one coupling after the other is reached from the other side.
    std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
    mirrors.clear();
    mirror_begins.assign(1, 0);
    first_places.clear();
    for (unsigned int f = 0; f < global_functions.size(); ++f)
      {
        std::uint16_t n_from_mirrors = 0;
        for (std::size_t c = begins[f]; c < begins[f + 1]; ++c)
          {
            const unsigned int g        = coupled[c];
            const std::size_t  reversed = next[g]++;
            if (closing_numbers[g] > closing_numbers[f])
              mirrors.push_back({g, places[c], places[reversed]});
            else if (g != f && places[c] == n_from_mirrors)
              ++n_from_mirrors;
          }
        mirror_begins.push_back(mirrors.size());
        first_places.push_back(n_from_mirrors);
      }
  }



  void
  SystemMatrix::build_matrix(const Utilities::MPI::Partitioner &functions)
  {
    using Number          = TrilinosWrappers::types::int_type;
    const unsigned int nc = n_components;

    // What this process owns comes first in the numbers of columns, and
    // everything else, ascending, behind: as Epetra wants it, to whom numbers
    // of columns need not be explained then.
    IndexSet rows(nc * functions.size());
    if (n_owned > 0)
      rows.add_range(nc * global_functions[0],
                     nc * (global_functions[0] + n_owned));
    rows.compress();
    const Epetra_Map row_map =
      rows.make_trilinos_map(functions.get_mpi_communicator(), false);

    std::vector<Number> numbers_of_columns;
    const auto add_columns = [&](const types::global_dof_index function) {
      for (unsigned int c = 0; c < nc; ++c)
        numbers_of_columns.push_back(nc * function + c);
    };
    for (unsigned int f = 0; f < n_owned; ++f)
      add_columns(global_functions[f]);
    for (const auto function : foreign_columns)
      add_columns(function);
    const Epetra_Map column_map(static_cast<Number>(-1),
                                static_cast<int>(numbers_of_columns.size()),
                                numbers_of_columns.data(),
                                0,
                                row_map.Comm());

    std::vector<int> lengths;
    for (unsigned int f = 0; f < n_owned; ++f)
      lengths.insert(lengths.end(), nc, nc * row_length(f));
    Epetra_CrsGraph  graph(Copy, row_map, column_map, lengths.data(), true);
    std::vector<int> row;
    int              ierr = 0;
    for (unsigned int f = 0; f < n_owned; ++f)
      {
        row.clear();
        for (std::size_t k = row_begins[f]; k < row_begins[f + 1]; ++k)
          for (unsigned int c = 0; c < nc; ++c)
            row.push_back(nc * row_columns[k] + c);
        for (unsigned int c = 0; c < nc; ++c)
          ierr |= graph.InsertMyIndices(nc * f + c, row.size(), row.data());
      }
    ierr |= graph.FillComplete();
    ierr |= graph.OptimizeStorage();
    AssertThrow(ierr == 0, ExcInternalError());
    sparse_matrix.reinit(Epetra_CrsMatrix(Copy, graph), false);

    int *begins, *column_numbers;
    ierr =
      sparse_matrix.trilinos_matrix().ExtractCrsDataPointers(begins,
                                                             column_numbers,
                                                             entries);
    AssertThrow(ierr == 0, ExcInternalError());
    if (is_large())
      move_to_large_pages(entries, nc * nc * row_begins[n_owned]);
  }



  void
  SystemMatrix::find_runs(const Occurrences &occurrences)
  {
    // For each pair of functions of a list, the place of the one whose row is
    // closed later in the row of the other one.
    const unsigned int n_lists = list_begins.size() - 1;
    const auto         size_of = [&](const unsigned int l) {
      return list_begins[l + 1] - list_begins[l];
    };
    std::vector<std::size_t> begins(1, 0);
    for (unsigned int l = 0; l < n_lists; ++l)
      begins.push_back(begins.back() + size_of(l) * size_of(l));
    std::vector<std::uint16_t> places(begins.back());
    std::vector<std::uint16_t> place_of(n_owned + foreign_columns.n_elements());
    for (unsigned int f = 0; f < global_functions.size(); ++f)
      {
        for (std::size_t k = row_begins[f]; k < row_begins[f + 1]; ++k)
          place_of[row_columns[k]] = k - row_begins[f];
        occurrences.visit(f, [&](const unsigned int l, const unsigned int i) {
          const unsigned int *g = list_functions.data() + list_begins[l];
          for (unsigned int j = 0; j < size_of(l); ++j)
            if (closing_numbers[g[j]] >= closing_numbers[f])
              places[begins[l] + std::min(i, j) * size_of(l) + std::max(i, j)] =
                place_of[columns[g[j]]];
        });
      }

    // Functions are numbered along lines of the lattice.
    runs.clear();
    run_begins.assign(1, 0);
    for (unsigned int l = 0; l < n_lists; ++l)
      {
        const unsigned int *g = list_functions.data() + list_begins[l];
        for (unsigned int i = 0; i < size_of(l); ++i)
          {
            const std::uint16_t *place =
              places.data() + begins[l] + i * size_of(l);
            bool is_run = false;
            for (unsigned int j = i; j < size_of(l); ++j)
              {
                const bool is_transposed =
                  closing_numbers[g[j]] < closing_numbers[g[i]];
                if (is_run && !is_transposed && place[j] == place[j - 1] + 1)
                  ++runs.back().size;
                else
                  runs.push_back({place[j], 1, is_transposed});
                is_run = !is_transposed;
              }
          }
        run_begins.push_back(runs.size());
      }
  }



  void
  SystemMatrix::number_closings()
  {
    const unsigned int n_known = global_functions.size();
    first_lists.assign(n_known, 1);
    last_lists.assign(n_known, 0);
    for (unsigned int l = 0; l + 1 < list_begins.size(); ++l)
      for (std::size_t k = list_begins[l]; k < list_begins[l + 1]; ++k)
        {
          const unsigned int f = list_functions[k];
          if (last_lists[f] < first_lists[f])
            first_lists[f] = l;
          last_lists[f] = l;
        }

    closing_numbers.assign(n_known, numbers::invalid_unsigned_int);
    unsigned int n_closed = 0;
    for (unsigned int l = 0; l + 1 < list_begins.size(); ++l)
      for (std::size_t k = list_begins[l]; k < list_begins[l + 1]; ++k)
        if (last_lists[list_functions[k]] == l)
          closing_numbers[list_functions[k]] = n_closed++;
  }



  void
  SystemMatrix::assign_slots()
  {
    const unsigned int n_known = global_functions.size();
    std::size_t        width   = 0;
    for (unsigned int f = 0; f < n_known; ++f)
      width = std::max<std::size_t>(width, row_length(f));

    // The slot that was left last is taken first: it is in the caches.
    std::vector<unsigned int> free_slots;
    unsigned int              n_slots = 0, max_size = 0;
    slots.assign(n_known, 0);
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
    with_constant(n_components, [&](const auto nc) {
      slot_size  = BlockRow<nc()>::length(width);
      open_tails = BlockRow<nc()>::tails(width);
    });
    resize_in_large_pages(open_rows, n_slots * slot_size);
    row_pointers.resize(max_size);
    split_row.resize(n_components * n_components * width);
  }
} // namespace EBSMPM
