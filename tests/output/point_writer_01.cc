// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Points and their fields come back from the files that are written, whatever
// the number of processes; the list of steps can be continued; and what must
// not be written is refused on all processes.

#include <ebsmpm/base/command_line.h>
#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/point_writer.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

#include "../tests.h"

#include "read_vtu.h"



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



// Points in the middle of all cells in a corner of size @p limit, numbered by
// position. The property is half the number.
template <int dim>
void
fill(const Triangulation<dim>        &triangulation,
     Particles::ParticleHandler<dim> &handler,
     const double                     limit)
{
  handler.clear_particles();
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center().norm() < limit)
      {
        Point<dim> unit;
        double     id = 0;
        for (unsigned int d = 0; d < dim; ++d)
          {
            unit[d] = 0.5;
            id      = 4 * id + std::floor(4 * cell->center()[d]);
          }
        Particles::Particle<dim> particle(cell->center(), unit, id);
        auto iterator                 = handler.insert_particle(particle, cell);
        iterator->get_properties()[0] = 0.5 * id;
      }
  handler.update_cached_numbers();
}



template <int dim>
void
print(const std::string &filename)
{
  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      unsigned int     n_pieces = 0;
      const VTU::Piece all      = VTU::read_pieces(filename, n_pieces);
      deallog << filename << ": " << n_pieces << " pieces" << std::endl;

      // A sum over the points in which each has its own weight.
      if (n_pieces > 0)
        {
          const std::vector<double> &ids = all.fields.at("id");
          for (const auto &[name, values] : all.fields)
            {
              const unsigned int  n = all.n_components.at(name);
              std::vector<double> sum(n, 0.);
              for (unsigned int i = 0; i < ids.size(); ++i)
                for (unsigned int c = 0; c < n; ++c)
                  sum[c] += (1 + ids[i]) * values[i * n + c];
              deallog << "<" << name << "> " << values.size() / n << " x " << n
                      << ':';
              for (const double s : sum)
                deallog << ' ' << s / ids.size();
              deallog << std::endl;
            }
        }
    }
  MPI_Barrier(MPI_COMM_WORLD);
}



void
print_pvd(const VTUSeries &series)
{
  MPI_Barrier(MPI_COMM_WORLD);
  for (const auto &[time, file] : series.get_records())
    deallog << time << ' ' << file << std::endl;
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      const std::string text = VTU::read_text("points.pvd");
      deallog << "in the file:";
      for (std::size_t start = text.find("<DataSet");
           start != std::string::npos;
           start = text.find("<DataSet", start + 1))
        deallog << ' ' << VTU::attribute(text.substr(start), "timestep") << ' '
                << VTU::attribute(text.substr(start), "file");
      deallog << std::endl;
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
  const MappingQ1<dim>            mapping;
  Particles::ParticleHandler<dim> handler(triangulation, mapping, 1);

  double           bad = 0;
  PointWriter<dim> writer;
  using Particle = typename PointWriter<dim>::Particle;
  writer.add_scalar("damage", [&bad](Particle &particle) {
    return particle.get_properties()[0] + (particle.get_id() == 3 ? bad : 0);
  });
  writer.add_vector("displacement", [](Particle &particle) {
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = (d + 1) * particle.get_location()[0];
    return u;
  });
  writer.add_tensor("F", [](Particle &) {
    Tensor<2, dim> F;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = 0; e < dim; ++e)
        F[d][e] = 10 * (d + 1) + (e + 1);
    return F;
  });

  {
    VTUSeries series(".", "points", MPI_COMM_WORLD, Overwrite::yes);
    fill(triangulation, handler, 2.);
    writer.write(handler, series, 0, 0.125);
    print<dim>("points_00000.pvtu");

    // Points in one corner: the second of two processes has none.
    fill(triangulation, handler, 0.5);
    writer.write(handler, series, 10, 0.25);
    print<dim>("points_00010.pvtu");

    // No points at all.
    fill(triangulation, handler, 0.);
    writer.write(handler, series, 20, 1. / 3.);
    print<dim>("points_00020.pvtu");
    print_pvd(series);

    deallog << "-- not finite" << std::endl;
    fill(triangulation, handler, 2.);
    bad = std::numeric_limits<double>::quiet_NaN();
    expect_failure([&]() { writer.write(handler, series, 30, 1.); });
    // Too large for single precision.
    bad = 1e200;
    expect_failure([&]() { writer.write(handler, series, 30, 1.); });
    bad = 0;
    expect_failure([&]() {
      writer.write(handler,
                   series,
                   30,
                   std::numeric_limits<double>::infinity());
    });
    deallog << "no file: " << !std::ifstream("points_00030.pvtu") << std::endl;
  }

  deallog << "-- continue" << std::endl;
  {
    VTUSeries series = VTUSeries::resume(".", "points", MPI_COMM_WORLD, 10);
    writer.write(handler, series, 15, 0.5);
    print_pvd(series);
  }

  deallog << "-- refused" << std::endl;
  expect_failure(
    []() { VTUSeries(".", "points", MPI_COMM_WORLD, Overwrite::no); });
  expect_failure(
    []() { VTUSeries::resume(".", "nothing", MPI_COMM_WORLD, 1); });
  VTUSeries nowhere("nowhere", "points", MPI_COMM_WORLD, Overwrite::no);
  expect_failure([&]() { writer.write(handler, nowhere, 0, 0.); });
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPILogInitAll                    log;
  test<2>();
  test<3>();
}
