// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of Simulation that writes checkpoints, and continues from one.

#include <ebsmpm/base/exceptions.h>
#include <ebsmpm/base/parameter_values.h>
#include <ebsmpm/base/text.h>

#include <ebsmpm/solvers/simulation.h>

#include <ebsmpm/output/archive.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/utilities.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace EBSMPM
{
  namespace
  {
    using Increments = std::vector<std::pair<double, double>>;

    /** To be increased when checkpoints of before cannot be read any more. */
    constexpr unsigned int format_version = 2;

    /** Part of a load within which two of them are the same. */
    constexpr double load_tolerance = 1e-10;



    /** The names of the files of a checkpoint. */
    std::string
    grid_file(const std::string &folder)
    {
      return folder + "/grid";
    }



    std::string
    run_file(const std::string &folder)
    {
      return folder + "/run";
    }



    std::string
    memory_file(const std::string &folder, const unsigned int rank)
    {
      return folder + "/memory." + Utilities::int_to_string(rank, 4);
    }



    /**
     * Whether a run may be continued with another value of a parameter: one
     * that says how something is computed, not what.
     */
    bool
    may_differ(const std::string &name)
    {
      for (const std::string section : {"Output/",
                                        "Checkpoint/",
                                        "Staggered/",
                                        "Newton/",
                                        "Linear solver/"})
        if (name.substr(0, section.size()) == section)
          return true;
      for (const std::string parameter : {"Background grid/Balance",
                                          "Background grid/Largest imbalance",
                                          "Loading/Minimum increment",
                                          "Loading/Easy passes",
                                          "Loading/Stop below",
                                          // See require_same_increments().
                                          "Loading/Increments"})
        if (name == parameter)
          return true;
      return false;
    }



    /** The part of a table of increments up to a load. */
    Increments
    up_to(const double load, const Increments &table)
    {
      Increments result;
      double     begin = 0.;
      for (const auto &[end, increment] : table)
        {
          if (begin < (1. - load_tolerance) * load)
            result.emplace_back(std::min(end, load), increment);
          begin = end;
        }
      return result;
    }



    bool
    are_same(const Increments &a, const Increments &b)
    {
      const auto is_close = [](const double x, const double y) {
        return std::abs(x - y) <= load_tolerance * std::abs(y);
      };
      return std::equal(a.begin(),
                        a.end(),
                        b.begin(),
                        b.end(),
                        [&](const auto &x, const auto &y) {
                          return is_close(x.first, y.first) &&
                                 is_close(x.second, y.second);
                        });
    }



    /** Raise ExcParameter if the increments up to a load are others. */
    void
    require_same_increments(const Increments  &table,
                            const Increments  &former_table,
                            const double       load,
                            const std::string &text,
                            const std::string &former_text)
    {
      std::ostringstream allowed;
      allowed << Text::quote(former_text) << " up to the load " << load
              << " of the checkpoint";
      AssertThrow(are_same(up_to(load, table), up_to(load, former_table)),
                  ExcParameter("Loading/Increments", text, allowed.str()));
    }
  } // namespace



  /** What a checkpoint says once, for all processes. */
  template <int dim>
  struct Simulation<dim>::Header
  {
    unsigned int    version     = format_version;
    unsigned int    n_processes = 1;
    Progress        progress;
    ParameterValues values;
    std::string     increments_text;
    Increments      increments;
    bool            has_point_series = false;
    bool            has_grid_series  = false;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &version &n_processes &progress &values &increments_text
        &increments &has_point_series &has_grid_series;
    }
  };



  template <int dim>
  void
  Simulation<dim>::write_checkpoint()
  {
    TimerOutput::Scope scope(timer, "checkpoint");
    const unsigned int rank   = Utilities::MPI::this_mpi_process(communicator);
    const std::string  folder = checkpoints.begin();

    // The order of the two sets is that of read_checkpoint().
    points.prepare_for_serialization();
    boundary_points.prepare_for_serialization();
    triangulation.save(grid_file(folder));

    const auto  memory   = step->memory();
    std::string filename = memory_file(folder, rank);
    std::string problem  = Archive::write(filename, memory);
    if (rank == 0 && problem.empty())
      {
        Header header;
        header.n_processes = Utilities::MPI::n_mpi_processes(communicator);
        header.progress    = progress;
        header.progress.wall_time += wall_clock.wall_time();
        header.values           = parameter_values(ParameterAcceptor::prm);
        header.increments_text  = parameters.loading.increments;
        header.increments       = parameters.increments();
        header.has_point_series = !point_series->get_records().empty();
        header.has_grid_series  = !grid_series->get_records().empty();
        filename                = run_file(folder);
        problem                 = Archive::write(filename, header);
      }
    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(filename, problem));
    checkpoints.finish(progress.step);

    // Go on as the run does that is continued from here.
    if (parameters.grid.balance)
      distribute_by_points();
    step->recall(memory);
    last_imbalance = imbalance();
  }



  template <int dim>
  void
  Simulation<dim>::read_checkpoint()
  {
    const unsigned int last_step = checkpoints.last_step();
    AssertThrow(last_step != numbers::invalid_unsigned_int,
                ExcInput(
                  "There is no checkpoint in the folder '" +
                  parameters.output.directory +
                  "' to resume from; set 'Checkpoint/Resume' to false to "
                  "start from the beginning."));
    const std::string folder = checkpoints.folder(last_step);

    Header header;
    read_header(folder, header);
    progress         = header.progress;
    had_point_series = header.has_point_series;
    had_grid_series  = header.has_grid_series;

    make_coarse_grid();
    triangulation.load(grid_file(folder));
    points.deserialize();
    boundary_points.deserialize();
    if (parameters.grid.balance)
      distribute_by_points();
    make_step();
    step->recall(read_memory(folder, header.n_processes));
  }



  template <int dim>
  void
  Simulation<dim>::read_header(const std::string &folder, Header &header) const
  {
    const std::string filename = run_file(folder);
    std::string       problem  = Archive::read(filename, header);
    if (problem.empty() && header.version != format_version)
      problem = "is of another version of this program";
    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(filename, problem));

    require_same_parameters(parameter_values(ParameterAcceptor::prm),
                            header.values,
                            may_differ,
                            "as in the run that is to be continued");
    require_same_increments(parameters.increments(),
                            header.increments,
                            header.progress.load,
                            parameters.loading.increments,
                            header.increments_text);
  }



  template <int dim>
  typename StaggeredStep<dim>::Memory
  Simulation<dim>::read_memory(const std::string &folder,
                               const unsigned int n_files) const
  {
    // There may have been more processes than now, or fewer.
    typename StaggeredStep<dim>::Memory memory;
    std::string                         problem;
    for (unsigned int file = Utilities::MPI::this_mpi_process(communicator);
         file < n_files && problem.empty();
         file += Utilities::MPI::n_mpi_processes(communicator))
      {
        typename StaggeredStep<dim>::Memory part;
        problem = Archive::read(memory_file(folder, file), part);
        memory.append(part);
      }
    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(folder, problem));
    return memory;
  }



  template void
  Simulation<2>::write_checkpoint();
  template void
  Simulation<2>::read_checkpoint();

  template void
  Simulation<3>::write_checkpoint();
  template void
  Simulation<3>::read_checkpoint();
} // namespace EBSMPM
