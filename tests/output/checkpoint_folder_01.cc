// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------
// The folder of the checkpoints: there is a whole one from the first on,
// whatever happens while the next is written.

#include <ebsmpm/base/command_line.h>
#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/archive.h>
#include <ebsmpm/output/checkpoint_folder.h>
#include <ebsmpm/output/files.h>

#include <deal.II/base/utilities.h>

#include <boost/serialization/vector.hpp>

#include <filesystem>

#include "../tests.h"

const std::string directory = "checkpoint_folder_01";



std::string
my_file(const std::string &folder)
{
  return folder + "/data." +
         std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
}



void
write(CheckpointFolder &checkpoints, const double value)
{
  const std::string         folder  = checkpoints.begin();
  const std::vector<double> data    = {value, 1. / 3.};
  const std::string         problem = Archive::write(my_file(folder), data);
  deallog << "written: " << (problem.empty() ? "yes" : problem) << std::endl;
}



void
print(const CheckpointFolder &checkpoints)
{
  const unsigned int step = checkpoints.last_step();
  if (step == numbers::invalid_unsigned_int)
    {
      deallog << "no checkpoint" << std::endl;
      return;
    }
  std::vector<double> data;
  const std::string   problem =
    Archive::read(my_file(checkpoints.folder(step)), data);
  deallog << "step " << step << ": "
          << (problem.empty() ? std::to_string(data[0]) : problem)
          << (data.size() == 2 && data[1] == 1. / 3. ? ", all digits" : "")
          << std::endl;
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPILogInitAll                    log;
  const bool is_first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

  CheckpointFolder checkpoints(directory, MPI_COMM_WORLD);
  checkpoints.clear();
  print(checkpoints);

  write(checkpoints, 3.);
  print(checkpoints);
  checkpoints.finish(3);
  print(checkpoints);

  // Killed while writing, then again from there.
  write(checkpoints, 9.);
  print(checkpoints);
  write(checkpoints, 10.);
  checkpoints.finish(10);
  print(checkpoints);
  MPI_Barrier(MPI_COMM_WORLD);
  deallog << "step 3 is "
          << (std::filesystem::exists(checkpoints.folder(3)) ? "there" : "gone")
          << std::endl;

  // Names that only look like those of checkpoints.
  MPI_Barrier(MPI_COMM_WORLD);
  if (is_first)
    for (const auto &name : {"step_", "step_x", "step_00099.old", "99"})
      std::filesystem::create_directory(directory + "/" + name);
  MPI_Barrier(MPI_COMM_WORLD);
  print(checkpoints);

  // Not twice.
  write(checkpoints, 11.);
  try
    {
      checkpoints.finish(10);
      deallog << "NOT refused" << std::endl;
    }
  catch (const ExceptionBase &exception)
    {
      const std::string text = describe_exception(exception);
      deallog << text.substr(0, text.find(':')) << std::endl;
    }
  print(checkpoints);

  // Files that are none.
  if (is_first)
    std::ofstream(directory + "/nonsense") << "nonsense";
  MPI_Barrier(MPI_COMM_WORLD);
  std::vector<double> data;
  deallog << "nonsense " << Archive::read(directory + "/nonsense", data)
          << "\nnothing " << Archive::read(directory + "/nothing", data)
          << "\nnowhere " << Archive::write(directory + "/no/where", data)
          << std::endl;

  checkpoints.clear();
  print(checkpoints);
}
