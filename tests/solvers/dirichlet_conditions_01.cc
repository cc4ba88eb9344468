// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// DirichletConditions: values, which components are prescribed, and what is
// said about each kind of mistake.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/solvers/dirichlet_conditions.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <sstream>

#include "../tests.h"

#include "../assembly/point_setup.h"



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  initlog();

  const std::vector<std::string> names = {"left", "right", "bottom", "top"};

  parallel::distributed::Triangulation<2> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 4, -1., 3.);
  BodyOnGrid<2> body(triangulation,
                     BoxBody<2>(Point<2>(0., 0.), Point<2>(1., 1.)),
                     2,
                     1);
  // Formulas are in reference coordinates.
  for (auto &u : body.boundary.displacement)
    u[0] = 0.25;

  const DirichletConditions<2> conditions(
    " bottom.x = 0; bottom.y=0 ;top.y = 2*u + x; left . x = u*y + sin(pi*y)",
    names);
  for (const double load : {1., 3.})
    {
      conditions.apply(load, body.boundary_points, body.boundary);
      for (unsigned int q = 0; q < body.boundary_points.n_points(); ++q)
        {
          deallog << "load " << load << ", "
                  << names[body.boundary.boundary_id[q]] << " at "
                  << body.boundary_points.location(q) << ':';
          for (unsigned int c = 0; c < 2; ++c)
            if (body.boundary.projection[q][c][c] == 1.)
              deallog << ' ' << body.boundary.prescribed[q][c];
            else
              deallog << " free";
          deallog << std::endl;
        }
    }

  // Along an oblique normal.
  {
    const DirichletConditions<2> sliding("right.normal = 2*u + y", names);
    for (auto &N : body.boundary.normal)
      N = Tensor<1, 2>({0.6, 0.8});
    sliding.apply(2., body.boundary_points, body.boundary);
    const auto rates = sliding.rates(2., body.boundary_points, body.boundary);
    for (unsigned int q = 0; q < body.boundary_points.n_points(); ++q)
      if (names[body.boundary.boundary_id[q]] == "right")
        deallog << "sliding: " << body.boundary.projection[q] << ", "
                << body.boundary.prescribed[q] << ", rate " << rates[q]
                << std::endl;
      else
        AssertThrow(body.boundary.projection[q].norm() == 0.,
                    ExcInternalError());
  }

  for (const std::string text : {"top.y",
                                 "top = u",
                                 "roof.y = u",
                                 "top.z = u",
                                 "top.xy = u",
                                 "top.y = u +",
                                 "top.y = w",
                                 "top.y = z",
                                 "top.normal = u; left.x = 0",
                                 "top.normal = u; top.x = 0"})
    try
      {
        DirichletConditions<2> wrong(text, names);
        deallog << text << ": accepted" << std::endl;
      }
    catch (const ExcInput &exception)
      {
        std::ostringstream message;
        exception.print_info(message);
        deallog << message.str() << std::endl;
      }
}
