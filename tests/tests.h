// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_tests_h
#define ebsmpm_tests_h

// What all tests include, as their last header. A test writes the facts it has
// found to deallog, which goes to the file "output"; the harness compares that
// file with the stored one, numbers up to a relative difference of 1e-8 and an
// absolute one of 1e-6. It follows that a test prints an error of 1e-12 not as
// it is but as the answer to the question whether it is small enough.

#include <ebsmpm/base/config.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/logstream.h>
#include <deal.II/base/mpi.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

using namespace dealii;
using namespace EBSMPM;

std::ofstream deallogfile;



/**
 * Send what is written to deallog to the file "output", and nothing of it to
 * the screen. For tests that run on one process.
 */
inline void
initlog(const std::string &file_name = "output")
{
  deallogfile.open(file_name);
  // No job identification, which would differ from run to run: "output" can be
  // stored as it is.
  deallog.attach(deallogfile, false, std::ios::showpoint | std::ios::left);
  deallog.depth_console(0);
}



/**
 * The same for tests that run on several processes, of which only the first has
 * something to say; what the others write to deallog is forgotten. It must be
 * called after MPI has been initialised.
 */
inline void
mpi_initlog()
{
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    initlog();
  else
    deallog.depth_console(0);
}



/**
 * The same for tests in which all processes have something to say: each has a
 * log of its own, where every line starts with the rank, and at the end of the
 * life of the object they are joined in "output" in the order of the ranks.
 */
class MPILogInitAll
{
public:
  MPILogInitAll()
    : rank(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD))
  {
    initlog(file_name(rank));
    deallog.push(std::to_string(rank));
  }

  ~MPILogInitAll()
  {
    deallog.pop();
    deallog.detach();
    deallogfile.close();

    MPI_Barrier(MPI_COMM_WORLD);
    if (rank == 0)
      {
        std::ofstream all(file_name(0), std::ios::app);
        for (unsigned int r = 1;
             r < Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
             ++r)
          {
            all << '\n' << std::ifstream(file_name(r)).rdbuf();
            std::remove(file_name(r).c_str());
          }
      }
    MPI_Barrier(MPI_COMM_WORLD);
  }

private:
  static std::string
  file_name(const unsigned int rank)
  {
    return rank == 0 ? "output" : "output" + std::to_string(rank);
  }

  const unsigned int rank;
};

#endif
