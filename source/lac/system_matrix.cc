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

    // Couple functions first, and their components afterwards.
    const IndexSet &owned    = functions.locally_owned_range();
    IndexSet        relevant = owned;
    relevant.add_indices(functions.ghost_indices());
    DynamicSparsityPattern               coupling(functions.size(),
                                    functions.size(),
                                    relevant);
    std::vector<types::global_dof_index> row;
    for (const auto &list : lists)
      {
        row.resize(list.size);
        for (unsigned int j = 0; j < list.size; ++j)
          row[j] = global_functions[list.begin[j]];
        std::sort(row.begin(), row.end());
        for (const auto i : row)
          coupling.add_entries(i, row.begin(), row.end(), true);
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

    place_begins.assign(1, 0);
    places.clear();
    scattered_places.clear();
    for (const auto &list : lists)
      {
        for (unsigned int i = 0; i < list.size; ++i)
          {
            const unsigned int function = list.begin[i];
            for (unsigned int j = 0; j < list.size; ++j)
              {
                if (function >= n_owned)
                  {
                    places.push_back(-1);
                    continue;
                  }
                const int *begin = column_numbers + begins[nc * function];
                const int *end   = column_numbers + begins[nc * function + 1];
                const auto place_of = [&](const int column) {
                  const int *found = std::lower_bound(begin, end, column);
                  Assert(found != end && *found == column, ExcInternalError());
                  return static_cast<int>(found - begin);
                };
                const int *columns_j   = column_of.data() + nc * list.begin[j];
                const int  first_place = place_of(columns_j[0]);
                bool       consecutive = true;
                for (unsigned int b = 1; b < nc; ++b)
                  consecutive &= (place_of(columns_j[b]) ==
                                  first_place + static_cast<int>(b));
                if (consecutive)
                  places.push_back(first_place);
                else
                  {
                    places.push_back(-1 -
                                     static_cast<int>(scattered_places.size()));
                    for (unsigned int b = 0; b < nc; ++b)
                      scattered_places.push_back(place_of(columns_j[b]));
                  }
              }
          }
        place_begins.push_back(places.size());
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
