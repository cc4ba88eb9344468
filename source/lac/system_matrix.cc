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
                                         const auto &       visit) {
      for (unsigned int k = occurrence_begins[function];
           k < occurrence_begins[function + 1];
           ++k)
        visit(occurrences[k].list, occurrences[k].position);
    };

    // Couple functions first, and their components afterwards.
    const IndexSet &owned    = functions.locally_owned_range();
    IndexSet        relevant = owned;
    relevant.add_indices(functions.ghost_indices());
    DynamicSparsityPattern               coupling(functions.size(),
                                    functions.size(),
                                    relevant);
    std::vector<types::global_dof_index> row;
    std::vector<unsigned int>            seen_by(n_known,
                                      numbers::invalid_unsigned_int);
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

    // The places of a list, row by row; those in rows of others are not used.
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
    return true;
  }



  void
  SystemMatrix::set_zero()
  {
    sparse_matrix = 0.;
  }



  void
  SystemMatrix::add(const unsigned int list, const double *values)
  {
    AssertIndexRange(list + 1, list_begins.size());
    const unsigned int  n     = list_begins[list + 1] - list_begins[list];
    const unsigned int  nc    = n_components;
    const unsigned int *f     = list_functions.data() + list_begins[list];
    const int          *place = places.data() + place_begins[list];

    for (unsigned int i = 0; i < n; ++i, place += n)
      for (unsigned int a = 0; a < nc; ++a, values += nc * n)
        if (f[i] < n_owned)
          {
            double *row = entries + row_begins[nc * f[i] + a];
            for (unsigned int j = 0; j < n; ++j)
              if (place[j] >= 0)
                for (unsigned int b = 0; b < nc; ++b)
                  row[place[j] + b] += values[nc * j + b];
              else
                for (unsigned int b = 0; b < nc; ++b)
                  row[scattered_places[-1 - place[j] + b]] +=
                    values[nc * j + b];
          }
        else
          {
            columns.resize(nc * n);
            for (unsigned int j = 0; j < n; ++j)
              for (unsigned int b = 0; b < nc; ++b)
                columns[nc * j + b] = nc * global_functions[f[j]] + b;
            sparse_matrix.add(nc * global_functions[f[i]] + a,
                              nc * n,
                              columns.data(),
                              values,
                              false);
          }
  }



  void
  SystemMatrix::compress()
  {
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
           (list_begins.capacity() + place_begins.capacity()) *
             sizeof(std::size_t) +
           global_functions.capacity() * sizeof(types::global_dof_index);
  }
} // namespace EBSMPM
