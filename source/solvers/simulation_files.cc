// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of Simulation that opens the files of a run and begins the log.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/solvers/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <sstream>

namespace EBSMPM
{
  namespace
  {
    void
    echo_parameters(const std::string &directory)
    {
      std::ofstream echo(directory + "/parameters.prm");
      ParameterAcceptor::prm.print_parameters(echo, ParameterHandler::PRM);
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  Simulation<dim>::history_columns() const
  {
    std::vector<std::string> columns;
    const std::string        components = "xyz";
    for (const auto &name : parameters.boundary_names())
      for (unsigned int d = 0; d < dim; ++d)
        columns.push_back("force_" + name + "_" + components[d]);
    for (const auto &name : {"elastic_energy",
                             "fracture_energy",
                             "penalty_energy",
                             "crack_length",
                             "passes",
                             "newton_iterations",
                             "linear_iterations",
                             "factorisations",
                             "bisections",
                             "damage_change",
                             "residual",
                             "independent_functions",
                             "deficient_functions",
                             "twin_functions",
                             "largest_extension_weight",
                             "pieces",
                             "free_pieces",
                             "smallest_opening",
                             "conjugate_force",
                             "opened_volume",
                             "wall_time"})
      columns.push_back(name);
    return columns;
  }



  template <int dim>
  void
  Simulation<dim>::open_files()
  {
    const std::string &directory = parameters.output.directory;
    AssertThrow(
      overwrite == Overwrite::yes ||
        checkpoints.last_step() == numbers::invalid_unsigned_int,
      ExcFile(directory,
              "contains a checkpoint: resume that run, choose another "
              "folder, or allow to overwrite it"));
    make_directory(directory, communicator);
    history = std::make_unique<HistoryWriter>(directory + "/history.csv",
                                              history_columns(),
                                              communicator,
                                              overwrite);
    point_series =
      std::make_unique<VTUSeries>(directory, "points", communicator, overwrite);
    grid_series =
      std::make_unique<VTUSeries>(directory, "grid", communicator, overwrite);
    checkpoints.clear();
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        log_file.open(directory + "/log.txt");
        echo_parameters(directory);
      }
  }



  template <int dim>
  void
  Simulation<dim>::reopen_files()
  {
    const std::string &directory = parameters.output.directory;
    history                      = std::make_unique<HistoryWriter>(
      HistoryWriter::resume(directory + "/history.csv",
                            history_columns(),
                            communicator,
                            progress.step));

    // A series begins with its first fields. What an earlier run has written
    // after the checkpoint only is written again.
    const auto reopen = [&](const std::string &name, const bool exists) {
      return std::make_unique<VTUSeries>(
        exists ?
          VTUSeries::resume(directory, name, communicator, progress.step) :
          VTUSeries(directory, name, communicator, Overwrite::yes));
    };
    point_series = reopen("points", had_point_series);
    grid_series  = reopen("grid", had_grid_series);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        log_file.open(directory + "/log.txt", std::ios::app);
        echo_parameters(directory);
      }
  }



  template <int dim>
  void
  Simulation<dim>::write_header()
  {
    std::ostringstream text;
    text << "ebsmpm " << EBSMPM_VERSION << ", "
         << Utilities::MPI::n_mpi_processes(communicator) << " process(es), "
         << dim << "d\n"
         << "  grid:            " << triangulation.n_global_active_cells()
         << " cells of size " << parameters.cell_size() << ", degree "
         << parameters.grid.degree << '\n'
         << "  material points: " << points.n_global() << '\n'
         << "  boundary points: " << boundary_points.n_global() << '\n'
         << "  functions:       "
         << "see history.csv\n"
         << "  Nitsche penalty: " << penalty << " = "
         << penalty * parameters.cell_size() / material->nitsche_stiffness()
         << " (K+4G/3)/h\n"
         << "  results in:      " << parameters.output.directory << '\n';
    if (progress.step > 0)
      text << "  resumed:         after step " << progress.step << ", load "
           << progress.load << '\n';
    print(text.str());
  }



  template <int dim>
  void
  Simulation<dim>::print(const std::string &text)
  {
    pcout << text << std::flush;
    if (log_file)
      log_file << text << std::flush;
  }



  template std::vector<std::string>
  Simulation<2>::history_columns() const;
  template void
  Simulation<2>::open_files();
  template void
  Simulation<2>::reopen_files();
  template void
  Simulation<2>::write_header();
  template void
  Simulation<2>::print(const std::string &);

  template std::vector<std::string>
  Simulation<3>::history_columns() const;
  template void
  Simulation<3>::open_files();
  template void
  Simulation<3>::reopen_files();
  template void
  Simulation<3>::write_header();
  template void
  Simulation<3>::print(const std::string &);
} // namespace EBSMPM
