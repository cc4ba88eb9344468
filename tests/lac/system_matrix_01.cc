// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// SystemMatrix: local matrices of windows on a lattice of functions, dealt to
// the processes such that some work for others only, arrive where they belong,
// with all instruction sets of the machine. Of the local matrices, one half is
// given, and the functions of every other window go backwards.

#include <ebsmpm/base/block_row.h>

#include <ebsmpm/lac/system_matrix.h>

#include <deal.II/base/partitioner.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "../tests.h"

#include "../instruction_sets.h"

constexpr unsigned int n_x = 9, n_y = 5, width = 3;
constexpr unsigned int n_functions = n_x * n_y;



/** The functions of the window in a column and a row. */
std::vector<types::global_dof_index>
window(const unsigned int column, const unsigned int row)
{
  std::vector<types::global_dof_index> functions;
  for (unsigned int i = 0; i < width; ++i)
    for (unsigned int j = 0; j < width; ++j)
      functions.push_back((column + i) * n_y + row + j);
  if ((column + row) % 2 == 1)
    std::reverse(functions.begin(), functions.end());
  return functions;
}

/** An entry of a symmetric local matrix, the same for all distributions. */
double
entry(const unsigned int            factor,
      const types::global_dof_index unknown_i,
      const types::global_dof_index unknown_j)
{
  return factor * (std::sin(1. + unknown_i) * std::sin(1. + unknown_j) +
                   std::cos(1. * unknown_i - 1. * unknown_j));
}



template <unsigned int nc>
class Problem
{
public:
  Problem()
  {
    const unsigned int n    = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);

    // The last process owns no function, and the first one works for others.
    const unsigned int n_owners = std::max(n, 2U) - 1;
    IndexSet           owned(n_functions), known(n_functions);
    if (rank < n_owners)
      owned.add_range(rank * n_x / n_owners * n_y,
                      (rank + 1) * n_x / n_owners * n_y);
    for (unsigned int c = 0; c + width <= n_x; ++c)
      if ((c * n / n_x + 1) % n == rank)
        for (unsigned int r = 0; r + width <= n_y; ++r)
          {
            windows.push_back(window(c, r));
            known.add_indices(windows.back().begin(), windows.back().end());
          }
    functions = std::make_unique<Utilities::MPI::Partitioner>(owned,
                                                              known,
                                                              MPI_COMM_WORLD);
  }

  /** Return whether anything is new. */
  bool
  reinit(const unsigned int n_windows)
  {
    numbers.clear();
    for (unsigned int l = 0; l < n_windows; ++l)
      for (const auto f : windows[l])
        numbers.push_back(functions->global_to_local(f));
    std::vector<SystemMatrix::List> lists;
    for (unsigned int l = 0; l < n_windows; ++l)
      lists.push_back({numbers.data() + l * width * width, width * width});
    return system.reinit(*functions, nc, lists);
  }

  /** The largest error in rows of functions that are wanted. */
  double
  assemble(const unsigned int       factor,
           const unsigned int       every,
           const std::vector<bool> *wanted = nullptr)
  {
    // All of it, on all processes.
    FullMatrix<double> expected(nc * n_functions, nc * n_functions);
    for (unsigned int c = 0; c + width <= n_x; ++c)
      for (unsigned int r = 0; r + width <= n_y; ++r)
        if (r % every == 0)
          for (const auto i : window(c, r))
            for (const auto j : window(c, r))
              for (unsigned int a = 0; a < nc; ++a)
                for (unsigned int b = 0; b < nc; ++b)
                  expected(nc * i + a, nc * j + b) +=
                    entry(factor, nc * i + a, nc * j + b);

    using Row                     = BlockRow<nc>;
    constexpr unsigned int size   = width * width;
    constexpr unsigned int stride = Row::length(size);
    std::vector<double>    local(size * stride);
    system.begin(wanted);
    for (unsigned int l = 0; l < windows.size(); ++l)
      if (*std::min_element(windows[l].begin(), windows[l].end()) % n_y %
            every ==
          0)
        {
          const auto &f = windows[l];
          std::fill(local.begin(), local.end(), 1e10);
          for (unsigned int i = 0; i < f.size(); ++i)
            for (unsigned int j = i; j < f.size(); ++j)
              for (unsigned int a = 0; a < nc; ++a)
                for (unsigned int b = 0; b < nc; ++b)
                  local[i * stride + Row::place(size, j, a, b)] =
                    entry(factor, nc * f[i] + a, nc * f[j] + b);
          system.add(l, local.data());
        }
    system.compress();

    double error = 0.;
    for (unsigned int f = 0; f < functions->locally_owned_size(); ++f)
      if (wanted == nullptr || (*wanted)[f])
        for (unsigned int a = 0; a < nc; ++a)
          for (unsigned int j = 0; j < expected.n(); ++j)
            {
              const auto i = nc * functions->local_to_global(f) + a;
              error =
                std::max(error,
                         std::abs(system.matrix().el(i, j) - expected(i, j)));
            }
    return Utilities::MPI::max(error, MPI_COMM_WORLD);
  }

  std::unique_ptr<Utilities::MPI::Partitioner>      functions;
  std::vector<std::vector<types::global_dof_index>> windows;
  std::vector<unsigned int>                         numbers;
  SystemMatrix                                      system;
};



template <unsigned int nc>
void
test()
{
  const auto verdict = [](const bool is_good) {
    return is_good ? "yes" : "FAILED";
  };
  deallog << "components: " << nc << std::endl;
  Problem<nc>        problem;
  const unsigned int n_all = problem.windows.size();

  bool is_new = problem.reinit(n_all);
  is_new      = is_new && !problem.reinit(n_all);
  deallog << "  built once: " << verdict(is_new)
          << ", entries: " << problem.system.matrix().n_nonzero_elements()
          << std::endl;
  bool is_complete = true;
  for_each_instruction_set(
    [&]() { is_complete &= (problem.assemble(1, 1) < 1e-13); });
  deallog << "  complete: " << verdict(is_complete) << std::endl;
  deallog << "  begun anew: " << verdict(problem.assemble(2, 1) < 1e-13)
          << std::endl;
  deallog << "  some left out: " << verdict(problem.assemble(3, 2) < 1e-13)
          << std::endl;

  const unsigned int n_known = problem.functions->locally_owned_size() +
                               problem.functions->n_ghost_indices();
  std::vector<bool> wanted(n_known);
  for (unsigned int f = 0; f < n_known; ++f)
    wanted[f] = (problem.functions->local_to_global(f) % 4 == 0);
  deallog << "  some rows only: "
          << verdict(problem.assemble(4, 1, &wanted) < 1e-13) << std::endl;

  // One process has a list less, and all know.
  const bool has_less = (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
  is_new              = problem.reinit(n_all - (has_less ? 1 : 0));
  deallog << "  built again: " << verdict(is_new)
          << ", entries: " << problem.system.matrix().n_nonzero_elements()
          << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  test<1>();
  test<2>();
  test<3>();
}
