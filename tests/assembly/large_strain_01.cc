// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// A square that is turned against the grid, and a cube, are stretched and
// sheared by 20 per cent in two load steps, one side being held and the
// opposite one moved by Nitsche's method. Newton's method converges
// quadratically. Reactions are in balance, they are equal to the internal
// virtual work of a field that is one on the moved side, and they are the
// derivative of the energy with respect to the displacement prescribed.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/make_material.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <memory>

#include "../tests.h"

#include "point_setup.h"



/** The problem: which sides, and where the body lies. */
template <int dim>
struct Setup;

template <>
struct Setup<2>
{
  static constexpr types::boundary_id held = 0, moved = 2;
  PolygonBody                         body = PolygonBody::rotated_square(0.4);
  Tensor<1, 2>                        along{{-std::sin(0.4), std::cos(0.4)}};
  Tensor<1, 2>                        load{{0.03, 0.2}};
  unsigned int                        n_coarse = 4, n_refinements = 2;
};

template <>
struct Setup<3>
{
  static constexpr types::boundary_id held = 4, moved = 5;
  BoxBody<3>   body{Point<3>(-.5, -.5, -.5), Point<3>(.5, .5, .5)};
  Tensor<1, 3> along{{0., 0., 1.}};
  Tensor<1, 3> load{{0.1, 0.02, 0.2}};
  unsigned int n_coarse = 5, n_refinements = 0;
};



/** Solve by Newton's method; return the norms of the residuals. */
template <int dim>
std::vector<double>
newton(DisplacementSystem<dim> &system,
       const BodyOnGrid<dim>   &body,
       LA::FieldVector         &x)
{
  LA::FieldVector     residual = x, step = x;
  std::vector<double> norms;
  for (unsigned int iteration = 0; iteration < 20; ++iteration)
    {
      system.assemble_tangent(body.state, body.boundary, x, residual);
      norms.push_back(residual.l2_norm());
      if (norms.back() < 1e-12 * norms.front())
        return norms;
      step = 0.;
      solve_directly(system.matrix(), step, residual);

      // Go less far if the residual grows or cannot be computed.
      for (double length = 1.; length > 0.1; length *= 0.5)
        {
          LA::FieldVector y = x;
          y.add(-length, step);
          try
            {
              system.assemble_residual(body.state, body.boundary, y, residual);
              if (residual.l2_norm() < norms.back() || length < 0.3)
                {
                  x = y;
                  break;
                }
            }
          catch (const ExcSolverFailure &)
            {}
        }
    }
  deallog << "FAILED, no convergence" << std::endl;
  return norms;
}



template <int dim>
void
test(const bool with_damage)
{
  const Setup<dim>                          setup;
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation,
                                       setup.n_coarse,
                                       -1.03,
                                       1.03);
  triangulation.refine_global(setup.n_refinements);
  const auto        material = make_material<dim>("neo-Hookean",
                                           EnergySplit::volumetric_deviatoric,
                                           2.,
                                           1.);
  const Degradation degradation(1e-4);
  auto              body =
    std::make_unique<BodyOnGrid<dim>>(triangulation, setup.body, 2, 3);
  const double h = body->space.lattice().cell_extents(setup.n_refinements)[0];
  DisplacementSystem<dim> system(*material,
                                 degradation,
                                 20. * material->nitsche_stiffness() / h);

  // The field that is one on the moved side, and zero on the one that is held,
  // at the beginning of the first step.
  const auto ramp = [&](const Point<dim> &x) { return setup.along * x + 0.5; };

  for (unsigned int q = 0; q < body->boundary_points.n_points(); ++q)
    {
      const auto id = body->boundary.boundary_id[q];
      if (id != setup.held && id != setup.moved)
        body->boundary.projection[q] = 0.;
      if (with_damage)
        body->boundary.damage[q] =
          0.4 + 0.3 * scatter(body->boundary_points.location(q), 1, 3.);
    }
  if (with_damage)
    for (unsigned int q = 0; q < body->points.n_points(); ++q)
      body->state.damage[q] =
        0.4 + 0.3 * scatter(body->points.location(q), 1, 3.);

  for (unsigned int step = 0; step < 2; ++step)
    {
      const auto set_load = [&](const double factor) {
        for (unsigned int q = 0; q < body->boundary_points.n_points(); ++q)
          if (body->boundary.boundary_id[q] == setup.moved)
            body->boundary.prescribed[q] = factor * setup.load;
      };
      // The tangent is indefinite at the beginning if a side moves by about a
      // cell and the damage varies from cell to cell. So it moves less then.
      const double factor = (with_damage ? 0.15 : 0.5) * (step + 1);
      set_load(factor);
      body->make_space(0.1);
      body->reinit(system);
      LA::FieldVector x     = system.make_vector();
      const auto      norms = newton(system, *body, x);

      // The order is measured where it can be: near the solution, but not
      // where roundoff rules.
      double order = 0.;
      for (unsigned int k = 1; k + 1 < norms.size(); ++k)
        if (norms[k] < 0.1 * norms[0] && norms[k + 1] > 1e-12 * norms[0])
          order = std::log(norms[k + 1] / norms[k]) /
                  std::log(norms[k] / norms[k - 1]);
      deallog << dim << "-D, " << (with_damage ? "with" : "without")
              << " damage, step " << step + 1 << ": " << norms.size() - 1
              << " iterations, quadratic " << verdict(1.5 - order, 0.)
              << std::endl;

      const auto ids = std::vector<types::boundary_id>({0, 1, 2, 3, 4, 5});
      auto       reactions     = reactions_of(system, *body, x, ids);
      const Tensor<1, dim> top = reactions[setup.moved];
      deallog << "  reactions";
      for (unsigned int d = 0; d < dim; ++d)
        deallog << ' ' << digits(top[d], 6);
      deallog << ", balance "
              << verdict((top + reactions[setup.held]).norm() / top.norm(),
                         1e-8);

      // The internal virtual work, computed without the help of the system,
      // less what the boundary points that are to follow contribute by their
      // variation of the traction.
      if (step == 0)
        {
          const auto     update   = system.update_points(body->state, x);
          const auto     boundary = system.update_points(body->boundary, x);
          Tensor<1, dim> work;
          for (unsigned int q = 0; q < body->points.n_points(); ++q)
            {
              Tensor<2, dim> P;
              material->stress(update.F[q],
                               degradation.value(body->state.damage[q]),
                               P);
              work += body->state.volume[q] *
                      (P * transpose(body->state.F[q]) * setup.along);
            }
          for (unsigned int q = 0; q < body->boundary_points.n_points(); ++q)
            if (body->boundary.projection[q].norm() > 0.)
              {
                typename Material<dim>::Response response;
                material->response(boundary.F[q],
                                   degradation.value(body->boundary.damage[q]),
                                   response);
                const Tensor<1, dim> w = body->boundary.displacement[q] +
                                         boundary.displacement_increment[q] -
                                         body->boundary.prescribed[q];
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int J = 0; J < dim; ++J)
                    for (unsigned int k = 0; k < dim; ++k)
                      for (unsigned int L = 0; L < dim; ++L)
                        work[k] -= body->boundary.area[q] * w[i] *
                                   response.A[i][J][k][L] * setup.along[L] *
                                   body->boundary.normal[q][J];
                AssertThrow(std::abs(ramp(body->boundary_points.location(q)) -
                                     (body->boundary.boundary_id[q] ==
                                      setup.moved)) < 1e-12,
                            ExcInternalError());
              }
          deallog << ", virtual work "
                  << verdict((work - top).norm() / top.norm(), 1e-8);
        }

      // The derivative of the energy along the load path, by differences of
      // fourth order.
      const auto energy = [&](const double factor) {
        set_load(factor);
        LA::FieldVector y = x;
        newton(system, *body, y);
        const auto e = energies_of(system, *body, y);
        return e.elastic + e.penalty;
      };
      const double epsilon = 0.01;
      const double slope =
        (8. * (energy(factor + epsilon) - energy(factor - epsilon)) -
         (energy(factor + 2. * epsilon) - energy(factor - 2. * epsilon))) /
        (12. * epsilon);
      deallog << ", derivative of the energy "
              << verdict(std::abs(slope - top * setup.load) / std::abs(slope),
                         1e-7)
              << std::endl;

      set_load(factor);
      body = move_body(*body, system, x);
    }
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  initlog();

  test<2>(false);
  test<2>(true);
  test<3>(false);
}
