// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Three blocks that do not touch: one is clamped, one stands on rollers, and
// one is held by nothing. Their pieces, and the static problem that the mass of
// the free ones makes solvable: blocks follow where they are held, without
// stress, as the mass is in the other directions only.

#include <ebsmpm/lac/linear_solver.h>

#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/particles/boundary_points.h>
#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/material_points.h>
#include <ebsmpm/particles/shape_parser.h>

#include <ebsmpm/solvers/newton_solver.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include "../tests.h"

#include "point_setup.h"



template <int dim>
void
test(const std::string &blocks)
{
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 24, -0.1, 2.3);
  MappingCartesian<dim> mapping;
  MaterialPoints<dim>   material_points(triangulation, mapping);
  BoundaryPoints<dim>   boundary_material_points(triangulation, mapping);

  const auto                    shape = parse_shape<dim>(blocks);
  PointGenerator::FillData<dim> fill;
  fill.n_points_per_direction = 2;
  PointGenerator::fill(*shape, fill, material_points);
  PointGenerator::boundary<dim>(*shape,
                                {{0, "x < 0.5 && y < 1e-9"},
                                 {1, "x < 1.5 && y < 1e-9"}},
                                0.05,
                                boundary_material_points);

  SplineSpace<dim>          space(triangulation, 2);
  AffineConstraints<double> constraints;
  CellPoints<dim>           points, boundary_points;
  points.reinit(material_points.handler(), space.lattice());
  boundary_points.reinit(boundary_material_points.handler(), space.lattice());

  MaterialState<dim> state;
  state.resize(points.n_points());
  for (unsigned int q = 0; q < points.n_points(); ++q)
    {
      state.volume[q] =
        MaterialPoint<dim>(points.properties(q)).reference_volume();
      state.F[q] = unit_symmetric_tensor<dim>();
    }
  // Block 0 is clamped and pushed sideways, block 1 is on rollers and lifted.
  constexpr double   push = 0.01, lift = 0.0005;
  BoundaryState<dim> boundary;
  boundary.resize(boundary_points.n_points());
  for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
    {
      const BoundaryPoint<dim> point(boundary_points.properties(q));
      boundary.area[q]        = point.reference_area();
      boundary.normal[q]      = point.reference_normal();
      boundary.F[q]           = unit_symmetric_tensor<dim>();
      boundary.boundary_id[q] = point.boundary_id();
      boundary.projection[q]  = 0.;
      if (point.boundary_id() == 0)
        boundary.projection[q] = unit_symmetric_tensor<dim>();
      boundary.projection[q][1][1] = 1.;
      if (point.boundary_id() == 0)
        boundary.prescribed[q][0] = push;
      else
        boundary.prescribed[q][1] = lift;
    }

  typename SplineSpace<dim>::SupportTable supports;
  add_supports<dim>(points, state.volume, {}, space, supports);
  add_supports<dim>(boundary_points, {}, {}, space, supports);
  space.reinit(supports, 0.1);
  make_extension_constraints(space, constraints);

  const auto              material = make_material<dim>("neo-Hookean",
                                           EnergySplit::volumetric_deviatoric,
                                           3.,
                                           1.);
  const Degradation       degradation(1e-4);
  DisplacementSystem<dim> system(*material,
                                 degradation,
                                 20. * material->nitsche_stiffness() / 0.1);
  system.reinit(points, boundary_points, space, constraints, {}, {});
  system.hold_free_pieces(state, boundary);
  for (const auto &piece : system.pieces().pieces())
    deallog << dim << "-D: a piece of volume " << piece.volume << " with "
            << piece.n_free_motions << " free motions" << std::endl;
  deallog << "  " << system.pieces().n_free() << " of them are free"
          << std::endl;

  NewtonSolver::Problem problem;
  problem.residual = [&](const LA::FieldVector &x, LA::FieldVector &r) {
    system.assemble_residual(state, boundary, x, r);
  };
  problem.tangent = [&](const LA::FieldVector &x, LA::FieldVector &r) {
    system.assemble_tangent(state, boundary, x, r);
  };
  problem.matrix = [&]() -> const LA::SparseMatrix & {
    return system.matrix();
  };
  LinearSolver       linear_solver{LinearSolver::AdditionalData()};
  const NewtonSolver newton{NewtonSolver::AdditionalData()};
  LA::FieldVector    u = system.make_vector();
  newton.solve(problem, linear_solver, 1., 1e-10, u);
  const auto moved = system.update_points(state, u);

  // At equilibrium. Before, block 1 is where the conditions do not want it.
  LA::FieldVector residual = system.make_vector();
  system.assemble_tangent(state, boundary, u, residual);
  const bool indefinite = linear_solver.is_found_indefinite(system.matrix());
  std::array<double, 3> errors{};
  for (unsigned int q = 0; q < points.n_points(); ++q)
    {
      const double       x     = points.location(q)[0];
      const unsigned int block = x < 0.5 ? 0 : x < 1.5 ? 1 : 2;
      Tensor<1, dim>     expected;
      expected[0] = (block == 0 ? push : 0.);
      expected[1] = (block == 1 ? lift : 0.);
      errors[block] =
        std::max(errors[block],
                 (moved.displacement_increment[q] - expected).norm());
    }
  deallog << "  definite " << (indefinite ? "FAILED" : "OK");
  for (const double error : errors)
    deallog << ", motion "
            << verdict(Utilities::MPI::max(error, MPI_COMM_WORLD), 1e-9);
  deallog << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  test<2>(
    "box(0,0, 0.3,0.8) + box(0.9,0, 1.18,0.6) + box(1.83,0.31, 2.12,0.9)");
  test<3>("box(0,0,0, 0.3,0.4,0.3) + box(0.9,0,0, 1.18,0.3,0.3) +"
          " box(1.83,0.31,0, 2.12,0.6,0.3)");
}
