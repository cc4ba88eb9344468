// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Where CartesianLattice says that cells are is where they are: on grids of
// several coarse cells, with a hole, refined globally and locally, for serial
// and distributed triangulations. Other grids are refused.

#include <ebsmpm/splines/cartesian_lattice.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "../tests.h"

#include "verdict.h"



template <int dim>
void
refine_locally(Triangulation<dim> &triangulation)
{
  for (unsigned int step = 0; step < 2; ++step)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center().norm() < 0.8)
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }
}



template <int dim>
void
check(const Triangulation<dim> &triangulation, const std::string &name)
{
  const CartesianLattice<dim> lattice(triangulation);
  double                      error = 0.;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (!cell->is_artificial())
      {
        const auto           index = lattice.cell_index(cell);
        const Tensor<1, dim> h     = lattice.cell_extents(cell->level());
        for (unsigned int d = 0; d < dim; ++d)
          {
            error = std::max(error,
                             std::abs(lattice.origin()[d] + index[d] * h[d] -
                                      cell->vertex(0)[d]));
            error = std::max(error,
                             std::abs(
                               cell->vertex(0)[d] + h[d] -
                               cell->vertex(
                                 GeometryInfo<dim>::vertices_per_cell - 1)[d]));
          }
      }
  deallog << name << ", " << dim << "-D, "
          << triangulation.n_global_active_cells() << " cells, "
          << triangulation.n_global_levels() << " levels: "
          << verdict(Utilities::MPI::max(error, MPI_COMM_WORLD), 1e-12)
          << std::endl;
}



template <int dim, typename Grid>
void
check_all(Grid &grid, const std::string &name)
{
  std::vector<unsigned int> repetitions(dim);
  Point<dim>                lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      repetitions[d] = 5 - d;
      lower[d]       = -1. - 0.1 * d;
      upper[d]       = 1. + 0.3 * d;
    }
  GridGenerator::subdivided_hyper_rectangle(grid, repetitions, lower, upper);
  check<dim>(grid, name + ", coarse");
  refine_locally(grid);
  check<dim>(grid, name + ", refined");

  if (dim > 1)
    {
      grid.clear();
      GridGenerator::cheese(grid, std::vector<unsigned int>(dim, 1));
      check<dim>(grid, name + ", with holes");
      refine_locally(grid);
      grid.refine_global(1);
      check<dim>(grid, name + ", with holes, refined");
    }
}



void
expect_refusal(const std::string                             &name,
               const std::function<void(Triangulation<2> &)> &make)
{
  Triangulation<2> grid;
  make(grid);
  try
    {
      const CartesianLattice<2> lattice(grid);
      deallog << name << ": FAILED, accepted" << std::endl;
    }
  catch (const CartesianLattice<2>::ExcNotCartesian &)
    {
      deallog << name << ": refused" << std::endl;
    }
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  {
    Triangulation<1> grid;
    check_all<1>(grid, "serial");
  }
  {
    Triangulation<2> grid;
    check_all<2>(grid, "serial");
  }
  {
    parallel::distributed::Triangulation<2> grid(MPI_COMM_WORLD);
    check_all<2>(grid, "distributed");
  }
  {
    parallel::distributed::Triangulation<3> grid(MPI_COMM_WORLD);
    check_all<3>(grid, "distributed");
  }

  expect_refusal("turned", [](Triangulation<2> &grid) {
    GridGenerator::subdivided_hyper_cube(grid, 3);
    GridTools::transform(
      [](const Point<2> &x) {
        return Point<2>(x[0] - 0.2 * x[1], x[1] + 0.2 * x[0]);
      },
      grid);
  });
  expect_refusal("sheared", [](Triangulation<2> &grid) {
    GridGenerator::subdivided_hyper_cube(grid, 1);
    grid.begin(0)->vertex(1)[0] += 0.1;
  });
  expect_refusal("turned by a right angle", [](Triangulation<2> &grid) {
    GridGenerator::subdivided_hyper_cube(grid, 3);
    GridTools::transform(
      [](const Point<2> &x) { return Point<2>(-x[1], x[0]); }, grid);
  });
  expect_refusal("graded", [](Triangulation<2> &grid) {
    GridGenerator::subdivided_hyper_cube(grid, 3);
    GridTools::transform(
      [](const Point<2> &x) { return Point<2>(x[0] * x[0], x[1]); }, grid);
  });
  expect_refusal("ball", [](Triangulation<2> &grid) {
    GridGenerator::hyper_ball(grid);
  });
}
