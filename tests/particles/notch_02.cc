// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The faces of a slit: points on both, with the area of the slit, normals into
// it, and sides that are those of the material behind them, also after the
// points have been sorted into cells. The tip margin of a slit.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/notch.h>
#include <ebsmpm/particles/shape_parser.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <sstream>

#include "../tests.h"



template <int dim>
void
test()
{
  deallog.push(std::to_string(dim) + "d");
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 10);
  const MappingCartesian<dim> mapping;

  const auto body =
    parse_shape<dim>(dim == 2 ? "box(0,0, 1,1)" : "box(0,0,0, 1,1,1)");
  MaterialPoints<dim>           points(triangulation, mapping);
  PointGenerator::FillData<dim> data;
  data.n_points_per_direction = 2;
  PointGenerator::fill(*body, data, points);

  // A quarter of a penny (2d: half a line) on a line of the grid.
  Notch::Slit<dim> slit;
  slit.point[dim - 1]  = 0.5;
  slit.normal[dim - 1] = 2.;
  slit.open_region =
    parse_shape<dim>(dim == 2 ? "ball(0,0.5, 0.62)" : "ball(0,0,0.5, 0.62)");
  slit.label_width  = 0.2;
  slit.damage_width = 0.1;
  slit.tip_margin   = 0.1;

  BoundaryPoints<dim> faces(triangulation, mapping);
  Notch::add_faces<dim>(slit, body, 0.04, 4, 7, faces);
  Notch::label_slit(slit, points, faces);
  faces.sort();

  const double exact = (dim == 2 ? 0.62 : 0.25 * numbers::PI * 0.62 * 0.62);
  for (const unsigned int id : {4, 7})
    {
      unsigned int n_normals = 0, n_sides = 0, n_cells = 0, n_points = 0;
      for (auto &particle : faces.handler())
        {
          const BoundaryPoint<dim> point(particle.get_properties());
          if (point.boundary_id() != id)
            continue;
          Tensor<1, dim> n;
          n[dim - 1] = (id == 4 ? 1. : -1.);
          ++n_points;
          n_normals += ((point.reference_normal() - n).norm() < 1e-12);
          n_sides += ((point.side() - n).norm() < 1e-12);
          const auto cell = particle.get_surrounding_cell(triangulation);
          n_cells += ((cell->center()[dim - 1] < 0.5) == (id == 4));
        }
      const MPI_Comm comm = MPI_COMM_WORLD;
      deallog << "face " << id << ": area "
              << (std::abs(faces.total_area(id) / exact - 1.) < 2e-3 ? "right" :
                                                                       "wrong");
      for (const unsigned int n : {n_normals, n_sides, n_cells})
        deallog << ' '
                << (Utilities::MPI::sum(n, comm) ==
                        Utilities::MPI::sum(n_points, comm) ?
                      "right" :
                      "wrong");
      deallog << std::endl;
    }

  // How close to the tip points count as broken.
  double farthest = 0.;
  for (auto &particle : points.handler())
    if (MaterialPoint<dim>(particle.get_properties()).peak_damage() == 1.)
      {
        Tensor<1, dim> r = particle.get_location();
        r[dim - 1]       = 0.;
        farthest         = std::max(farthest, r.norm());
      }
  deallog << "broken up to "
          << 1e-3 *
               std::floor(1e3 * Utilities::MPI::max(farthest, MPI_COMM_WORLD))
          << std::endl;

  slit.point[dim - 1] = 2.;
  try
    {
      Notch::add_faces<dim>(slit, body, 0.04, 4, 7, faces);
    }
  catch (const ExcInput &exception)
    {
      std::ostringstream message;
      exception.print_info(message);
      deallog << message.str().substr(4, message.str().size() - 5) << std::endl;
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
