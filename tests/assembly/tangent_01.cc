// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The tangent of DisplacementSystem is the derivative of its residual, and the
// residual that of the energy: for all materials, with Nitsche terms in some
// components, tractions, a deformed configuration at the start of the step, and
// damage.
// The matrix of DamageSystem is the second derivative of the energy that it
// minimises. Both are symmetric, and the same on any number of processes.

#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/assembly/boundary_resultants.h>
#include <ebsmpm/assembly/damage_system.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <memory>

#include "../tests.h"

#include "point_setup.h"



template <int dim>
std::unique_ptr<Body<dim>>
make_body();

template <>
std::unique_ptr<Body<2>>
make_body<2>()
{
  return std::make_unique<PolygonBody>(
    PolygonBody::rotated_square(0.4, Point<2>(0.03, -0.01)));
}

template <>
std::unique_ptr<Body<3>>
make_body<3>()
{
  return std::make_unique<BoxBody<3>>(Point<3>(-.5, -.43, -.5),
                                      Point<3>(.37, .5, .41));
}



/** Some state that nothing is special about. */
template <int dim>
void
disturb(BodyOnGrid<dim> &body)
{
  const auto F = [](const Point<dim> &x) {
    Tensor<2, dim> F = unit_symmetric_tensor<dim>();
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] += 0.1 * scatter(x, dim * i + j);
    return F;
  };
  for (unsigned int q = 0; q < body.points.n_points(); ++q)
    {
      const Point<dim> &x   = body.points.location(q);
      body.state.F[q]       = F(x);
      body.state.damage[q]  = 0.4 + 0.4 * scatter(x, 11);
      body.state.history[q] = 1. + scatter(x, 12);
    }
  for (unsigned int q = 0; q < body.boundary_points.n_points(); ++q)
    {
      const Point<dim> &x     = body.boundary_points.location(q);
      body.boundary.F[q]      = F(x);
      body.boundary.damage[q] = 0.4 + 0.4 * scatter(x, 11);
      for (unsigned int d = 0; d < dim; ++d)
        {
          body.boundary.displacement[q][d] = 0.1 * scatter(x, 20 + d);
          body.boundary.prescribed[q][d]   = 0.1 * scatter(x, 30 + d);
          body.boundary.traction[q][d]     = 5. * scatter(x, 40 + d);
        }
      // All components on one edge, none on another, an oblique direction on
      // the third, one component on the others.
      const unsigned int       id = body.boundary.boundary_id[q];
      SymmetricTensor<2, dim> &Pi = body.boundary.projection[q];
      Tensor<1, dim>           oblique;
      for (unsigned int d = 0; d < dim; ++d)
        oblique[d] = d + 1.;
      Pi = 0.;
      if (id == 0)
        Pi = unit_symmetric_tensor<dim>();
      else if (id == 2)
        Pi =
          symmetrize(outer_product(oblique, oblique)) / oblique.norm_square();
      else if (id > 2)
        Pi[id % dim][id % dim] = 1.;
    }
}



template <int dim>
double
energy(const DisplacementSystem<dim> &system,
       const BodyOnGrid<dim>         &body,
       const LA::FieldVector         &increment)
{
  const auto update   = system.update_points(body.boundary, increment);
  const auto energies = energies_of(system, body, increment);
  return energies.elastic + energies.penalty -
         BoundaryResultants::traction_work<dim>(body.boundary,
                                                update,
                                                MPI_COMM_WORLD);
}



/** The quadratic form of a matrix. */
double
product(const LA::SparseMatrix &matrix,
        const LA::FieldVector  &v,
        const LA::FieldVector  &w)
{
  LA::FieldVector Aw = v;
  Aw                 = 0.;
  matrix.vmult(Aw, w);
  return v * Aw;
}



template <int dim>
void
test_displacement(BodyOnGrid<dim> &body, const Material<dim> &material)
{
  const Degradation       degradation(1e-4);
  DisplacementSystem<dim> system(material, degradation, 100.);
  body.reinit(system);

  LA::FieldVector x = system.make_vector(), residual = x, v = x, w = x;
  LA::FieldVector plus = x, minus = x, Kv = x;
  body.scatter_coefficients(x, dim, 1);
  x *= (body.space.degree() < 3 ? 0.02 : 0.002);
  system.assemble_tangent(body.state, body.boundary, x, residual);
  const LA::SparseMatrix &K = system.matrix();

  LA::FieldVector same = residual;
  system.assemble_residual(body.state, body.boundary, x, same);
  same -= residual;
  const double difference = same.l2_norm() / residual.l2_norm();

  double tangent_error = 0., residual_error = 0., asymmetry = 0.;
  for (unsigned int direction = 0; direction < 3; ++direction)
    {
      body.scatter_coefficients(v, dim, 2 + direction);
      body.scatter_coefficients(w, dim, 7 + direction);

      const double    epsilon = (body.space.degree() < 3 ? 2e-6 : 2e-7);
      LA::FieldVector x_plus = x, x_minus = x;
      x_plus.add(epsilon, v);
      x_minus.add(-epsilon, v);
      system.assemble_residual(body.state, body.boundary, x_plus, plus);
      system.assemble_residual(body.state, body.boundary, x_minus, minus);
      plus -= minus;
      plus /= 2. * epsilon;
      K.vmult(Kv, v);
      const double norm = Kv.l2_norm();
      plus -= Kv;
      tangent_error = std::max(tangent_error, plus.l2_norm() / norm);

      const double slope =
        (energy(system, body, x_plus) - energy(system, body, x_minus)) /
        (2. * epsilon);
      residual_error =
        std::max(residual_error,
                 std::abs(slope - v * residual) / std::abs(v * residual));

      asymmetry = std::max(asymmetry,
                           std::abs(product(K, v, w) - product(K, w, v)) /
                             (norm * w.l2_norm()));
    }

  deallog << "  " << material.name() << ", split "
          << static_cast<int>(material.energy_split()) << ": tangent "
          << verdict(tangent_error, 1e-6) << ", residual "
          << verdict(residual_error, 1e-6) << ", alone "
          << verdict(difference, 1e-12) << ", symmetry "
          << verdict(asymmetry, 1e-12) << std::endl
          << "    norm " << digits(K.frobenius_norm()) << ", form "
          << digits(product(K, v, w)) << ", residual "
          << digits(residual.l2_norm()) << ", energy "
          << digits(energy(system, body, x)) << std::endl;
}



template <int dim>
void
test_damage(BodyOnGrid<dim> &body)
{
  const double      Gc = 0.3, l = 0.1;
  DamageSystem<dim> system(Gc, l);
  body.reinit(system);
  LA::FieldVector d = system.make_vector(), rhs = d, v = d, w = d, Av = d;
  body.scatter_coefficients(d, 1, 1);
  body.scatter_coefficients(v, 1, 2);
  body.scatter_coefficients(w, 1, 3);

  // The driving factor makes the matrix indefinite where it is positive.
  std::vector<double> driving(body.boundary_points.n_points());
  for (unsigned int q = 0; q < driving.size(); ++q)
    driving[q] = 0.1 * scatter(body.boundary_points.location(q), 3);

  for (const bool with_boundary : {false, true})
    {
      system.assemble(body.state,
                      body.boundary,
                      with_boundary ? driving : std::vector<double>(),
                      rhs);
      const LA::SparseMatrix &A = system.matrix();

      // The energy whose derivative is A d - b.
      const auto energy = [&](const LA::FieldVector &d) {
        std::vector<double> at_points, at_boundary_points;
        system.evaluate(d, at_points, at_boundary_points);
        double sum = 0.;
        for (unsigned int q = 0; q < at_points.size(); ++q)
          sum += body.state.volume[q] * std::pow(1. - at_points[q], 2) *
                 body.state.history[q];
        if (with_boundary)
          for (unsigned int q = 0; q < driving.size(); ++q)
            sum -= body.boundary.area[q] *
                   std::pow(1. - at_boundary_points[q], 2) * driving[q];
        return Utilities::MPI::sum(sum, body.space.communicator()) +
               Gc * system.crack_area(body.state, d);
      };
      LA::FieldVector plus = d, minus = d;
      plus += v;
      minus -= v;
      A.vmult(Av, d);
      Av -= rhs;
      // The energy is quadratic, so differences are exact.
      const double slope     = 0.5 * (energy(plus) - energy(minus));
      const double curvature = energy(plus) - 2. * energy(d) + energy(minus);
      deallog << "  damage, boundary term " << with_boundary << ": slope "
              << verdict(std::abs(slope - v * Av) / std::abs(slope), 1e-9)
              << ", curvature "
              << verdict(std::abs(curvature - product(A, v, v)) / curvature,
                         1e-9)
              << ", symmetry "
              << verdict(std::abs(product(A, v, w) - product(A, w, v)) /
                           A.frobenius_norm(),
                         1e-12)
              << std::endl
              << "    norm " << digits(A.frobenius_norm()) << ", form "
              << digits(product(A, v, w)) << ", right hand side "
              << digits(rhs.l2_norm()) << std::endl;
    }
}



template <int dim>
void
test(const unsigned int degree)
{
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  const unsigned int                        n = (dim == 2 ? 5 : 3);
  GridGenerator::subdivided_hyper_cube(triangulation, n, -0.83, 0.83);
  triangulation.refine_global(1);

  BodyOnGrid<dim> body(triangulation, *make_body<dim>(), degree, degree + 1);
  body.make_space(0.1);
  disturb(body);
  deallog << dim << "-D, degree " << degree << ": " << body.space.n_functions()
          << " functions, " << body.space.n_deficient() << " deficient"
          << std::endl;

  for (const auto split :
       {EnergySplit::volumetric_deviatoric, EnergySplit::none})
    for (const auto name : {"neo-Hookean", "linear elastic"})
      test_displacement(body, *make_material<dim>(name, split, 3., 1.));
  test_damage(body);
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  test<2>(2);
  test<2>(3);
  test<3>(1);
  test<3>(2);
}
