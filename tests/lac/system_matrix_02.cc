// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// SystemMatrix: a matrix of 71 MB, which is written past the caches, has all
// entries where they belong, with rows that begin anywhere in a cache line, and
// with all instruction sets of the machine.

#include <ebsmpm/base/block_row.h>

#include <ebsmpm/lac/system_matrix.h>

#include <deal.II/base/partitioner.h>

#include <algorithm>
#include <vector>

#include "../tests.h"

#include "../instruction_sets.h"

constexpr unsigned int nc = 3, n_functions = 991;



/** An entry, different for all pairs of unknowns in some order. */
double
entry(const unsigned int i, const unsigned int j)
{
  return 1. * std::min(i, j) * nc * n_functions + std::max(i, j);
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  const Utilities::MPI::Partitioner functions(complete_index_set(n_functions),
                                              MPI_COMM_WORLD);
  std::vector<unsigned int>         list(n_functions);
  for (unsigned int f = 0; f < n_functions; ++f)
    list[f] = f;
  SystemMatrix system;
  system.reinit(functions, nc, {{list.data(), n_functions}});
  deallog << "entries: " << system.matrix().n_nonzero_elements() << std::endl;

  using Row                  = BlockRow<nc>;
  const unsigned int  stride = Row::length(n_functions);
  std::vector<double> values(n_functions * stride);
  for (unsigned int i = 0; i < n_functions; ++i)
    for (unsigned int j = 0; j < n_functions; ++j)
      for (unsigned int a = 0; a < nc; ++a)
        for (unsigned int b = 0; b < nc; ++b)
          values[i * stride + Row::place(n_functions, j, a, b)] =
            entry(i * nc + a, j * nc + b);

  unsigned int n_wrong = 0;
  for_each_instruction_set([&]() {
    system.begin();
    system.add(0, values.data());
    system.compress();
    for (const auto &found : system.matrix())
      n_wrong += (found.value() != entry(found.row(), found.column()));
  });
  deallog << "wrong entries: " << n_wrong << std::endl;
}
