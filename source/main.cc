// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The program ebsmpm: run a parameter file without writing code.

#include <ebsmpm/base/command_line.h>

#include <ebsmpm/solvers/parameters.h>
#include <ebsmpm/solvers/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <cstdlib>
#include <exception>
#include <iostream>

namespace
{
  using namespace EBSMPM;

  template <int dim>
  void
  run(const Parameters &parameters, const Overwrite overwrite)
  {
    // The timers of a simulation want to communicate when they go away, which
    // they had better not do while an exception is on its way.
    std::exception_ptr failure;
    {
      Simulation<dim> simulation(parameters,
                                 MPI_COMM_WORLD,
                                 overwrite,
                                 &std::cout);
      try
        {
          simulation.run();
        }
      catch (...)
        {
          failure = std::current_exception();
        }
    }
    if (failure)
      std::rethrow_exception(failure);
  }



  void
  run(const CommandLine &command_line)
  {
    Parameters        parameters;
    ParameterHandler &prm = ParameterAcceptor::prm;
    ParameterAcceptor::declare_all_parameters(prm);

    if (command_line.action == CommandLine::Action::print_parameters)
      {
        apply_settings(prm, command_line.settings);
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          prm.print_parameters(std::cout, command_line.style);
        return;
      }

    read_parameters(prm, command_line.file);
    apply_settings(prm, command_line.settings);
    ParameterAcceptor::parse_all_parameters(prm);
    parameters.check();

    const Overwrite overwrite =
      command_line.force ? Overwrite::yes : Overwrite::no;
    if (parameters.grid.dimension == 2)
      run<2>(parameters, overwrite);
    else
      run<3>(parameters, overwrite);
  }
} // namespace



int
main(int argc, char *argv[])
{
  // Two processes with several BLAS threads each would fight for the cores.
  // BLAS reads this when it is loaded, so it is of use only for what is loaded
  // later; the scripts in contrib/ set it in advance.
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  setenv("OMP_NUM_THREADS", "1", 0);

  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool is_first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  try
    {
      const CommandLine command_line(argc, argv);
      if (command_line.action == CommandLine::Action::help)
        {
          if (is_first)
            std::cout << CommandLine::usage();
        }
      else if (command_line.action == CommandLine::Action::version)
        {
          if (is_first)
            std::cout << "ebsmpm " << EBSMPM_VERSION << " with deal.II "
                      << DEAL_II_PACKAGE_VERSION << std::endl;
        }
      else
        run(command_line);
    }
  catch (const std::exception &exception)
    {
      if (is_first)
        {
          std::cerr << "ebsmpm: ";
          format_exception(exception, std::cerr);
        }
      return EXIT_FAILURE;
    }
  return EXIT_SUCCESS;
}
