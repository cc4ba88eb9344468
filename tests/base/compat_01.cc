// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The functions that hide the differences between deal.II's versions do what
// they say, and the version of the library can be asked for.

#include <ebsmpm/base/compat.h>

#include <deal.II/distributed/tria.h>

#include "../tests.h"



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPILogInitAll                    log;

  const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int size = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);

  static_assert(EBSMPM_VERSION_GTE(0, 1, 0), "The version went down.");
  static_assert(!EBSMPM_VERSION_GTE(1000, 0, 0), "The version is wrong.");

  parallel::distributed::Triangulation<2> triangulation(MPI_COMM_WORLD);
  deallog << "processes: "
          << Utilities::MPI::n_mpi_processes(
               get_mpi_communicator(triangulation))
          << std::endl;

  // Each process owns three indices and also needs the first one of the next,
  // on which its last own one depends.
  IndexSet owned(3 * size);
  owned.add_range(3 * rank, 3 * rank + 3);
  const types::global_dof_index last = 3 * rank + 2;
  const types::global_dof_index next = (3 * rank + 3) % (3 * size);
  IndexSet                      relevant(owned);
  relevant.add_index(next);

  AffineConstraints<double> constraints;
  for (unsigned int repetition = 0; repetition < 2; ++repetition)
    {
      reinit_constraints(constraints, owned, relevant);
      deallog << "lines before: " << constraints.n_constraints() << std::endl;
      constraints.add_line(last);
      constraints.add_entry(last, next, 0.5);
      constraints.close();
    }
  deallog << "lines after: " << constraints.n_constraints() << ", index "
          << last << " = 0.5 * "
          << (*constraints.get_constraint_entries(last))[0].first << std::endl;
  deallog << "lines only for relevant indices: "
          << (constraints.get_local_lines() == relevant ? "yes" : "no")
          << std::endl;
}
