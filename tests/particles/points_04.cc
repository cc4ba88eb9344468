// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------
// Points that are written with the grid, and read into another one: they have
// their cells, numbers, order and properties again.

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/shape_parser.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include "../tests.h"

#include "points.h"


/** A sum of all properties, with weights that tell them apart. */
template <typename Points>
double
checksum(const Points &points)
{
  double sum = 0.;
  for (const auto &particle : points.handler())
    {
      double factor = 1. + particle.get_id() % 7;
      for (const double x : particle.get_properties())
        sum += (factor *= 1.1) * x;
    }
  return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}



template <int dim>
struct Body
{
  Body()
    : triangulation(MPI_COMM_WORLD)
    , points(triangulation, mapping)
    , boundary_points(triangulation, mapping)
  {
    GridGenerator::subdivided_hyper_cube(triangulation, 3, 0, 3);
  }

  void
  fill()
  {
    triangulation.refine_global(1);
    const auto body =
      parse_shape<dim>(dim == 2 ? "box(0,0, 1,2)" : "box(0,0,0, 1,1,2)");
    PointGenerator::fill(*body, {}, points);
    PointGenerator::boundary(*body, {{3, "nx > 0"}}, 0.2, boundary_points);

    // Some leave their cells, and change their order.
    for (auto &particle : points.handler())
      {
        Point<dim> x = particle.get_location();
        x[0] += 0.3 * (particle.get_id() % 4);
        particle.set_location(x);
        MaterialPoint<dim> point(particle.get_properties());
        point.damage() = 1e-3 * particle.get_id();
      }
    points.sort();
  }

  void
  print() const
  {
    check_points(points);
    check_points(boundary_points);
    deallog << points.n_global() << " points, " << checksum(points) << "; "
            << boundary_points.n_global() << " boundary points, "
            << checksum(boundary_points) << std::endl;
  }

  parallel::distributed::Triangulation<dim> triangulation;
  const MappingCartesian<dim>               mapping;
  MaterialPoints<dim>                       points;
  BoundaryPoints<dim>                       boundary_points;
};



template <int dim>
void
test()
{
  deallog << dim << 'd' << std::endl;
  const std::string name = "points_04_" + std::to_string(dim);
  Body<dim>         body;
  body.fill();
  body.print();
  body.points.prepare_for_serialization();
  body.boundary_points.prepare_for_serialization();
  body.triangulation.save(name);
  body.print();

  Body<dim> other;
  other.triangulation.load(name);
  other.points.deserialize();
  other.boundary_points.deserialize();
  other.print();
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  test<2>();
  test<3>();
}
