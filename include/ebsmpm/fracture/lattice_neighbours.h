// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_fracture_lattice_neighbours_h
#define ebsmpm_fracture_lattice_neighbours_h

#include <ebsmpm/splines/function_directory.h>
#include <ebsmpm/splines/function_key.h>
#include <ebsmpm/splines/spline_space.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace EBSMPM
{
  /**
   * Call <tt>visit(key)</tt> for all functions within @p radius lattice steps
   * of @p center in each direction, whether or not they exist.
   */
  template <int dim, typename Visitor>
  void
  for_each_neighbour(const FunctionKey<dim> &center,
                     const int               radius,
                     const Visitor          &visit)
  {
    const unsigned int width = 2 * radius + 1;
    const unsigned int n     = Utilities::pow(width, dim);
    for (unsigned int i = 0; i < n; ++i)
      {
        FunctionKey<dim> key = center;
        for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= width)
          key.index[d] += static_cast<int>(rest % width) - radius;
        visit(key);
      }
  }



  /**
   * Return what the owners know about the functions @p wanted, as far as they
   * know anything. Collective.
   *
   * @param table what this process knows; <tt>Value::owner</tt> is the rank
   *   whose entry others get
   * @param wanted the functions to ask about
   * @param communicator of the processes
   */
  template <int dim, typename Value>
  typename FunctionDirectory<dim, Value>::Table
  ask_owners(
    const std::unordered_map<FunctionKey<dim>, Value, FunctionKeyHash<dim>>
                                        &table,
    const std::vector<FunctionKey<dim>> &wanted,
    const MPI_Comm                      &communicator)
  {
    const unsigned int my_rank = Utilities::MPI::this_mpi_process(communicator);
    FunctionDirectory<dim, Value> directory(communicator);
    std::vector<typename FunctionDirectory<dim, Value>::Entry> mine;
    for (const auto &entry : table)
      if (entry.second.owner == my_rank)
        mine.push_back({entry.first, entry.second});
    directory.publish(mine);
    return directory.query(wanted);
  }



  /**
   * Return what is known about all functions within @p radius lattice steps of
   * some others: by this process, or by the owners of the functions.
   * Collective. See ask_owners() for @p table and @p communicator.
   *
   * @param centers the functions around which others are wanted
   * @param radius the number of lattice steps
   */
  template <int dim, typename Value>
  typename FunctionDirectory<dim, Value>::Table
  surroundings(
    const std::unordered_map<FunctionKey<dim>, Value, FunctionKeyHash<dim>>
                                        &table,
    const std::vector<FunctionKey<dim>> &centers,
    const int                            radius,
    const MPI_Comm                      &communicator)
  {
    std::vector<FunctionKey<dim>> wanted;
    for (const auto &center : centers)
      for_each_neighbour(center, radius, [&](const FunctionKey<dim> &key) {
        if (table.find(key) == table.end())
          wanted.push_back(key);
      });
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());

    auto result = ask_owners(table, wanted, communicator);
    result.insert(table.begin(), table.end());
    return result;
  }



  /**
   * Add to @p table what the owners know about functions that this process sees
   * but knows nothing about: only some cells take part in what is known, and
   * those of a process may be on the other side of its border. Collective. See
   * ask_owners() for @p table.
   *
   * @param space tells which functions are seen by several processes
   */
  template <int dim, typename Value>
  void
  add_shared_functions(
    const SplineSpace<dim>                                            &space,
    std::unordered_map<FunctionKey<dim>, Value, FunctionKeyHash<dim>> &table)
  {
    if (Utilities::MPI::n_mpi_processes(space.communicator()) == 1)
      return;
    std::vector<FunctionKey<dim>> wanted;
    for (const auto &entry : space.functions())
      if (entry.second.shared && table.find(entry.first) == table.end())
        wanted.push_back(entry.first);
    const auto theirs = ask_owners(table, wanted, space.communicator());
    table.insert(theirs.begin(), theirs.end());
  }
} // namespace EBSMPM

#endif
