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

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <utility>

namespace EBSMPM
{
  /** The rows that other processes have sent. */
  class SystemMatrix::ArrivingRows
  {
  public:
    using Numbers = std::vector<types::global_dof_index>;

    /**
     * @param messages by the rank of the sender; for each row the function,
     *   the number of columns, and the columns
     */
    explicit ArrivingRows(std::map<unsigned int, Numbers> &&messages)
      : messages(std::move(messages))
    {}

    /** Call <tt>visit(rank, function, first column, end of columns)</tt>. */
    template <typename Visitor>
    void
    visit(const Visitor &visitor) const
    {
      for (const auto &message : messages)
        for (auto row = message.second.begin(); row != message.second.end();
             row += 2 + row[1])
          visitor(message.first, row[0], row + 2, row + 2 + row[1]);
    }

  private:
    std::map<unsigned int, Numbers> messages;
  };



  void
  SystemMatrix::exchange_rows(const Utilities::MPI::Partitioner &functions)
  {
    // The ghosts of a process follow each other.
    const unsigned int block_size = n_components * n_components;
    std::map<unsigned int, ArrivingRows::Numbers> messages;
    outgoing.clear();
    ghost_entries.assign(block_size * (row_begins.back() - row_begins[n_owned]),
                         0.);
    unsigned int f = n_owned;
    for (const auto &target : functions.ghost_targets())
      {
        const std::size_t begin   = row_begins[f];
        auto             &message = messages[target.first];
        for (unsigned int g = 0; g < target.second; ++g, ++f)
          {
            message.push_back(global_functions[f]);
            message.push_back(row_length(f));
            for (std::size_t k = row_begins[f]; k < row_begins[f + 1]; ++k)
              message.push_back(global_functions[row_columns[k]]);
          }
        outgoing.push_back({target.first,
                            block_size * (begin - row_begins[n_owned]),
                            block_size * (row_begins[f] - begin)});
      }
    AssertDimension(f, global_functions.size());

    const ArrivingRows arriving_rows(
      Utilities::MPI::some_to_some(functions.get_mpi_communicator(), messages));
    number_columns(functions, arriving_rows);
    add_rows(functions, arriving_rows);
    find_arrival_places(functions, arriving_rows);
  }



  void
  SystemMatrix::number_columns(const Utilities::MPI::Partitioner &functions,
                               const ArrivingRows                &arriving_rows)
  {
    // They include functions that only other processes know.
    std::vector<types::global_dof_index> foreign;
    arriving_rows.visit([&](const auto,
                            const auto,
                            const auto begin,
                            const auto end) {
      std::copy_if(begin, end, std::back_inserter(foreign), [&](const auto g) {
        return !functions.in_local_range(g);
      });
    });
    std::sort(foreign.begin(), foreign.end());
    foreign_columns = functions.ghost_indices();
    foreign_columns.add_indices(foreign.begin(), foreign.end());
    foreign_columns.compress();

    columns.clear();
    for (const auto g : global_functions)
      columns.push_back(column(functions, g));
  }



  unsigned int
  SystemMatrix::column(const Utilities::MPI::Partitioner &functions,
                       const types::global_dof_index      function) const
  {
    return functions.in_local_range(function) ?
             functions.global_to_local(function) :
             n_owned + foreign_columns.index_within_set(function);
  }



  void
  SystemMatrix::add_rows(const Utilities::MPI::Partitioner &functions,
                         const ArrivingRows                &arriving_rows)
  {
    std::vector<std::pair<unsigned int, unsigned int>> arriving_columns;
    arriving_rows.visit(
      [&](const auto, const auto g, const auto begin, const auto end) {
        for (auto c = begin; c != end; ++c)
          arriving_columns.emplace_back(functions.global_to_local(g),
                                        column(functions, *c));
      });
    std::sort(arriving_columns.begin(), arriving_columns.end());

    std::vector<unsigned int> row_functions;
    std::vector<std::size_t>  row_functions_begins(1, 0);
    row_functions.swap(row_columns);
    row_functions_begins.swap(row_begins);
    auto arriving = arriving_columns.begin();
    for (unsigned int f = 0; f < global_functions.size(); ++f)
      {
        // Columns are in the order of functions.
        for (std::size_t k = row_functions_begins[f];
             k < row_functions_begins[f + 1];
             ++k)
          row_columns.push_back(columns[row_functions[k]]);

        if (arriving != arriving_columns.end() && arriving->first == f)
          {
            for (; arriving != arriving_columns.end() && arriving->first == f;
                 ++arriving)
              row_columns.push_back(arriving->second);
            const auto begin = row_columns.begin() + row_begins.back();
            std::sort(begin, row_columns.end());
            row_columns.erase(std::unique(begin, row_columns.end()),
                              row_columns.end());
          }
        row_begins.push_back(row_columns.size());
      }
    find_mirrors(row_functions, row_functions_begins);
  }



  void
  SystemMatrix::find_arrival_places(
    const Utilities::MPI::Partitioner &functions,
    const ArrivingRows                &arriving_rows)
  {
    const unsigned int nc = n_components;
    arrival_places.clear();
    incoming.clear();
    std::vector<std::size_t> places;
    arriving_rows.visit(
      [&](const auto rank, const auto g, const auto begin, const auto end) {
        const unsigned int f         = functions.global_to_local(g);
        const auto         row_begin = row_columns.begin() + row_begins[f];
        const auto         row_end   = row_columns.begin() + row_begins[f + 1];
        places.clear();
        for (auto c = begin; c != end; ++c)
          places.push_back(
            std::lower_bound(row_begin, row_end, column(functions, *c)) -
            row_begin);

        if (incoming.empty() || incoming.back().rank != rank)
          incoming.push_back({rank, arrival_places.size(), 0});
        for (unsigned int a = 0; a < nc; ++a)
          for (const std::size_t place : places)
            for (unsigned int b = 0; b < nc; ++b)
              arrival_places.push_back(
                nc * (nc * row_begins[f] + a * row_length(f) + place) + b);
        incoming.back().size = arrival_places.size() - incoming.back().begin;
      });
    arrivals.resize(arrival_places.size());
  }



  void
  SystemMatrix::compress()
  {
    // Lists without a local matrix.
    if (next_list + 1 < list_begins.size())
      add(list_begins.size() - 2, nullptr);

    // What has been written past the caches is to be seen by other threads,
    // too.
    std::atomic_thread_fence(std::memory_order_seq_cst);

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
