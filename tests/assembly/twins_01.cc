// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// Two halves of a body that are separated by a crack along a plane: points read
// the twins of the functions that belong to the other half. Then a rigid motion
// of one half against the other costs no energy and meets no force, however
// large, and the number of unknowns is not larger than that of the whole body.
// The plane lies on a row of control points, on a grid line, and in between.

#include <ebsmpm/materials/make_material.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/physics/transformations.h>

#include "../tests.h"

#include "point_setup.h"



template <int dim>
Tensor<2, dim>
rotation();

template <>
Tensor<2, 2>
rotation<2>()
{
  return Physics::Transformations::Rotations::rotation_matrix_2d(0.7);
}

template <>
Tensor<2, 3>
rotation<3>()
{
  return Physics::Transformations::Rotations::rotation_matrix_3d(
    Point<3>(0.6, 0., 0.8), 0.7);
}



template <int dim>
void
test(const unsigned int degree, const double plane)
{
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 3, -0.75, 0.75);
  triangulation.refine_global(dim == 2 ? 2 : 1);
  const double h = (dim == 2 ? 0.125 : 0.25);

  Point<dim> a, b;
  for (unsigned int d = 0; d < dim; ++d)
    {
      a[d] = -0.55;
      b[d] = 0.6;
    }
  BodyOnGrid<dim> body(triangulation, BoxBody<dim>(a, b), degree, degree + 1);
  body.make_space(0.1);
  const auto n_whole = body.space.n_independent();

  // Who is above. The functions' rows are distinct by half a cell at least, so
  // that this is the same on all processes.
  const double position = plane * h;
  const auto   above    = [&](const Point<dim> &x) {
    return x[dim - 1] > position - 1e-10;
  };
  const auto function_above = [&](const FunctionKey<dim> &key) {
    return above(body.space.lattice().greville_point(key, degree));
  };

  const auto read_twins = [&](const CellPoints<dim> &points) {
    std::vector<typename BodyOnGrid<dim>::Pattern> patterns(points.n_points(),
                                                            0);
    for (const auto &cell : points.cells())
      for (unsigned int q = cell.begin; q < cell.end; ++q)
        for (unsigned int i = 0; i < body.space.n_functions_per_cell(); ++i)
          if (above(points.location(q)) !=
              function_above(
                body.space.cell_function(cell.index, cell.level, i)))
            patterns[q] |= (std::uint64_t(1) << i);
    return patterns;
  };
  body.patterns          = read_twins(body.points);
  body.boundary_patterns = read_twins(body.boundary_points);

  auto supports = body.supports();
  for (auto &entry : supports)
    entry.second.side[dim - 1] = function_above(entry.first) ? -1. : 1.;
  body.make_space(supports, 0.1);

  deallog << dim << "-D, degree " << degree << ", plane at " << plane
          << " h: " << n_whole << " unknown functions, "
          << body.space.n_independent() << " when split, "
          << (body.space.n_independent() <= n_whole ? "OK" : "FAILED") << ", "
          << body.space.n_deficient() << " deficient, " << body.space.n_twins()
          << " twins, " << body.report.n_lower_degree << " of lower degree, "
          << body.report.n_wrong_side << " from the wrong side" << std::endl;

  // The bottom is held.
  for (unsigned int q = 0; q < body.boundary_points.n_points(); ++q)
    if (body.boundary.boundary_id[q] != 2 * dim - 2)
      body.boundary.projection[q] = 0.;

  const auto              material = make_material<dim>("neo-Hookean",
                                           EnergySplit::volumetric_deviatoric,
                                           3.,
                                           1.);
  const Degradation       degradation(1e-4);
  DisplacementSystem<dim> system(*material, degradation, 100.);
  body.reinit(system);

  // Turn and move the upper half.
  const Tensor<2, dim> R = rotation<dim>();
  Tensor<1, dim>       t;
  t[dim - 1]        = 0.3;
  t[0]              = 0.1;
  const auto motion = [&](const Point<dim> &x) {
    return t + R * x - Tensor<1, dim>(x);
  };
  LA::FieldVector x = system.make_vector(), residual = x, v = x, w = x;
  body.set_coefficients(x,
                        dim,
                        [&](const FunctionKey<dim> &key,
                            const Point<dim>       &y,
                            const unsigned int      c) {
                          return function_above(key) ? motion(y)[c] : 0.;
                        });
  system.assemble_tangent(body.state, body.boundary, x, residual);
  const auto energies = energies_of(system, body, x);
  const auto update   = system.update_points(body.state, x);
  double     error    = 0.;
  for (unsigned int q = 0; q < body.points.n_points(); ++q)
    {
      const bool           up = above(body.points.location(q));
      const Tensor<2, dim> F =
        up ? R : Tensor<2, dim>(unit_symmetric_tensor<dim>());
      const Tensor<1, dim> u =
        up ? motion(body.points.location(q)) : Tensor<1, dim>();
      error = std::max({error,
                        (update.F[q] - F).norm(),
                        (update.displacement_increment[q] - u).norm()});
    }
  // Relative to the stiffness.
  const double stiffness = system.matrix().frobenius_norm();
  deallog << "  motion "
          << verdict(Utilities::MPI::max(error, MPI_COMM_WORLD), 1e-11)
          << ", energy "
          << verdict(std::abs(energies.elastic) + std::abs(energies.penalty),
                     1e-12)
          << ", force " << verdict(residual.l2_norm() / stiffness, 1e-12);

  // A translation, and a rotation of the moved half, are in the null space.
  double force = 0.;
  for (unsigned int mode = 0; mode < dim + 1; ++mode)
    {
      body.set_coefficients(v,
                            dim,
                            [&](const FunctionKey<dim> &key,
                                const Point<dim>       &y,
                                const unsigned int      c) {
                              if (!function_above(key))
                                return 0.;
                              if (mode < dim)
                                return c == mode ? 1. : 0.;
                              const Tensor<1, dim> z = t + R * y;
                              return c == 0 ? -z[1] : c == 1 ? z[0] : 0.;
                            });
      system.matrix().vmult(w, v);
      force = std::max(force, w.l2_norm() / stiffness);
    }
  deallog << ", stiffness " << verdict(force, 1e-11);

  // The tangent is right for the groups that read twins, too.
  LA::FieldVector plus = x, minus = x;
  body.scatter_coefficients(v, dim, 1);
  x.add(0.01, v);
  system.assemble_tangent(body.state, body.boundary, x, residual);
  body.scatter_coefficients(v, dim, 2);
  system.matrix().vmult(w, v);
  LA::FieldVector x_plus = x, x_minus = x;
  const double    epsilon = 1e-6;
  x_plus.add(epsilon, v);
  x_minus.add(-epsilon, v);
  system.assemble_residual(body.state, body.boundary, x_plus, plus);
  system.assemble_residual(body.state, body.boundary, x_minus, minus);
  plus -= minus;
  plus /= 2. * epsilon;
  plus -= w;
  deallog << ", tangent " << verdict(plus.l2_norm() / w.l2_norm(), 1e-6)
          << std::endl
          << "    norm " << digits(system.matrix().frobenius_norm())
          << ", form " << digits(v * w) << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  for (const double plane : {0., 0.5, 0.21})
    {
      test<2>(1, plane);
      test<2>(2, plane);
      test<2>(3, plane);
    }
  test<3>(2, 0.5);
}
