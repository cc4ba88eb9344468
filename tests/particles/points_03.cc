// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// A point that leaves the grid is reported on all processes, and nothing has
// changed then: after the positions are restored, all is as before.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/shape_parser.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include <functional>
#include <sstream>

#include "../tests.h"

#include "points.h"


void
report(const std::function<void()> &function)
{
  try
    {
      function();
      deallog << "no error" << std::endl;
    }
  catch (const ExcPointOutsideGrid &e)
    {
      std::ostringstream message;
      e.print_info(message);
      deallog << message.str().substr(4, message.str().find(". ") - 4)
              << std::endl;
    }
}



template <int dim>
void
test()
{
  deallog << dim << 'd' << std::endl;

  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 3, 0, 3);
  triangulation.refine_global(1);
  const MappingCartesian<dim> mapping;

  const std::string   zeros = (dim == 2 ? "0,0" : "0,0,0");
  const std::string   ones  = (dim == 2 ? "1,1" : "1,1,1");
  MaterialPoints<dim> points(triangulation, mapping);
  PointGenerator::fill(*parse_shape<dim>("box(" + zeros + ", " + ones + ")"),
                       {},
                       points);
  check_points(points);

  const auto shift = [&](const Tensor<1, dim> &by) {
    for (auto &particle : points.handler())
      particle.set_location(particle.get_location() + by);
  };

  // Some leave, some move to other processes, some stay.
  Tensor<1, dim> by;
  for (unsigned int d = 0; d < dim; ++d)
    by[d] = 2.2 - d;
  by[0] = 2.5;
  shift(by);
  report([&]() { points.sort(); });
  shift(-by);
  report([&]() { points.sort(); });
  check_points(points);

  // A single one, a little.
  for (auto &particle : points.handler())
    if (particle.get_id() == 5)
      {
        Point<dim> x = particle.get_location();
        x[1]         = -1e-8;
        particle.set_location(x);
      }
  report([&]() { points.sort(); });
  deallog << points.n_global() << " points" << std::endl;

  // Boundary points outside from the beginning.
  BoundaryPoints<dim> boundary_points(triangulation, mapping);
  const auto          body =
    parse_shape<dim>("translate(" + ones + ", box(" + zeros + ", " +
                     (dim == 2 ? "2.5,1" : "2.5,1,1") + "))");
  report([&]() {
    PointGenerator::boundary(*body, {{0, "nx > 0"}}, 0.1, boundary_points);
  });
  report([&]() {
    PointGenerator::boundary(*body, {{0, "nx < 0"}}, 0.1, boundary_points);
  });
  deallog << boundary_points.n_global() << " points" << std::endl;
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPILogInitAll                    log;

  test<2>();
  test<3>();
}
