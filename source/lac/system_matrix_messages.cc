// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of SystemMatrix that sends rows to their owners.

#include <ebsmpm/lac/system_matrix.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>

#include <map>

namespace EBSMPM
{
  void
  SystemMatrix::set_up_messages(const Utilities::MPI::Partitioner &functions)
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
            const std::size_t row_begin = row_functions_begins[n_owned + g];
            const std::size_t row_end   = row_functions_begins[n_owned + g + 1];
            pattern.push_back(global_functions[n_owned + g]);
            pattern.push_back(row_end - row_begin);
            pattern.insert(pattern.end(),
                           row_functions.begin() + row_begin,
                           row_functions.begin() + row_end);
            ghost_row_begins.push_back(ghost_row_begins.back() +
                                       nc * nc * (row_end - row_begin));
          }
        outgoing.push_back(
          {target.first, begin, ghost_row_begins.back() - begin});
      }
    AssertDimension(n_owned + g, global_functions.size());
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
  SystemMatrix::compress()
  {
    // Lists without a local matrix.
    if (next_list + 1 < list_begins.size())
      add(list_begins.size() - 2, nullptr, 0);

    const MPI_Comm communicator = sparse_matrix.get_mpi_communicator();
    constexpr int  tag          = 4711;
    std::vector<MPI_Request> requests;
    const auto               start = [&](const std::vector<Message> &messages,
                           std::vector<double>        &values,
                           const auto                 &mpi_function) {
      for (const Message &message : messages)
        {
          requests.emplace_back();
          const int ierr = mpi_function(values.data() + message.begin,
                                        message.size,
                                        MPI_DOUBLE,
                                        message.rank,
                                        tag,
                                        communicator,
                                        &requests.back());
          AssertThrowMPI(ierr);
        }
    };
    start(incoming, arrivals, MPI_Irecv);
    start(outgoing, ghost_entries, MPI_Isend);
    const int ierr =
      MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(ierr);
    for (std::size_t k = 0; k < arrivals.size(); ++k)
      entries[arrival_places[k]] += arrivals[k];
    sparse_matrix.compress(VectorOperation::add);
  }
} // namespace EBSMPM
