// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The fields of material and of boundary points, as they are in the files.

#include <ebsmpm/particles/boundary_points.h>
#include <ebsmpm/particles/material_points.h>

#include <ebsmpm/output/point_fields.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_generator.h>

#include <cmath>

#include "../tests.h"

#include "read_vtu.h"



void
print(const std::string &filename)
{
  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      unsigned int     n_pieces = 0;
      const VTU::Piece all      = VTU::read_pieces(filename, n_pieces);
      deallog << filename << ": " << all.fields.at("id").size() << " points in "
              << n_pieces << " pieces" << std::endl;
      for (const auto &[name, values] : all.fields)
        {
          // The sum over all points, component by component.
          const unsigned int  n = all.n_components.at(name);
          std::vector<double> sum(n, 0.);
          for (unsigned int i = 0; i < values.size(); ++i)
            sum[i % n] += values[i];
          deallog << "<" << name << ">";
          for (const double s : sum)
            deallog << ' ' << (std::abs(s) < 1e-5 ? 0. : s);
          deallog << std::endl;
        }
    }
  MPI_Barrier(MPI_COMM_WORLD);
}



template <int dim>
void
test()
{
  deallog << "-- " << dim << "d" << std::endl;
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::hyper_cube(triangulation);
  triangulation.refine_global(2);
  const MappingQ1<dim> mapping;

  MaterialPoints<dim> points(triangulation, mapping);
  BoundaryPoints<dim> boundary(triangulation, mapping);
  std::vector<typename MaterialPoints<dim>::Record> records;
  std::vector<typename BoundaryPoints<dim>::Record> boundary_records;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        records.push_back({cell->center(), cell, cell->measure(), true});
        if (cell->center()[0] < 0.5)
          boundary_records.push_back(
            {cell->center(), cell, 0.25, -Point<dim>::unit_vector(0), 3});
      }
  points.insert(records);
  boundary.insert(boundary_records);

  for (auto &particle : points.handler())
    {
      MaterialPoint<dim> point(particle.get_properties());
      point.damage()       = 0.25;
      point.history()      = 3.;
      point.peak_damage()  = 0.5;
      point.label_frozen() = 1.;
      Tensor<2, dim> F;
      for (unsigned int d = 0; d < dim; ++d)
        F[d][d] = 1. + 0.5 * d;
      point.set_deformation_gradient(F);
      point.set_displacement(0.125 * Point<dim>::unit_vector(1));
      point.set_side(-Point<dim>::unit_vector(dim - 1));
    }

  VTUSeries series(".", "points", MPI_COMM_WORLD, Overwrite::yes);
  make_material_point_writer<dim>().write(points.handler(), series, 0, 0.);
  print("points_00000.pvtu");

  VTUSeries boundary_series(".", "boundary", MPI_COMM_WORLD, Overwrite::yes);
  make_boundary_point_writer<dim>().write(boundary.handler(),
                                          boundary_series,
                                          0,
                                          0.);
  print("boundary_00000.pvtu");
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPILogInitAll                    log;
  test<2>();
  test<3>();
}
