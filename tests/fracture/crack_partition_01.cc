// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// The crack partition for damage that is given: on which side points are, how
// far the crack reaches, whether gaps are closed, whether a broken body hangs
// together nowhere, and whether labels and patterns stay once they are settled.

#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/shape_parser.h>

#include <ebsmpm/fracture/crack_opening.h>
#include <ebsmpm/fracture/crack_partition.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include "../tests.h"

#include "../assembly/point_setup.h"



/** A curve or surface: signed distance, and how far beyond its tip. */
template <int dim>
struct Crack
{
  std::string                               name;
  std::function<double(const Point<dim> &)> distance;
  std::function<double(const Point<dim> &)> beyond;
  bool                                      through;
  bool                                      has_two_sides = true;
};



template <int dim>
double
distance_to(const Crack<dim> &crack, const Point<dim> &x)
{
  return std::hypot(crack.distance(x), std::max(0., crack.beyond(x)));
}



template <int dim>
void
test(const Crack<dim> &crack, const unsigned int n_cells)
{
  const double                              h = 1. / n_cells;
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation,
                                       n_cells + 4,
                                       -2 * h,
                                       1. + 2 * h);
  MappingCartesian<dim> mapping;
  MaterialPoints<dim>   material_points(triangulation, mapping);
  BoundaryPoints<dim>   boundary_material_points(triangulation, mapping);
  PointGenerator::FillData<dim> fill;
  fill.n_points_per_direction = (dim == 2 ? 3 : 2);
  PointGenerator::fill(*parse_shape<dim>(dim == 2 ? "box(0,0, 1,1)" :
                                                    "box(0,0,0, 1,1,1)"),
                       fill,
                       material_points);

  SplineSpace<dim>          space(triangulation, 2), split(triangulation, 2);
  AffineConstraints<double> constraints;
  CellPoints<dim>           points, boundary_points;
  points.reinit(material_points.handler(), space.lattice());
  boundary_points.reinit(boundary_material_points.handler(), space.lattice());

  MaterialState<dim> state;
  BoundaryState<dim> boundary;
  state.resize(points.n_points());
  for (unsigned int q = 0; q < points.n_points(); ++q)
    {
      state.volume[q] =
        MaterialPoint<dim>(points.properties(q)).reference_volume();
      state.F[q] = unit_symmetric_tensor<dim>();
      // No point of a 3-D body is on the plane: let it be broken there, too.
      state.damage[q] =
        std::min(1.,
                 (dim == 2 ? 1. : 1.2) *
                   std::exp(-distance_to(crack, points.location(q)) /
                            (2.5 * h)));
    }

  typename SplineSpace<dim>::SupportTable supports;
  add_supports<dim>(points, state.volume, {}, space, supports);
  space.reinit(supports, 0.1);

  // At a free face, the ball in which the shape of the ridge is determined is a
  // half one, and in 3-D too flat with the usual radius of four cells.
  typename CrackPartition<dim>::AdditionalData data;
  data.ridge_radius = (dim == 2 ? 4 : 6);
  CrackPartition<dim> partition(space, data);
  CrackLabels<dim>    labels, boundary_labels;
  labels.resize(points.n_points());
  boundary_labels.resize(0);
  const auto update = [&]() {
    return partition.update(points,
                            boundary_points,
                            state.volume,
                            state.damage,
                            labels,
                            boundary_labels);
  };
  update();
  update();
  const bool again  = update();
  const auto before = partition.patterns();

  // On which side a point is: the side vector points to the crack.
  const auto above = [&](const unsigned int q) {
    const Point<dim> &x = points.location(q);
    if (before[q] == 0)
      return crack.distance(x) > 0.;
    return crack.distance(x + 0.01 * h * labels.side[q]) < crack.distance(x);
  };

  // Points that read twins: how many, on the right side, how far. At a curved
  // or oblique crack, points within a third of a cell may be mistaken.
  double n_reading = 0., n_frozen = 0., mistaken = 0.;
  double reach = -1e10;
  for (unsigned int q = 0; q < points.n_points(); ++q)
    if (before[q] != 0)
      {
        const Point<dim> &x = points.location(q);
        const double      s = crack.distance(x);
        n_reading += 1.;
        n_frozen += labels.frozen[q] ? 1. : 0.;
        if (crack.has_two_sides && above(q) != (s > 0.))
          mistaken = std::max(mistaken, std::abs(s) / h);
        reach = std::max(reach, crack.beyond(x) / h);
      }
  const auto sum = [](const double x) {
    return static_cast<unsigned int>(Utilities::MPI::sum(x, MPI_COMM_WORLD));
  };
  deallog << dim << "-D, " << crack.name << ": " << sum(n_reading)
          << " points read twins, those on the wrong side are near "
          << verdict(Utilities::MPI::max(mistaken, MPI_COMM_WORLD), 0.35)
          << ", " << sum(n_frozen) << " settled, stationary "
          << (again ? "FAILED" : "OK");
  if (!crack.through)
    deallog << ", reach beyond the tip "
            << Utilities::MPI::max(reach, MPI_COMM_WORLD) << " h";
  deallog << std::endl;

  // The space of the displacement.
  supports.clear();
  add_supports<dim>(
    points, state.volume, partition.patterns(), split, supports);
  partition.add_sides(supports);
  split.reinit(supports, 0.1);
  const auto report = make_extension_constraints(split, constraints);
  if (partition.n_junctions() > 0)
    deallog << "  refused at a junction: " << partition.n_junctions()
            << " functions" << std::endl;
  deallog << "  unknown functions " << space.n_independent()
          << " when whole, not more when split "
          << (split.n_independent() <= space.n_independent() ? "OK" : "FAILED")
          << " (" << split.n_independent() << "), " << split.n_twins()
          << " twins, " << report.n_wrong_side << " from the wrong side"
          << std::endl;

  // A body that is broken has a rigid motion for each half.
  if (crack.through)
    {
      const auto material = make_material<dim>(
        "neo-Hookean", EnergySplit::volumetric_deviatoric, 3., 1.);
      const Degradation       degradation(1e-4);
      DisplacementSystem<dim> system(*material, degradation, 1.);
      system.reinit(points,
                    boundary_points,
                    split,
                    constraints,
                    partition.patterns(),
                    partition.boundary_patterns());
      LA::FieldVector u = system.make_vector();
      for (const auto &entry : split.functions())
        if (split.locally_owned_independent().is_element(entry.second.index))
          {
            const Point<dim> x = split.lattice().greville_point(entry.first, 2);
            // On which side the function is, if it knows: the one its side
            // vector comes from.
            bool       is_above = crack.distance(x) > 0.;
            const auto found    = supports.find(entry.first);
            if (found != supports.end())
              {
                Tensor<1, dim> side;
                for (unsigned int d = 0; d < dim; ++d)
                  side[d] = found->second.side[d];
                if (side.norm() > 0.1)
                  is_above =
                    crack.distance(x + 1e-3 * h * side) < crack.distance(x);
              }
            if (is_above)
              u(dim * entry.second.index + dim - 1) = 0.5;
          }
      const auto   moved = system.update_points(state, u);
      const auto   edges = system.update_points(boundary, u);
      const double energy =
        system
          .energies(state, moved, boundary, edges, system.flux(boundary, edges))
          .elastic;
      double opening = 0.;
      for (unsigned int q = 0; q < points.n_points(); ++q)
        opening = std::max(opening,
                           std::abs(moved.displacement_increment[q][dim - 1] -
                                    (above(q) ? 0.5 : 0.)));
      // The halves have moved apart, or into each other.
      for (const double factor : {1., -0.2})
        {
          std::vector<Tensor<1, dim>> increments;
          for (const auto &increment : moved.displacement_increment)
            increments.push_back(factor * increment);
          const auto opening =
            crack_opening(points,
                          partition,
                          state.volume,
                          std::vector<Tensor<1, dim>>(points.n_points()),
                          increments,
                          state.F);
          deallog << "  moved by " << 0.5 * factor << ", the lips are "
                  << opening.smallest << " apart" << std::endl;
        }
      deallog << "  no ligament: energy " << verdict(std::abs(energy), 1e-12)
              << ", motion "
              << verdict(Utilities::MPI::max(opening, MPI_COMM_WORLD), 1e-11)
              << std::endl;
    }

  // What is separated remains so when the damage is below the threshold.
  for (double &d : state.damage)
    d *= 0.8;
  update();
  double n_lost = 0.;
  for (unsigned int q = 0; q < points.n_points(); ++q)
    n_lost += (before[q] & ~partition.patterns()[q]) != 0 ? 1. : 0.;
  deallog << "  with less damage, " << sum(n_lost) << " points have lost twins"
          << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  const double h = 1. / 21.;

  // With an odd number of rows, the middle is on a row of control points.
  const auto straight = [](const double y) {
    return [y](const Point<2> &x) { return x[1] - y; };
  };
  const auto inclined = [](const Point<2> &x) {
    return -std::sin(numbers::PI / 9.) * (x[0] - 0.5) +
           std::cos(numbers::PI / 9.) * (x[1] - 0.5);
  };
  const auto arc = [](const Point<2> &x) {
    return x.distance(Point<2>(0.5, -0.8)) - 1.3;
  };
  const auto nowhere = [](const Point<2> &) { return -1.; };

  test<2>({"on control points", straight(0.5), nowhere, true}, 21);
  test<2>({"between them", straight(0.5 + 0.5 * h), nowhere, true}, 21);
  test<2>({"inclined", inclined, nowhere, true}, 21);
  test<2>({"arc", arc, nowhere, true}, 21);
  test<2>({"gap in the ridge",
           straight(0.5),
           [h](const Point<2> &x) { return 0.4 * h - std::abs(x[0] - 0.5); },
           true},
          21);
  // Three cracks meet: the sides of the points follow the nearest one.
  const auto junction = [](const Point<2> &x) {
    double nearest = 1e10;
    for (const double angle :
         {0.1, 0.1 + 2. / 3. * numbers::PI, 0.1 + 4. / 3. * numbers::PI})
      {
        const Tensor<1, 2> offset = x - Point<2>(0.48, 0.51);
        const double       along =
          offset[0] * std::cos(angle) + offset[1] * std::sin(angle);
        const double across =
          offset[1] * std::cos(angle) - offset[0] * std::sin(angle);
        nearest = std::min(nearest, std::hypot(across, std::min(0., along)));
      }
    return nearest;
  };
  test<2>({"junction", junction, nowhere, false, false}, 21);
  for (const double tip : {10., 10.25, 10.5, 10.75})
    test<2>({"tip at " + std::to_string(tip).substr(0, 5) + " h",
             straight(0.5),
             [tip, h](const Point<2> &x) { return x[0] - tip * h; },
             false},
            21);
  test<3>({"plane",
           [](const Point<3> &x) { return x[2] - 0.5; },
           [](const Point<3> &) { return -1.; },
           true},
          9);
  // A plane that leaves the body as a wedge, the end of which is less damaged.
  test<3>({"oblique plane",
           [](const Point<3> &x) {
             return (x[0] + x[2] - 1.3) / std::sqrt(2.);
           },
           [](const Point<3> &x) { return x[0] - 0.8; },
           true},
          9);
}
