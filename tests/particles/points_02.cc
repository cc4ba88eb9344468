// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Sort points into cells after they have moved: by less than a cell, over
// several cells and processes at once, and onto faces, edges and vertices.
// No point may get lost or doubled, or change its properties, and which cell
// it is in must not depend on the number of processes, nor on where it comes
// from. The same on a locally refined grid.

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/primitive_shapes.h>
#include <ebsmpm/particles/shape_parser.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include "../tests.h"

#include "points.h"


template <int dim>
void
move(MaterialPoints<dim> &points, const Tensor<1, dim> &shift)
{
  for (auto &particle : points.handler())
    {
      MaterialPoint<dim> point(particle.get_properties());
      point.set_displacement(point.displacement() + shift);
      particle.set_location(particle.get_location() + shift);
    }
  points.sort();
}



template <int dim>
void
test(const bool refine_locally)
{
  deallog.push(std::to_string(dim) + (refine_locally ? "d, refined" : "d"));

  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 3, 0, 3);
  triangulation.refine_global(dim == 2 ? 2 : 1);
  if (refine_locally)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center().norm() < 2)
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }
  const MappingCartesian<dim> mapping;

  Point<dim> center;
  for (unsigned int d = 0; d < dim; ++d)
    center[d] = 0.8;
  const BallShape<dim>          ball(center, 0.7);
  PointGenerator::FillData<dim> data;
  data.n_points_per_direction = 2;
  MaterialPoints<dim> points(triangulation, mapping);
  PointGenerator::fill(ball, data, points);

  // The history is to travel with the number.
  for (auto &particle : points.handler())
    MaterialPoint<dim>(particle.get_properties()).history() =
      1. + particle.get_id();

  const auto report = [&](const std::string &what) {
    unsigned int n_wrong = 0;
    for (auto &particle : points.handler())
      {
        const MaterialPoint<dim> point(particle.get_properties());
        const Point<dim> origin(particle.get_location() - point.displacement());
        n_wrong += point.history() != 1. + particle.get_id() ||
                   point.damageable() != 1 || !ball.contains(origin) ||
                   (point.deformation_gradient() -
                    Tensor<2, dim>(unit_symmetric_tensor<dim>()))
                       .norm() != 0;
      }
    deallog << what << ": " << points.n_global() << " points, volume "
            << points.total_volume() << ", wrong properties "
            << Utilities::MPI::sum(n_wrong, MPI_COMM_WORLD) << std::endl;
    check_points(points);
  };
  report("new");
  points.sort();
  report("unmoved");

  Tensor<1, dim> shift;
  for (unsigned int d = 0; d < dim; ++d)
    shift[d] = 0.11 + 0.03 * d;
  move(points, shift);
  report("a bit");

  MaterialPoints<dim> copy(triangulation, mapping);
  copy.copy_from(points);

  for (unsigned int d = 0; d < dim; ++d)
    shift[d] = 1.25 - 0.07 * d;
  move(points, shift);
  report("far");
  move(points, -shift);
  report("far back");
  points.copy_from(copy);
  report("from a copy");

  // One point at each vertex of the grid, put into any of the cells around.
  MaterialPoints<dim> vertices(triangulation, mapping);
  {
    std::vector<typename MaterialPoints<dim>::Record> records;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (unsigned int v = 0; v < (1 << dim); ++v)
          {
            // The cell that has the point for its first vertex, or is at the
            // rim, creates it.
            const Point<dim> x       = cell->vertex(v);
            bool             creator = true;
            for (unsigned int d = 0; d < dim; ++d)
              creator = creator &&
                        (((v >> d) & 1) == 0 || cell->at_boundary(2 * d + 1));
            if (creator)
              records.push_back({x, cell, 1.});
          }
    vertices.insert(records);
  }
  const auto report_vertices = [&](const std::string &what) {
    deallog << what << ": " << vertices.n_global() << " points" << std::endl;
    check_points(vertices);
  };
  report_vertices("vertices");
  vertices.sort();
  report_vertices("vertices, sorted");

  // Shift all points by rounding errors, and by whole cells. Those at the
  // upper rim would leave the grid, so reflect them to and fro.
  const auto reflect = [&](const double noise) {
    for (auto &particle : vertices.handler())
      {
        Point<dim> x = particle.get_location();
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = 3. - x[d] + noise * (particle.get_id() % 3 - 1.);
        particle.set_location(x);
      }
    vertices.sort();
  };
  reflect(1e-13);
  reflect(0);
  for (auto &particle : vertices.handler())
    {
      Point<dim> x = particle.get_location();
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = std::round(x[d] * 8.) / 8.;
      particle.set_location(x);
    }
  vertices.sort();
  report_vertices("vertices, to and fro");

  // In which cell a point on a face is, depends on nothing but its position.
  unsigned int n_upper = 0;
  for (auto &particle : vertices.handler())
    for (unsigned int d = 0; d < dim; ++d)
      n_upper += (particle.get_reference_location()[d] > 0.5 &&
                  particle.get_location()[d] < 3. - 1e-6);
  deallog << "at an upper face: "
          << Utilities::MPI::sum(n_upper, MPI_COMM_WORLD) << std::endl;
  deallog.pop();
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  test<2>(false);
  test<2>(true);
  test<3>(false);
  test<3>(true);
}
