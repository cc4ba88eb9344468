// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/constant.h>
#include <ebsmpm/base/lanes.h>

#include <ebsmpm/lac/system_matrix.h>

#include <Epetra_CrsGraph.h>
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
    find_rows(occurrences);
    number_closings(occurrences);
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
        AssertThrow(row_length(f) <= std::numeric_limits<std::uint16_t>::max(),
                    ExcInternalError());
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
  SystemMatrix::number_closings(const Occurrences &occurrences)
  {
    const unsigned int n_known = global_functions.size();
    first_lists.assign(n_known, 1);
    last_lists.assign(n_known, 0);
    for (unsigned int f = 0; f < n_known; ++f)
      {
        bool is_first = true;
        occurrences.visit(f, [&](const unsigned int l, const unsigned int) {
          if (is_first)
            first_lists[f] = l;
          is_first      = false;
          last_lists[f] = l;
        });
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
    slot_size = n_components * n_components * width;
    open_rows.resize(n_slots * slot_size);
    row_pointers.resize(max_size);
  }



  void
  SystemMatrix::begin(const std::vector<bool> *wanted_functions)
  {
    wanted    = wanted_functions;
    next_list = 0;
    if (wanted != nullptr)
      {
        needed = *wanted;
        for (unsigned int f = 0; f < global_functions.size(); ++f)
          for (std::size_t k = mirror_begins[f]; k < mirror_begins[f + 1]; ++k)
            if ((*wanted)[mirrors[k].function])
              needed[f] = true;
      }
    for (unsigned int f = 0; f < n_owned; ++f)
      if (last_lists[f] < first_lists[f])
        std::fill_n(row(f), n_components * n_components * row_length(f), 0.);
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



  double *
  SystemMatrix::row(const unsigned int function)
  {
    const unsigned int block_size = n_components * n_components;
    return function < n_owned ?
             entries + block_size * row_begins[function] :
             ghost_entries.data() +
               block_size * (row_begins[function] - row_begins[n_owned]);
  }



  namespace
  {
    /**
     * Add an array to another one, with registers that become smaller as less
     * is left.
     */
    template <unsigned int n_bytes>
    EBSMPM_IN_EACH_TARGET void
    add_array(const unsigned int length, const double *from, double *to)
    {
      if constexpr (n_bytes == sizeof(double))
        for (unsigned int k = 0; k < length; ++k)
          to[k] += from[k];
      else
        {
          using L        = Lanes<n_bytes>;
          unsigned int k = 0;
          for (; k + L::n <= length; k += L::n)
            L::store(L::load(to + k) + L::load(from + k), to + k);
          add_array<n_bytes / 2>(length - k, from + k, to + k);
        }
    }



    /**
     * Add one half of a symmetric local matrix of n x n blocks to rows, along
     * runs of columns that are neighbours.
     */
    template <unsigned int n_components>
    struct AddRuns
    {
      static constexpr unsigned int block_size = n_components * n_components;

      /** What quadratic splines have most of. */
      static constexpr unsigned int frequent_size = 3;

      template <unsigned int n_bytes, typename Run>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int n,
          const double      *values,
          const unsigned int stride,
          const Run         *run,
          double *const     *rows)
      {
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = i; j < n; j += run->size, ++run)
            {
              const double *from = values + i * stride + j * block_size;
              double       *to =
                rows[run->is_transposed ? j : i] + run->place * block_size;
              if (run->size == frequent_size)
                add_array<n_bytes>(frequent_size * block_size, from, to);
              else if (!run->is_transposed)
                add_array<n_bytes>(run->size * block_size, from, to);
              else
                for (unsigned int a = 0; a < n_components; ++a)
                  for (unsigned int b = 0; b < n_components; ++b)
                    to[a * n_components + b] += from[b * n_components + a];
            }
      }
    };



    /** Copy blocks of an open row, transposed, to others. */
    template <unsigned int n_components>
    struct CopyMirrors
    {
      template <unsigned int n_bytes, typename Mirror>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int  n,
          const Mirror       *mirror,
          const double       *blocks,
          double             *open_rows,
          const std::size_t   slot_size,
          const unsigned int *slots)
      {
        constexpr unsigned int block_size = n_components * n_components;
        for (unsigned int k = 0; k < n; ++k, ++mirror)
          transpose_block<n_components, n_bytes>(
            blocks + mirror->from * block_size,
            open_rows + slots[mirror->function] * slot_size +
              mirror->to * block_size);
      }
    };



    /** Copy a row of blocks to as many rows of numbers as blocks have. */
    template <unsigned int n_components>
    struct SplitRow
    {
      template <unsigned int n_bytes>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int n_blocks, const double *from, double *to)
      {
        // Three numbers are copied with another one, which is overwritten by
        // what comes next.
        const unsigned int length = n_blocks * n_components;
        unsigned int       k      = 0;
        if constexpr (n_components == 3 && n_bytes >= 32)
          for (; k + 1 < n_blocks; ++k, to += n_components)
            for (unsigned int a = 0; a < n_components;
                 ++a, from += n_components)
              Lanes<32>::store(Lanes<32>::load(from), to + a * length);
        for (; k < n_blocks; ++k, to += n_components)
          for (unsigned int a = 0; a < n_components; ++a, from += n_components)
            for (unsigned int b = 0; b < n_components; ++b)
              to[a * length + b] = from[b];
      }
    };
  } // namespace



  void
  SystemMatrix::begin_row(const unsigned int function)
  {
    const unsigned int block_size = n_components * n_components;
    if (wanted == nullptr || needed[function])
      std::fill(open_row(function) + block_size * first_places[function],
                open_row(function) + block_size * row_length(function),
                0.);
  }



  void
  SystemMatrix::close_row(const unsigned int function)
  {
    if (wanted != nullptr && !needed[function])
      return;

    const double *const blocks = open_row(function);
    const std::size_t   begin  = mirror_begins[function];
    with_constant(n_components, [&](const auto nc) {
      run_best<CopyMirrors<nc()>>(mirror_begins[function + 1] - begin,
                                  mirrors.data() + begin,
                                  blocks,
                                  open_rows.data(),
                                  slot_size,
                                  slots.data());
      if (wanted == nullptr || (*wanted)[function])
        run_best<SplitRow<nc()>>(row_length(function), blocks, row(function));
    });
  }



  void
  SystemMatrix::add_list(const unsigned int list,
                         const double      *values,
                         const unsigned int stride)
  {
    const unsigned int  n = list_begins[list + 1] - list_begins[list];
    const unsigned int *f = list_functions.data() + list_begins[list];

    for (unsigned int i = 0; i < n; ++i)
      {
        row_pointers[i] = open_row(f[i]);
        if (first_lists[f[i]] == list)
          begin_row(f[i]);
      }
    if (values != nullptr)
      with_constant(n_components, [&](const auto nc) {
        run_best<AddRuns<nc()>>(n,
                                values,
                                stride,
                                runs.data() + run_begins[list],
                                row_pointers.data());
      });
    for (unsigned int i = 0; i < n; ++i)
      if (last_lists[f[i]] == list)
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
           global_functions.capacity() * sizeof(types::global_dof_index) +
           foreign_columns.memory_consumption() +
           runs.capacity() * sizeof(Run) + mirrors.capacity() * sizeof(Mirror) +
           first_places.capacity() * sizeof(std::uint16_t) +
           (columns.capacity() + row_columns.capacity() + slots.capacity() +
            closing_numbers.capacity() + first_lists.capacity() +
            last_lists.capacity()) *
             sizeof(unsigned int) +
           (list_begins.capacity() + run_begins.capacity() +
            row_begins.capacity() + mirror_begins.capacity() +
            arrival_places.capacity()) *
             sizeof(std::size_t) +
           row_pointers.capacity() * sizeof(double *) +
           (open_rows.capacity() + ghost_entries.capacity() +
            arrivals.capacity()) *
             sizeof(double);
  }
} // namespace EBSMPM
