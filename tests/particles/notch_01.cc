// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Label the points next to a slit: which side, how far from the plane and ahead
// of the tip, which count as broken, what happens to points on the plane
// itself. And give the points of a band an initial history.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/notch.h>
#include <ebsmpm/particles/shape_parser.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <map>
#include <sstream>

#include "../tests.h"


// Print what the points with sides above and below the plane have in common.
template <int dim, typename View>
void
report(const std::string         &name,
       const PointSet<dim, View> &points,
       const Point<dim>          &on_plane,
       const Tensor<1, dim>      &n)
{
  for (const int side : {1, -1})
    {
      unsigned int n_points = 0, n_frozen = 0, n_broken = 0;
      double       nearest = 1e10, farthest = -1e10, farthest_broken = -1e10,
             ahead = -1e10, ahead_broken = -1e10;
      for (auto &particle : points.handler())
        {
          const View view(particle.get_properties());
          if ((view.side() + side * n).norm() > 1e-12)
            continue;
          const double distance =
            1e-9 *
            std::round(1e9 * side * (n * (particle.get_location() - on_plane)));
          ++n_points;
          n_frozen += (view.label_frozen() == 1);
          nearest  = std::min(nearest, distance);
          farthest = std::max(farthest, distance);
          ahead    = std::max(ahead, particle.get_location()[0]);
          if (view.peak_damage() == 1)
            {
              ++n_broken;
              farthest_broken = std::max(farthest_broken, distance);
              ahead_broken = std::max(ahead_broken, particle.get_location()[0]);
            }
        }
      deallog << name << (side > 0 ? " above: " : " below: ") << n_points
              << " points, " << n_frozen << " frozen, distance " << nearest
              << " to " << farthest << ", up to x = " << ahead
              << "; broken: " << n_broken << ", distance to " << farthest_broken
              << ", up to x = " << ahead_broken << std::endl;
    }

  unsigned int n_unlabelled = 0;
  for (auto &particle : points.handler())
    {
      const View view(particle.get_properties());
      n_unlabelled += (view.side().norm() == 0 && view.label_frozen() == 0 &&
                       view.peak_damage() == 0);
    }
  deallog << name << " without label: " << n_unlabelled << " of "
          << points.n_global() << std::endl;
}



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
  const auto open = parse_shape<dim>(
    dim == 2 ? "half_space(0.5,0.5, 1,0)" : "half_space(0.5,0.5,0.5, 1,0,0)");
  MaterialPoints<dim>           points(triangulation, mapping);
  PointGenerator::FillData<dim> data;
  data.n_points_per_direction = 2;
  PointGenerator::fill(*body, data, points);
  BoundaryPoints<dim> boundary_points(triangulation, mapping);
  PointGenerator::boundary(*body, {{0, "x < 1e-6"}}, 0.05, boundary_points);

  // The plane between the rows of points; the normal has any length.
  Notch::Slit<dim> slit;
  for (unsigned int d = 0; d < dim; ++d)
    slit.point[d] = 0.5;
  slit.normal[1]    = 2;
  slit.open_region  = open;
  slit.label_width  = 0.2;
  slit.damage_width = 0.1;
  Notch::label_slit(slit, points, boundary_points);
  const Tensor<1, dim> up = Point<dim>::unit_vector(1);
  report("points", points, slit.point, up);
  report("boundary", boundary_points, slit.point, up);

  // Fewer labels ahead of the tip.
  MaterialPoints<dim> few(triangulation, mapping);
  PointGenerator::fill(*body, data, few);
  BoundaryPoints<dim> none(triangulation, mapping);
  slit.label_reach = 0.1;
  Notch::label_slit(slit, few, none);
  report("few ahead", few, slit.point, up);
  slit.label_reach = 0.;

  // The plane on a row of points, up to rounding: these are above.
  MaterialPoints<dim> on_row(triangulation, mapping);
  PointGenerator::fill(*body, data, on_row);
  slit.point[1] = 0.525 + 1e-14;
  slit.normal *= -1;
  Notch::label_slit(slit, on_row, none);
  report("on a row", on_row, slit.point, -up);

  // Initial damage: the larger value stays.
  Notch::initial_history(*open, 2., points);
  Notch::initial_history(*body, 1., points);
  Notch::initial_history(*open, 0.5, points);
  std::map<double, unsigned int> n_points;
  for (auto &particle : points.handler())
    ++n_points[MaterialPoint<dim>(particle.get_properties()).history()];
  for (const auto &p : n_points)
    deallog << "history " << p.first << " at " << p.second << " points"
            << std::endl;

  for (const bool has_normal : {false, true})
    try
      {
        Notch::Slit<dim> wrong;
        wrong.normal[0] = has_normal;
        Notch::label_slit(wrong, on_row, none);
      }
    catch (const ExcInput &e)
      {
        std::ostringstream message;
        e.print_info(message);
        deallog << message.str().substr(4, message.str().size() - 5)
                << std::endl;
      }
  deallog.pop();
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  initlog();

  test<2>();
  test<3>();
}
