// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// SharedFunctions contains all functions that several processes see, and no
// others but those at the boundary of the grid; also after the grid has
// changed.

#include <ebsmpm/splines/shared_functions.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <map>

#include "../tests.h"

using namespace EBSMPM;



template <int dim>
using Index = std::array<std::int32_t, dim>;



/** How many cells of a process each function has. */
template <int dim>
std::map<Index<dim>, unsigned int>
count_cells(const Triangulation<dim>    &triangulation,
            const CartesianLattice<dim> &lattice,
            const unsigned int           degree)
{
  std::map<Index<dim>, unsigned int> result;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      for (unsigned int i = 0; i < Utilities::pow(degree + 1, dim); ++i)
        {
          Index<dim> index = lattice.cell_index(cell);
          for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= degree + 1)
            index[d] += rest % (degree + 1);
          ++result[index];
        }
  return result;
}



template <int dim>
void
test(const unsigned int n_cells)
{
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, n_cells);
  const CartesianLattice<dim> lattice(triangulation);

  for (const unsigned int degree : {1, 2, 3})
    {
      SharedFunctions<dim> shared(triangulation, degree);
      for (const bool refined : {false, true})
        {
          if (refined)
            triangulation.refine_global(1);
          shared.update(lattice);
          const unsigned int level = triangulation.n_levels() - 1;

          const auto mine   = count_cells(triangulation, lattice, degree);
          const auto all    = Utilities::MPI::all_gather(MPI_COMM_WORLD, mine);
          const auto rank   = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
          bool       missed = false, superfluous = false;
          for (const auto &entry : mine)
            {
              FunctionKey<dim> key;
              key.level = level;
              key.index = entry.first;
              key.part  = (entry.first[0] % 2);

              bool         seen_by_others = false;
              unsigned int n_in_all       = 0;
              for (unsigned int r = 0; r < all.size(); ++r)
                if (all[r].count(entry.first) > 0)
                  {
                    seen_by_others |= (r != rank);
                    n_in_all += all[r].at(entry.first);
                  }
              missed |= (seen_by_others && !shared.contains(key));
              superfluous |= (!seen_by_others && shared.contains(key) &&
                              n_in_all == Utilities::pow(degree + 1, dim));
            }
          const auto anywhere = [](const bool found) {
            return Utilities::MPI::max(found ? 1 : 0, MPI_COMM_WORLD) > 0;
          };
          deallog << dim << "-D, degree " << degree << ", level " << level
                  << ": missed " << (anywhere(missed) ? "FAILED" : "none")
                  << ", superfluous "
                  << (anywhere(superfluous) ? "FAILED" : "none") << std::endl;
        }
      triangulation.coarsen_global(1);
    }
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();
  test<2>(10);
  test<3>(6);
}
