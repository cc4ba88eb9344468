// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/checkpoint_folder.h>
#include <ebsmpm/output/files.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace EBSMPM
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string prefix = "step_";



    /** Return the steps of all checkpoints that are complete. */
    std::vector<unsigned int>
    complete_steps(const std::string &directory)
    {
      std::vector<unsigned int> steps;
      std::error_code           error;
      for (fs::directory_iterator entry(directory, error), end;
           !error && entry != end;
           entry.increment(error))
        {
          const std::string name   = entry->path().filename().string();
          const std::string number = name.substr(0, prefix.size()) == prefix ?
                                       name.substr(prefix.size()) :
                                       "";
          if (!number.empty() && number.size() < 10 &&
              std::all_of(number.begin(), number.end(), [](const char c) {
                return c >= '0' && c <= '9';
              }))
            steps.push_back(std::stoul(number));
        }
      return steps;
    }



    /** Throw ExcFile if @p error of the first process is one. */
    void
    check(const std::error_code &error,
          const std::string     &name,
          const std::string     &what,
          const MPI_Comm         communicator)
    {
      const std::string problem =
        first_message(error ? what + ": " + error.message() : "", communicator);
      AssertThrow(problem.empty(), ExcFile(name, problem));
    }
  } // namespace



  CheckpointFolder::CheckpointFolder(const std::string &directory,
                                     const MPI_Comm     communicator)
    : directory(directory)
    , communicator(communicator)
  {}



  unsigned int
  CheckpointFolder::last_step() const
  {
    // The file system may show other processes something else.
    unsigned int step_plus_one = 0;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      for (const unsigned int step : complete_steps(directory))
        step_plus_one = std::max(step_plus_one, step + 1);
    step_plus_one = Utilities::MPI::max(step_plus_one, communicator);
    return step_plus_one > 0 ? step_plus_one - 1 :
                               numbers::invalid_unsigned_int;
  }



  std::string
  CheckpointFolder::folder(const unsigned int step) const
  {
    return (fs::path(directory) / (prefix + Utilities::int_to_string(step, 5)))
      .string();
  }



  std::string
  CheckpointFolder::begin() const
  {
    const std::string name = (fs::path(directory) / "new").string();
    std::error_code   error;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      fs::remove_all(name, error);
    check(error, name, "cannot be removed", communicator);
    make_directory(name, communicator);
    return name;
  }



  void
  CheckpointFolder::finish(const unsigned int step) const
  {
    const std::string new_name = (fs::path(directory) / "new").string();
    std::error_code   error;

    // Nobody is still writing.
    first_message("", communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      fs::rename(new_name, folder(step), error);
    check(error, new_name, "cannot be renamed", communicator);

    std::string name = directory;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      for (const unsigned int other : complete_steps(directory))
        if (other != step && !error)
          {
            name = folder(other);
            fs::remove_all(name, error);
          }
    check(error, name, "cannot be removed", communicator);
  }



  void
  CheckpointFolder::clear() const
  {
    std::error_code error;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      fs::remove_all(directory, error);
    check(error, directory, "cannot be removed", communicator);
  }
} // namespace EBSMPM
