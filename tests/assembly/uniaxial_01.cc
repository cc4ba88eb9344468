// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// A bar under uniaxial strain with damage, so small against the length scale of
// the damage that this stays uniform: stress and damage follow the closed form
//   d = H / (H + Gc/(2l)),   P = g(d) P_0(F),   H = Psi_0^+(F),
// while the points move and cross grid lines. Damage and displacement are
// solved for in turns, as in the staggered scheme.

#include <ebsmpm/materials/elastic_constants.h>
#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/assembly/damage_system.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <memory>

#include "../tests.h"

#include "point_setup.h"

// kN and mm.
constexpr double Gc = 2.7e-3, l = 0.015;



/** Damage and stress of the closed form at the stretch lambda. */
template <int dim>
std::pair<double, double>
closed_form(const Material<dim> &material, const double lambda)
{
  Tensor<2, dim> F = unit_symmetric_tensor<dim>(), P;
  F[0][0]          = lambda;
  double H, intact;
  material.energies(F, H, intact);
  const double d = H / (H + Gc / (2. * l));
  material.stress(F, (1. - d) * (1. - d), P);
  return {d, P[0][0]};
}



/**
 * Pull a bar of which the right end begins at 'end', in cells, and move it by
 * 'drift' cells on the way.
 */
template <int dim>
void
test(const unsigned int degree,
     const double       end,
     const double       drift,
     const unsigned int n_points,
     const double       bound)
{
  const double       h     = 1e-4;
  const unsigned int n     = (dim == 2 ? 12 : 7);
  const double       width = (dim == 2 ? 3.4 : 2.4);

  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  std::vector<unsigned int>                 repetitions(dim, 6);
  Point<dim>                                corner, a, b;
  repetitions[0] = n;
  for (unsigned int d = 0; d < dim; ++d)
    {
      corner[d] = repetitions[d] * h;
      a[d]      = 1.2 * h;
      b[d]      = (1.2 + width) * h;
    }
  b[0] = end * h;
  GridGenerator::subdivided_hyper_rectangle(triangulation,
                                            repetitions,
                                            Point<dim>(),
                                            corner);

  const auto material =
    make_material<dim>("neo-Hookean",
                       EnergySplit::volumetric_deviatoric,
                       ElasticConstants::bulk_modulus(210., 0.3),
                       ElasticConstants::shear_modulus(210., 0.3));
  const Degradation       degradation(1e-4);
  DisplacementSystem<dim> displacement(*material,
                                       degradation,
                                       20. * material->nitsche_stiffness() / h);
  DamageSystem<dim>       damage(Gc, l);

  auto   body = std::make_unique<BodyOnGrid<dim>>(triangulation,
                                                BoxBody<dim>(a, b),
                                                degree,
                                                n_points);
  double area = 1.;
  for (unsigned int d = 1; d < dim; ++d)
    area *= b[d] - a[d];

  const unsigned int n_steps      = 20;
  double             stress_error = 0., damage_error = 0., end_error = 0.;
  const auto [peak_damage, peak] = closed_form(*material, 1.01455);
  unsigned int n_classes = 0, last_independent = 0;
  // The reference positions of the boundary points.
  const auto reference = [&](const unsigned int q) {
    return body->boundary_points.location(q) - body->boundary.displacement[q];
  };

  for (unsigned int step = 1; step <= n_steps; ++step)
    {
      // The last step but five is the peak.
      const double lambda = 1. + 0.01455 * step / 15.;
      for (unsigned int q = 0; q < body->boundary_points.n_points(); ++q)
        {
          const unsigned int face      = body->boundary.boundary_id[q];
          body->boundary.projection[q] = 0.;
          body->boundary.projection[q][face / 2][face / 2] = 1.;
          const Point<dim> X                               = reference(q);
          body->boundary.prescribed[q]                     = Tensor<1, dim>();
          body->boundary.prescribed[q][0] =
            (lambda - 1.) * (X[0] - a[0]) + drift * h * step / n_steps;
        }
      body->make_space(0.1);
      if (body->space.n_independent() != last_independent)
        ++n_classes;
      last_independent = body->space.n_independent();
      body->reinit(displacement);
      body->reinit(damage);

      LA::FieldVector           u = displacement.make_vector(), residual = u;
      LA::FieldVector           du = u, d = damage.make_vector(), rhs = d;
      const std::vector<double> old_history = body->state.history;
      double                    change      = 1.;
      for (unsigned int pass = 0; pass < 50 && change > 1e-9; ++pass)
        {
          for (unsigned int iteration = 0; iteration < 10; ++iteration)
            {
              displacement.assemble_tangent(body->state,
                                            body->boundary,
                                            u,
                                            residual);
              du = 0.;
              solve_directly(displacement.matrix(), du, residual);
              u -= du;
              if (du.linfty_norm() < 1e-10 * h)
                break;
            }
          std::vector<double> driving;
          displacement.driving_energy(displacement.update_points(body->state,
                                                                 u),
                                      driving);
          for (unsigned int q = 0; q < driving.size(); ++q)
            body->state.history[q] = std::max(old_history[q], driving[q]);
          damage.assemble(body->state, body->boundary, {}, rhs);
          solve_directly(damage.matrix(), d, rhs);
          const std::vector<double> old_damage = body->state.damage;
          damage.evaluate(d, body->state.damage, body->boundary.damage);
          change = 0.;
          for (unsigned int q = 0; q < old_damage.size(); ++q)
            change =
              std::max(change, std::abs(old_damage[q] - body->state.damage[q]));
        }
      if (change > 1e-9)
        deallog << "FAILED, the passes do not converge" << std::endl;

      const auto [d_exact, P_exact] = closed_form(*material, lambda);
      const auto reactions =
        reactions_of(displacement, *body, u, {0, 1, 2, 3, 4, 5});
      const double right = reactions.at(1)[0] / area;
      const double left  = -reactions.at(0)[0] / area;
      stress_error = std::max(stress_error, std::abs(right - P_exact) / peak);
      end_error    = std::max(end_error, std::abs(left - right) / peak);
      for (const double value : body->state.damage)
        damage_error = std::max(damage_error, std::abs(value - d_exact));

      if (step < n_steps)
        body = move_body(*body, displacement, u);
    }

  deallog << dim << "-D, degree " << degree << ", end at " << end
          << " h, drift " << drift << " h, " << n_points << " points, "
          << n_classes
          << " different spaces: closed form P = " << digits(peak, 6)
          << " at d = " << digits(peak_damage, 6) << std::endl
          << "  within " << bound << ": stress " << verdict(stress_error, bound)
          << ", damage " << verdict(damage_error, bound)
          << ", both ends the same " << verdict(end_error, 1e-8) << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  initlog();

  // Errors relative to the peak. They come from the points, which are no longer
  // a quadrature rule once they have moved; the gradient of linear functions
  // even jumps where they cross a grid line.
  test<2>(1, 8.9, 0., 4, 0.02);
  test<2>(2, 8.9, 0., 4, 1e-4);
  test<2>(3, 8.9, 0., 4, 1e-4);
  test<3>(2, 4.95, 0., 3, 1e-4);
  test<2>(2, 8.9, 1.3, 3, 3e-4);
  test<2>(2, 8.9, 1.3, 4, 2e-4);
  test<2>(2, 8.9, 1.3, 5, 1e-4);
}
