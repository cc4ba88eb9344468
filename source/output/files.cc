// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/files.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace EBSMPM
{
  std::string
  first_message(const std::string &message, const MPI_Comm communicator)
  {
    const unsigned int has_message = message.empty() ? 0 : 1;
    if (Utilities::MPI::max(has_message, communicator) == 0)
      return "";

    const std::vector<std::string> messages =
      Utilities::MPI::all_gather(communicator, message);
    for (const std::string &m : messages)
      if (!m.empty())
        return m;

    Assert(false, ExcInternalError());
    return "";
  }



  void
  make_directory(const std::string &directory, const MPI_Comm communicator)
  {
    std::string problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::error_code error;
        std::filesystem::create_directories(directory, error);
        if (error)
          problem = "cannot be created as a folder: " + error.message();
        else if (!std::filesystem::is_directory(directory, error))
          problem = "is not a folder";
      }

    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(directory, problem));
  }
} // namespace EBSMPM
