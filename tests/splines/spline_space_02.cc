// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The hysteresis of SplineSpace::reinit(): a function that was standard remains
// so while its fraction sinks a little below the threshold, also if only other
// processes see it now; nothing is numbered anew as long as classes stay the
// same; and a change of sides only keeps the numbers. Another space that is
// told which functions were standard goes on in the same way.

#include <ebsmpm/splines/spline_space.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include "../tests.h"

using Space = SplineSpace<2>;



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const unsigned int rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);

  parallel::distributed::Triangulation<2> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 4);
  Space space(triangulation, 2);

  // Three functions: one that stays, and is always seen by all; one that sinks,
  // seen by one process only, in turn; and one with a side.
  const Space::Key stays = space.cell_function({{0, 0}}, 0, 0);
  const Space::Key sinks = space.cell_function({{0, 0}}, 0, 1);
  const Space::Key sided = space.cell_function({{0, 0}}, 0, 2);

  unsigned int turn = 0;
  const auto   reinit_space =
    [&](Space &space, const double fraction, const double side) {
      Space::SupportTable supports;
      supports[stays].fraction = 1. / n_ranks;
      if (rank == turn++ % n_ranks)
        supports[sinks].fraction = fraction;
      supports[sided].fraction = 0.05 / n_ranks;
      supports[sided].side     = {{0., side}};
      const bool changed       = space.reinit(supports, 0.1, 0.2);
      deallog << "fraction " << fraction << ", side " << side << ": "
              << space.n_independent() << " independent"
              << (n_ranks > 1 ? "" :
                  changed     ? ", changed" :
                                ", not changed")
              << std::endl;
    };
  const auto reinit = [&](const double fraction, const double side) {
    reinit_space(space, fraction, side);
  };
  reinit(0.12, 1.);
  reinit(0.09, 1.);
  reinit(0.085, 1.);
  reinit(0.085, -1.);
  reinit(0.075, -1.);
  reinit(0.09, -1.);
  reinit(0.12, -1.);
  const auto *found = space.find(sided);
  deallog << "side: " << found->side[1]
          << ", of the owner: " << space.query({sided}).at(sided).side[1]
          << std::endl;

  // Each key may come from any process: here, all from the last one.
  const auto              own = space.standard_functions();
  std::vector<Space::Key> keys;
  for (const auto &key : {stays, sinks})
    if (rank + 1 == n_ranks)
      keys.push_back(key);
  deallog << Utilities::MPI::sum<unsigned int>(own.size(), MPI_COMM_WORLD)
          << " standard functions" << std::endl;
  Space fresh(triangulation, 2), other(triangulation, 2);
  reinit_space(fresh, 0.09, -1.);
  other.recall(keys);
  reinit_space(other, 0.09, -1.);
  reinit_space(other, 0.085, -1.);
  space.recall(own);
  reinit(0.09, -1.);
  reinit(0.075, -1.);
}
