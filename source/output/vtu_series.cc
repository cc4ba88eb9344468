// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/vtu_series.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace EBSMPM
{
  namespace
  {
    const std::string cannot_write =
      "cannot be written (does its folder exist, and is the disk full?)";



    std::string
    write_text(const std::string &filename, const std::string &text)
    {
      std::ofstream file(filename);
      file << text << std::flush;
      return file ? "" : cannot_write;
    }



    /**
     * Return the value of an attribute of an XML element, an empty string if it
     * has none.
     */
    std::string
    attribute(const std::string &element, const std::string &key)
    {
      const std::size_t start = element.find(' ' + key + "=\"");
      if (start == std::string::npos)
        return "";
      const std::size_t first = start + key.size() + 3;
      return element.substr(first, element.find('"', first) - first);
    }
  } // namespace



  VTUSeries::VTUSeries(const std::string &directory,
                       const std::string &name,
                       const MPI_Comm     communicator)
    : directory(directory)
    , name(name)
    , communicator(communicator)
  {}



  VTUSeries::VTUSeries(const std::string &directory,
                       const std::string &name,
                       const MPI_Comm     communicator,
                       const Overwrite    overwrite)
    : VTUSeries(directory, name, communicator)
  {
    const std::string filename = path(name + ".pvd");
    std::string       problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::error_code error;
        if (std::filesystem::exists(filename, error))
          {
            if (overwrite == Overwrite::no)
              problem = "exists already: choose another folder, or allow to "
                        "overwrite it";
            else if (!std::filesystem::remove(filename, error))
              problem = "cannot be removed: " + error.message();
          }
      }

    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(filename, problem));
  }



  VTUSeries
  VTUSeries::resume(const std::string &directory,
                    const std::string &name,
                    const MPI_Comm     communicator,
                    const unsigned int last_step)
  {
    VTUSeries   series(directory, name, communicator);
    std::string problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      problem = series.read_records(last_step);

    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(series.path(name + ".pvd"), problem));
    return series;
  }



  template <int dim, int spacedim>
  void
  VTUSeries::write(Patches<dim, spacedim> &patches,
                   const unsigned int      step,
                   const double            time)
  {
    AssertThrow(std::isfinite(time),
                ExcSolverFailure("The time of step " + std::to_string(step) +
                                 " of '" + name + "' is not finite."));

    // No date in the pieces: the same run writes the same ones. The best
    // compression halves the files, but takes eight times as long. (decltype,
    // because the type has moved between versions of deal.II.)
    DataOutBase::VtkFlags flags;
    flags.time                = time;
    flags.cycle               = step;
    flags.print_date_and_time = false;
    flags.compression_level   = decltype(flags.compression_level)::best_speed;
    patches.set_flags(flags);

    const std::string base  = name + '_' + Utilities::int_to_string(step, 5);
    const auto        piece = [&base](const unsigned int rank) {
      return base + '.' + Utilities::int_to_string(rank, 4) + ".vtu";
    };

    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const std::vector<unsigned int> n_patches =
      Utilities::MPI::all_gather(communicator, patches.n_patches());

    std::string problem;
    if (n_patches[rank] > 0)
      {
        std::ofstream file(path(piece(rank)));
        try
          {
            if (file)
              patches.write_vtu(file);
          }
        catch (const ExceptionBase &)
          {
            // deal.II throws on this rank alone when it meets a bad stream. The
            // stream stays bad, and the others learn of it below.
          }
        file.flush();
        if (!file)
          problem = cannot_write;
      }
    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(path(base + ".*.vtu"), problem));

    // Only now list the pieces: who opens the list must find them all.
    if (rank == 0)
      {
        std::vector<std::string> pieces;
        for (unsigned int r = 0; r < n_patches.size(); ++r)
          if (n_patches[r] > 0)
            pieces.push_back(piece(r));

        std::ostringstream text;
        patches.write_pvtu_record(text, pieces);
        problem = write_text(path(base + ".pvtu"), text.str());
        if (problem.empty())
          {
            records.emplace_back(time, base + ".pvtu");
            problem = write_records();
          }
      }
    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(path(base + ".pvtu"), problem));
  }



  MPI_Comm
  VTUSeries::get_communicator() const
  {
    return communicator;
  }



  const std::vector<std::pair<double, std::string>> &
  VTUSeries::get_records() const
  {
    return records;
  }



  std::string
  VTUSeries::path(const std::string &file) const
  {
    return (std::filesystem::path(directory) / file).string();
  }



  std::string
  VTUSeries::write_records() const
  {
    std::ostringstream text;
    text.precision(12);
    DataOutBase::write_pvd_record(text, records);

    // Replace the file at once: a graphics program may be reading it.
    const std::string temporary = path(name + ".pvd.new");
    const std::string problem   = write_text(temporary, text.str());
    if (!problem.empty())
      return problem;

    std::error_code error;
    std::filesystem::rename(temporary, path(name + ".pvd"), error);
    return error ? "cannot be listed in the PVD file: " + error.message() : "";
  }



  std::string
  VTUSeries::read_records(const unsigned int last_step)
  {
    std::ifstream file(path(name + ".pvd"));
    if (!file)
      return "cannot be opened";

    for (std::string line; std::getline(file, line);)
      if (line.find("<DataSet") != std::string::npos)
        {
          // The step is between the underscore and the point, NAME_STEP.pvtu.
          const std::string  filename = attribute(line, "file");
          const std::size_t  start    = name.size() + 1;
          const unsigned int step =
            (filename.size() > start) ? std::atoi(filename.c_str() + start) : 0;
          if (step <= last_step)
            records.emplace_back(std::atof(attribute(line, "timestep").c_str()),
                                 filename);
        }

    return write_records();
  }



  template void
  VTUSeries::write(Patches<0, 2> &, const unsigned int, const double);
  template void
  VTUSeries::write(Patches<0, 3> &, const unsigned int, const double);
  template void
  VTUSeries::write(Patches<2, 2> &, const unsigned int, const double);
  template void
  VTUSeries::write(Patches<3, 3> &, const unsigned int, const double);
} // namespace EBSMPM
