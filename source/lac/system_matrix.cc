// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/lac/system_matrix.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace EBSMPM
{
  bool
  SystemMatrix::reinit(const Utilities::MPI::Partitioner &functions,
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

    // Most often, nothing has changed since the last load step.
    const bool is_new = n_components != n_components_ ||
                        n_owned != functions.locally_owned_size() ||
                        new_global_functions != global_functions ||
                        new_list_functions != list_functions ||
                        new_list_begins != list_begins;
    if (Utilities::MPI::max(is_new ? 1U : 0U,
                            functions.get_mpi_communicator()) == 0)
      return false;

    n_components          = n_components_;
    n_owned               = functions.locally_owned_size();
    const unsigned int nc = n_components;
    global_functions.swap(new_global_functions);
    list_functions.swap(new_list_functions);
    list_begins.swap(new_list_begins);

    // Where each function occurs: in which lists, and at which position there.
    struct Occurrence
    {
      unsigned int list;
      unsigned int position;
    };
    std::vector<unsigned int> occurrence_begins(n_known + 1, 0);
    for (const auto function : list_functions)
      ++occurrence_begins[function + 1];
    std::partial_sum(occurrence_begins.begin(),
                     occurrence_begins.end(),
                     occurrence_begins.begin());
    std::vector<Occurrence> occurrences(list_functions.size());
    {
      std::vector<unsigned int> next(occurrence_begins.begin(),
                                     occurrence_begins.end() - 1);
      for (unsigned int l = 0; l < lists.size(); ++l)
        for (unsigned int i = 0; i < lists[l].size; ++i)
          occurrences[next[lists[l].begin[i]]++] = {l, i};
    }
    const auto for_each_occurrence = [&](const unsigned int function,
                                         const auto        &visit) {
      for (unsigned int k = occurrence_begins[function];
           k < occurrence_begins[function + 1];
           ++k)
        visit(occurrences[k].list, occurrences[k].position);
    };

    // Couple functions first, and their components afterwards.
    const IndexSet &owned    = functions.locally_owned_range();
    IndexSet        relevant = owned;
    relevant.add_indices(functions.ghost_indices());
    DynamicSparsityPattern                            coupling(functions.size(),
                                    functions.size(),
                                    relevant);
    std::vector<std::vector<types::global_dof_index>> ghost_rows;
    std::vector<types::global_dof_index>              row;
    std::vector<unsigned int> seen_by(n_known, numbers::invalid_unsigned_int);
    for (unsigned int f = 0; f < n_known; ++f)
      {
        row.clear();
        for_each_occurrence(f, [&](const unsigned int l, const unsigned int) {
          for (unsigned int j = 0; j < lists[l].size; ++j)
            if (seen_by[lists[l].begin[j]] != f)
              {
                seen_by[lists[l].begin[j]] = f;
                row.push_back(global_functions[lists[l].begin[j]]);
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

    IndexSet rows(nc * functions.size());
    if (owned.n_elements() > 0)
      rows.add_range(nc * owned.nth_index_in_set(0),
                     nc * (owned.nth_index_in_set(0) + n_owned));
    rows.compress();
    DynamicSparsityPattern sparsity(rows.size(), rows.size(), rows);
    for (const auto i : owned)
      {
        row.clear();
        for (auto entry = coupling.begin(i); entry != coupling.end(i); ++entry)
          for (unsigned int c = 0; c < nc; ++c)
            row.push_back(nc * entry->column() + c);
        for (unsigned int c = 0; c < nc; ++c)
          sparsity.add_entries(nc * i + c, row.begin(), row.end(), true);
      }
    sparse_matrix.reinit(
      rows, rows, sparsity, functions.get_mpi_communicator(), false);

    // Raw access to the rows we own. The columns of a row are sorted by their
    // local number, and those of the components of a function are consecutive,
    // except that Epetra shuffles the columns of other processes if there is
    // more than one of these: it sorts them by process, with a sort that is not
    // stable.
    const Epetra_CrsMatrix &epetra = sparse_matrix.trilinos_matrix();
    int                    *begins, *column_numbers;
    const int               ierr =
      epetra.ExtractCrsDataPointers(begins, column_numbers, entries);
    AssertThrow(ierr == 0, ExcInternalError());
    row_begins = begins;

    std::vector<int> column_of(nc * n_known);
    for (unsigned int i = 0; i < n_known; ++i)
      for (unsigned int c = 0; c < nc; ++c)
        column_of[nc * i + c] =
          epetra.LCID(static_cast<int>(nc * global_functions[i] + c));

    // The places of a list, row by row, counted from the begin of the row.
    place_begins.assign(1, 0);
    for (const auto &list : lists)
      place_begins.push_back(place_begins.back() + list.size * list.size);
    places.assign(place_begins.back(), -1);
    scattered_places.clear();
    std::vector<int> place_of(epetra.NumMyCols());
    for (unsigned int f = 0; f < n_owned; ++f)
      {
        const int *begin = column_numbers + begins[nc * f];
        const int *end   = column_numbers + begins[nc * f + 1];
        for (const int *column = begin; column != end; ++column)
          place_of[*column] = column - begin;

        for_each_occurrence(f, [&](const unsigned int l, const unsigned int i) {
          int *place = places.data() + place_begins[l] + i * lists[l].size;
          for (unsigned int j = 0; j < lists[l].size; ++j)
            {
              const int *columns_j = column_of.data() + nc * lists[l].begin[j];
              bool       consecutive = true;
              for (unsigned int b = 1; b < nc; ++b)
                consecutive &= (place_of[columns_j[b]] ==
                                place_of[columns_j[0]] + static_cast<int>(b));
              if (consecutive)
                place[j] = place_of[columns_j[0]];
              else
                {
                  place[j] = -1 - static_cast<int>(scattered_places.size());
                  for (unsigned int b = 0; b < nc; ++b)
                    scattered_places.push_back(place_of[columns_j[b]]);
                }
            }
        });
      }
    // In rows of others, the components of a function are neighbours anyway.
    std::vector<int> local_place(n_known);
    for (unsigned int f = n_owned; f < n_known; ++f)
      {
        const auto &ghost_row = ghost_rows[f - n_owned];
        for (unsigned int k = 0; k < ghost_row.size(); ++k)
          local_place[functions.global_to_local(ghost_row[k])] = nc * k;
        for_each_occurrence(f, [&](const unsigned int l, const unsigned int i) {
          int *place = places.data() + place_begins[l] + i * lists[l].size;
          for (unsigned int j = 0; j < lists[l].size; ++j)
            place[j] = local_place[lists[l].begin[j]];
        });
      }
    set_up_messages(functions, ghost_rows);
    return true;
  }



  void
  SystemMatrix::set_up_messages(
    const Utilities::MPI::Partitioner                       &functions,
    const std::vector<std::vector<types::global_dof_index>> &ghost_rows)
  {
    const unsigned int nc = n_components;

    // The ghosts of a process follow each other.
    ghost_row_begins.assign(1, 0);
    outgoing.clear();
    std::map<unsigned int, std::vector<types::global_dof_index>> patterns;
    unsigned int                                                 g = 0;
    for (const auto &target : functions.ghost_targets())
      {
        const std::size_t begin   = ghost_row_begins.back();
        auto             &pattern = patterns[target.first];
        for (unsigned int k = 0; k < target.second; ++k, ++g)
          {
            pattern.push_back(global_functions[n_owned + g]);
            pattern.push_back(ghost_rows[g].size());
            pattern.insert(pattern.end(),
                           ghost_rows[g].begin(),
                           ghost_rows[g].end());
            ghost_row_begins.push_back(ghost_row_begins.back() +
                                       nc * nc * ghost_rows[g].size());
          }
        outgoing.push_back(
          {target.first, begin, ghost_row_begins.back() - begin});
      }
    AssertDimension(g, ghost_rows.size());
    ghost_entries.assign(ghost_row_begins.back(), 0.);

    const Epetra_CrsMatrix &epetra = sparse_matrix.trilinos_matrix();
    int                    *begins, *column_numbers;
    double                 *values;
    epetra.ExtractCrsDataPointers(begins, column_numbers, values);
    std::vector<int> place_of(epetra.NumMyCols());

    arrival_places.clear();
    incoming.clear();
    for (const auto &message :
         Utilities::MPI::some_to_some(functions.get_mpi_communicator(),
                                      patterns))
      {
        const std::size_t begin = arrival_places.size();
        const auto       &data  = message.second;
        for (std::size_t k = 0; k < data.size();)
          {
            const unsigned int f         = functions.global_to_local(data[k]);
            const std::size_t  n_columns = data[k + 1];
            k += 2;
            for (unsigned int a = 0; a < nc; ++a)
              {
                const int row_begin = begins[nc * f + a];
                for (int c = row_begin; c < begins[nc * f + a + 1]; ++c)
                  place_of[column_numbers[c]] = c;
                for (std::size_t j = 0; j < n_columns; ++j)
                  for (unsigned int b = 0; b < nc; ++b)
                    arrival_places.push_back(place_of[epetra.LCID(
                      static_cast<int>(nc * data[k + j] + b))]);
              }
            k += n_columns;
          }
        incoming.push_back(
          {message.first, begin, arrival_places.size() - begin});
      }
    arrivals.resize(arrival_places.size());
  }



  void
  SystemMatrix::set_zero()
  {
    sparse_matrix = 0.;
    std::fill(ghost_entries.begin(), ghost_entries.end(), 0.);
  }



  void
  SystemMatrix::add(const unsigned int list,
                    const double      *values,
                    const unsigned int stride)
  {
    switch (n_components)
      {
        case 1:
          add_components<1>(list, values, stride);
          break;
        case 2:
          add_components<2>(list, values, stride);
          break;
        case 3:
          add_components<3>(list, values, stride);
          break;
        default:
          Assert(false, ExcNotImplemented());
      }
  }



  template <unsigned int nc>
  void
  SystemMatrix::add_components(const unsigned int list,
                               const double      *values,
                               const unsigned int stride)
  {
    AssertIndexRange(list + 1, list_begins.size());
    const unsigned int  n     = list_begins[list + 1] - list_begins[list];
    const unsigned int *f     = list_functions.data() + list_begins[list];
    const int          *place = places.data() + place_begins[list];
    const auto          pair  = [](const unsigned int a, const unsigned int b) {
      return a * nc - a * (a + 1) / 2 + b;
    };

    const auto row_of = [&](const unsigned int function, const unsigned int a) {
      if (function < n_owned)
        return entries + row_begins[nc * function + a];
      const std::size_t *begin = &ghost_row_begins[function - n_owned];
      return ghost_entries.data() + begin[0] + a * (begin[1] - begin[0]) / nc;
    };

    row_values.resize(nc * n);
    runs.resize(n);
    for (unsigned int i = 0; i < n; ++i, place += n)
      {
        // Functions are numbered along lines of the lattice.
        unsigned int n_runs = 0;
        for (unsigned int j = 0; j < n; ++j)
          if (n_runs > 0 && place[j] >= 0 && place[j - 1] >= 0 &&
              place[j] == place[j - 1] + static_cast<int>(nc))
            ++runs[n_runs - 1].size;
          else
            runs[n_runs++] = {j, 1};

        // The next rows are on their way while these are added to.
        if (i + 1 < n)
          for (unsigned int a = 0; a < nc; ++a)
            {
              const double *row = row_of(f[i + 1], a);
              for (unsigned int j = 0; j < n; j += 3)
                if (place[n + j] >= 0)
                  {
                    __builtin_prefetch(row + place[n + j], 1);
                    __builtin_prefetch(row + place[n + j] + 3 * nc - 1, 1);
                  }
            }

        for (unsigned int a = 0; a < nc; ++a)
          {
            for (unsigned int b = 0; b < a; ++b)
              {
                const double *column = values + pair(b, a) * n + i;
                for (unsigned int j = 0; j < n; ++j)
                  row_values[nc * j + b] = column[j * stride];
              }
            for (unsigned int b = a; b < nc; ++b)
              {
                const double *row = values + i * stride + pair(a, b) * n;
                for (unsigned int j = 0; j < n; ++j)
                  row_values[nc * j + b] = row[j];
              }

            double *const row = row_of(f[i], a);
            for (unsigned int r = 0; r < n_runs; ++r)
              {
                const unsigned int j    = runs[r].begin;
                const double      *from = row_values.data() + nc * j;
                if (place[j] >= 0)
                  {
                    double *const to = row + place[j];
                    for (unsigned int k = 0; k < nc * runs[r].size; ++k)
                      to[k] += from[k];
                  }
                else
                  for (unsigned int b = 0; b < nc; ++b)
                    row[scattered_places[-1 - place[j] + b]] += from[b];
              }
          }
      }
  }



  void
  SystemMatrix::compress()
  {
    const MPI_Comm communicator = sparse_matrix.get_mpi_communicator();
    constexpr int  tag          = 4711;
    std::vector<MPI_Request> requests;
    for (const Message &message : incoming)
      {
        requests.emplace_back();
        const int ierr = MPI_Irecv(arrivals.data() + message.begin,
                                   message.size,
                                   MPI_DOUBLE,
                                   message.rank,
                                   tag,
                                   communicator,
                                   &requests.back());
        AssertThrowMPI(ierr);
      }
    for (const Message &message : outgoing)
      {
        requests.emplace_back();
        const int ierr = MPI_Isend(ghost_entries.data() + message.begin,
                                   message.size,
                                   MPI_DOUBLE,
                                   message.rank,
                                   tag,
                                   communicator,
                                   &requests.back());
        AssertThrowMPI(ierr);
      }
    const int ierr =
      MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(ierr);
    for (std::size_t k = 0; k < arrivals.size(); ++k)
      entries[arrival_places[k]] += arrivals[k];
    sparse_matrix.compress(VectorOperation::add);
  }



  const LA::SparseMatrix &
  SystemMatrix::matrix() const
  {
    return sparse_matrix;
  }



  std::size_t
  SystemMatrix::memory_consumption() const
  {
    return (places.capacity() + scattered_places.capacity()) * sizeof(int) +
           list_functions.capacity() * sizeof(unsigned int) +
           (list_begins.capacity() + place_begins.capacity() +
            ghost_row_begins.capacity() + arrival_places.capacity()) *
             sizeof(std::size_t) +
           (ghost_entries.capacity() + arrivals.capacity()) * sizeof(double) +
           global_functions.capacity() * sizeof(types::global_dof_index);
  }
} // namespace EBSMPM
