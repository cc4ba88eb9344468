// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The table of a run: what is written comes back, an interrupted run can be
// continued, and what must not be written is refused on all ranks.

#include <ebsmpm/base/command_line.h>
#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/history.h>
#include <ebsmpm/output/history_table.h>

#include <cmath>
#include <functional>
#include <limits>

#include "../tests.h"

const std::string filename = "history_01.csv";



// The file is rank 0's; the others must not look before it has written.
void
print(const std::string &name = filename)
{
  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      std::ifstream file(name);
      for (std::string line; std::getline(file, line);)
        deallog << line << (file.eof() ? " (no end of line)" : "") << std::endl;
    }
  MPI_Barrier(MPI_COMM_WORLD);
}



void
write_file(const std::string &text)
{
  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::ofstream(filename) << text;
  MPI_Barrier(MPI_COMM_WORLD);
}



void
expect_failure(const std::function<void()> &function)
{
  MPI_Barrier(MPI_COMM_WORLD);
  try
    {
      function();
      deallog << "NOT refused" << std::endl;
    }
  catch (const ExceptionBase &exception)
    {
      deallog << describe_exception(exception) << std::endl;
    }
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPILogInitAll                    log;

  const std::vector<std::string> columns = {"elastic energy", "crack length"};
  const auto                     create  = [&](const Overwrite overwrite) {
    return HistoryWriter(filename, columns, MPI_COMM_WORLD, overwrite);
  };
  const auto resume = [&](const unsigned int step) {
    return HistoryWriter::resume(filename, columns, MPI_COMM_WORLD, step);
  };

  // Only the numbers of rank 0 count: give the others rubbish.
  const double rubbish = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ?
                           1. :
                           std::numeric_limits<double>::quiet_NaN();

  deallog << "-- write" << std::endl;
  {
    HistoryWriter history = create(Overwrite::yes);
    history.write(0, 0., 0., {0., 0.});
    history.write(1, 1e-3 * rubbish, 1. / 3., {-1e-17, 0.5});
    // Flushed line by line: the file is complete while the run goes on.
    print();
    history.write(2, 2e-3, 2. / 3., {1e300, 1.});

    deallog << "-- not finite" << std::endl;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    expect_failure([&]() { history.write(3, 3e-3, 1., {nan, 1.}); });
    expect_failure([&]() { history.write(3, inf, 1., {nan, 1.}); });
    expect_failure([&]() { history.write(3, 3e-3, -inf, {0., 1.}); });

    // The table goes on.
    history.write(3, 3e-3, 1., {0., 1.});
  }
  print();

  deallog << "-- read" << std::endl;
  {
    const HistoryTable table = HistoryTable::read(filename);
    deallog << table.names.size() << " columns, " << table.rows.size()
            << " lines" << std::endl;
    for (const double force : table.column("force"))
      deallog << force << ' ';
    deallog << std::endl;
    deallog << "twelve digits: "
            << (std::abs(table.column("force")[1] - 1. / 3.) < 1e-12)
            << std::endl;
    expect_failure([&]() { table.column("Force"); });
  }

  deallog << "-- continue" << std::endl;
  {
    HistoryWriter history = resume(1);
    history.write(2, 2.5e-3, 1.5, {3., 4.});
  }
  print();

  // A run that was killed while writing.
  write_file("step,displacement,force,elastic energy,crack length\n"
             "1,1,1,1,1\n"
             "2,2,2,2,2\n"
             "3,3,3,");
  {
    HistoryWriter history = resume(2);
    history.write(3, 0.25, 1.5, {3., 4.});
  }
  print();

  deallog << "-- refused" << std::endl;
  expect_failure([&]() { create(Overwrite::no); });
  expect_failure([&]() { resume(7); });
  write_file("step,displacement,force,elastic energy\n");
  expect_failure([&]() { resume(0); });
  write_file("step,displacement,force,elastic energy,crack length\n"
             "1,1,1,1\n");
  expect_failure([&]() { resume(1); });
  write_file("step,displacement,force,elastic energy,crack length\n"
             "1,1,1,1,x\n");
  expect_failure([&]() { resume(1); });
  write_file("");
  expect_failure([&]() { resume(1); });
  expect_failure([&]() {
    HistoryWriter("nowhere/history.csv",
                  columns,
                  MPI_COMM_WORLD,
                  Overwrite::no);
  });
  expect_failure([&]() {
    HistoryWriter::resume("nowhere/history.csv", columns, MPI_COMM_WORLD, 1);
  });
  expect_failure([&]() {
    HistoryWriter("/dev/full", columns, MPI_COMM_WORLD, Overwrite::yes);
  });
  for (const std::string name : {"", "a,b", "force"})
    expect_failure([&]() {
      HistoryWriter(filename, {name}, MPI_COMM_WORLD, Overwrite::yes);
    });
  expect_failure([&]() { make_directory("/dev/null/output", MPI_COMM_WORLD); });

  deallog << "-- an empty table can be continued after step 0" << std::endl;
  create(Overwrite::yes);
  resume(0).write(1, 1., 1., {1., 1.});
  print();

  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::remove(filename.c_str());
}
