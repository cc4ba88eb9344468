// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_files_h
#define ebsmpm_output_files_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace EBSMPM
{
  /**
   * Whether a writer may replace the results of an earlier run.
   */
  enum class Overwrite
  {
    /**
     * Throw ExcFile if there is a file already.
     */
    no,

    /**
     * Replace it.
     */
    yes
  };

  /**
   * Return the message of the lowest rank that has one, on all ranks; an empty
   * string if no rank has one. Collective.
   *
   * A file is written by one rank and a NaN is met by one rank, but an
   * exception has to be thrown by all of them: the others would wait for ever
   * in their next communication.
   *
   * @code
   * std::string problem;
   * if (Utilities::MPI::this_mpi_process(communicator) == 0)
   *   problem = try_to_write();
   * problem = first_message(problem, communicator);
   * AssertThrow(problem.empty(), ExcFile(name, problem));
   * @endcode
   *
   * Costs one reduction of an integer when there is nothing to say.
   */
  std::string
  first_message(const std::string &message, const MPI_Comm communicator);

  /**
   * Make sure that @p directory exists, creating it and its parents if
   * necessary. Throws ExcFile on all ranks if that is not possible. Collective.
   */
  void
  make_directory(const std::string &directory, const MPI_Comm communicator);
} // namespace EBSMPM

#endif
