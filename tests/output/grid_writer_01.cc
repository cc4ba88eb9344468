// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Spline fields on the grid come back from the files that are written. A spline
// whose coefficients are the Greville points of its functions is the position
// itself, which the file has, too.

#include <ebsmpm/base/command_line.h>
#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/grid_writer.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "../tests.h"

#include "read_vtu.h"



template <int dim>
void
test(const unsigned int degree)
{
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::hyper_rectangle(triangulation,
                                 Point<dim>(),
                                 dim == 2 ? Point<dim>(1, 2) :
                                            Point<dim>::unit_vector(0) +
                                              Point<dim>::unit_vector(1) +
                                              Point<dim>::unit_vector(2));
  triangulation.refine_global(2);

  using Cell           = typename GridWriter<dim>::CellIterator;
  const unsigned int n = Utilities::fixed_power<dim>(degree + 1);

  // The lowest row of cells has no material.
  const auto has_material = [](const Cell &cell) {
    return cell->vertex(0)[1] > 0.1;
  };
  double bad = 0;

  GridWriter<dim> writer(degree);
  writer.add_scalar("side", [&](const Cell &cell, std::vector<double> &c) {
    if (has_material(cell))
      {
        // Two sides in one column of cells.
        c.assign(n, 1.);
        if (cell->vertex(0)[0] == 0.5)
          c.insert(c.end(), n, -1.);
      }
  });
  writer.add_vector("position", [&](const Cell &cell, std::vector<double> &c) {
    if (has_material(cell))
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int d = 0, k = i; d < dim; ++d, k /= degree + 1)
          c.push_back(cell->vertex(0)[d] +
                      cell->extent_in_direction(d) *
                        (k % (degree + 1) - 0.5 * (degree - 1.)));
  });
  writer.add_scalar("zero", [&](const Cell &cell, std::vector<double> &c) {
    // On cells without material, this one has coefficients, which do not count.
    c.assign(n, 0.);
    if (cell->vertex(0)[0] == 0.75 && cell->vertex(0)[1] > 0.7)
      c[n / 2] = bad;
  });

  VTUSeries series(".", "grid", MPI_COMM_WORLD, Overwrite::yes);
  writer.write(triangulation, series, 1, 0.5);

  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      unsigned int     n_pieces = 0;
      const VTU::Piece all      = VTU::read_pieces("grid_00001.pvtu", n_pieces);
      const std::vector<double> &x     = all.fields.at("");
      const std::vector<double> &y     = all.fields.at("position");
      double                     error = 0, side = 0, zero = 0, lowest = 1e300;
      for (unsigned int i = 0; i < x.size(); ++i)
        {
          error = std::max(error, std::abs(x[i] - y[i]));
          if (i % 3 == 1)
            lowest = std::min(lowest, x[i]);
        }
      for (const double s : all.fields.at("side"))
        side += s;
      for (const double z : all.fields.at("zero"))
        zero = std::max(zero, std::abs(z));
      deallog << dim << "d, degree " << degree << ": " << n_pieces
              << " pieces, " << x.size() / 3
              << " corners of subcells from y = " << lowest << ", sum of sides "
              << side << ", zero is " << zero << ", the position is "
              << (error < 1e-6 ? "right" : "WRONG") << std::endl;
    }
  MPI_Barrier(MPI_COMM_WORLD);

  bad = std::numeric_limits<double>::quiet_NaN();
  try
    {
      writer.write(triangulation, series, 2, 1.);
      deallog << "NOT refused" << std::endl;
    }
  catch (const ExcSolverFailure &exception)
    {
      deallog << describe_exception(exception) << std::endl;
    }
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPILogInitAll                    log;
  for (unsigned int degree = 1; degree <= 3; ++degree)
    {
      test<2>(degree);
      test<3>(degree);
    }
}
