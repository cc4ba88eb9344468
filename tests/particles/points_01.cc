// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Fill bodies with points: how many there are, their volume, how it converges,
// and what depends on the region. The numbers of the points, their order in
// the cells and the boundary points must not depend on the number of
// processes, so the outputs for 1, 2 and 3 of them are identical.

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/shape_parser.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include "../tests.h"

#include "points.h"


template <int dim>
void
test()
{
  deallog.push(std::to_string(dim) + "d");

  // Not a power of two, so that the space-filling curve visits several trees.
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  Point<dim>                                lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = -0.5;
      upper[d] = 1;
    }
  GridGenerator::subdivided_hyper_rectangle(triangulation,
                                            std::vector<unsigned int>(dim, 3),
                                            lower,
                                            upper);
  triangulation.refine_global(dim == 2 ? 3 : 1);
  const MappingCartesian<dim> mapping;

  const std::string z0 = (dim == 3 ? ",0" : "");
  const std::string z1 = (dim == 3 ? ",1" : "");

  // The number of points and the volume, of a body of whole cells, of one that
  // cuts cells, and with all options.
  const auto fill = [&](const std::string                   &text,
                        const PointGenerator::FillData<dim> &data) {
    const auto          shape = parse_shape<dim>(text);
    MaterialPoints<dim> points(triangulation, mapping);
    PointGenerator::fill(*shape, data, points);

    unsigned int n_predicted = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        n_predicted += PointGenerator::count_points_in_cell(*shape, data, cell);

    double n_undamageable = 0;
    for (auto &particle : points.handler())
      n_undamageable +=
        1 - MaterialPoint<dim>(particle.get_properties()).damageable();
    deallog << text << ": " << points.n_global() << " points, predicted "
            << Utilities::MPI::sum(n_predicted, MPI_COMM_WORLD)
            << ", undamageable "
            << Utilities::MPI::sum(n_undamageable, MPI_COMM_WORLD)
            << ", volume " << points.total_volume() << std::endl;
    check_points(points);
  };

  const std::string box    = "box(0,0" + z0 + ", 1,1" + z1 + ")";
  const std::string corner = "box(0,0" + z0 + ", 0.5,0.5" + z1 + ")";
  const std::string ball   = "ball(0.25,0.25" + z0 + ", 0.7)";

  PointGenerator::FillData<dim> data;
  fill(box, data);
  fill(box + " - " + corner, data);
  for (const unsigned int n : {1, 2, 4, 8})
    {
      data.n_points_per_direction = n;
      fill(ball, data);
    }
  data.n_points_per_direction = 2;
  data.regions = {{parse_shape<dim>(corner), 4}, {parse_shape<dim>(box), 1}};
  data.undamageable = {parse_shape<dim>(corner)};
  fill(box, data);

  // Gauss points integrate polynomials, but have gaps at curved surfaces.
  data                        = PointGenerator::FillData<dim>();
  data.layout                 = PointGenerator::Layout::gauss;
  data.n_points_per_direction = 3;
  fill(box, data);
  {
    MaterialPoints<dim> points(triangulation, mapping);
    PointGenerator::fill(*parse_shape<dim>(box), data, points);
    double integral = 0;
    for (auto &particle : points.handler())
      integral +=
        std::pow(particle.get_location()[0], 5) *
        MaterialPoint<dim>(particle.get_properties()).reference_volume();
    deallog << "integral of x^5: "
            << Utilities::MPI::sum(integral, MPI_COMM_WORLD) << std::endl;
  }

  // A second body in the same set continues the numbers.
  {
    MaterialPoints<dim> points(triangulation, mapping);
    data = PointGenerator::FillData<dim>();
    PointGenerator::fill(*parse_shape<dim>(box), data, points);
    PointGenerator::fill(*parse_shape<dim>("translate(-0.5,0" + z0 + ", " +
                                           corner + ")"),
                         data,
                         points);
    deallog << "two bodies: " << points.n_global() << " points, volume "
            << points.total_volume() << std::endl;
    check_points(points);
  }

  // The boundary of a body with edges on grid lines and on the rim of the grid:
  // the first selection wins, what is not selected has no points, and every
  // point is in a cell of the body.
  {
    const auto          shape = parse_shape<dim>(box);
    BoundaryPoints<dim> points(triangulation, mapping);
    PointGenerator::boundary(*shape,
                             {{7, "y > 1 - 1e-6 && ny > 0.5"},
                              {3, "y < 0.5 && abs(nx) > 0.5"},
                              {4, "abs(nx) > 0.5"}},
                             0.03,
                             points);
    deallog << "boundary: " << points.n_global() << " points, areas "
            << points.total_area(7) << ' ' << points.total_area(3) << ' '
            << points.total_area(4) << ' ' << points.total_area(0) << std::endl;
    check_points(points);

    const auto count_outside = [&]() {
      unsigned int n = 0;
      for (auto &particle : points.handler())
        n += !shape->contains(particle.get_surrounding_cell()->center());
      return Utilities::MPI::sum(n, MPI_COMM_WORLD);
    };
    deallog << "in cells without body: " << count_outside();
    points.sort();
    deallog << ", after sorting: " << count_outside() << std::endl;
    check_points(points);
  }
  {
    BoundaryPoints<dim> points(triangulation, mapping);
    PointGenerator::boundary(*parse_shape<dim>("ball(0.25,0.25" + z0 +
                                               ", 0.45)"),
                             {{1, "1"}},
                             0.05,
                             points);
    deallog << "ball: " << points.n_global() << " points, area "
            << points.total_area(1) << std::endl;
    check_points(points);
  }
  deallog.pop();
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  test<2>();
  test<3>();
}
