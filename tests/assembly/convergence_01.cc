// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Orders of convergence on a unit square that is turned by 0.4 against the
// grid: linear elasticity with manufactured displacement and Nitsche's
// conditions on all edges, and the damage equation with a manufactured damage
// whose normal derivative is zero. And a linear displacement is exact, also if
// only its normal component is prescribed, and the traction along the edges.
//
// The elasticity converges with h^(p+1) in the L2 norm and with h^p in the
// energy norm, and so does the damage.

#include <ebsmpm/materials/linear_elastic.h>

#include <ebsmpm/assembly/damage_system.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include "../tests.h"

#include "point_setup.h"

constexpr double angle = 0.4;
constexpr double K = 1.25, G = 1.;

/** Penalty in units of (K+4G/3)/h; see conditioning_01. */
constexpr double penalty_factor = 20.;



/** A function, its gradient and its second derivatives. */
struct Jet
{
  double       value;
  Tensor<1, 2> gradient;
  Tensor<2, 2> hessian;
};

/** The manufactured displacement: a sine in an oblique direction. */
Jet
displacement(const unsigned int component, const Point<2> &x)
{
  const Tensor<1, 2> k =
    component == 0 ? Tensor<1, 2>({2.1, 1.3}) : Tensor<1, 2>({1.1, -2.3});
  const double phase = k * x + (component == 0 ? 0.4 : 1.2);
  Jet          result;
  result.value    = 0.1 * std::sin(phase);
  result.gradient = 0.1 * std::cos(phase) * k;
  result.hessian  = -0.1 * std::sin(phase) * outer_product(k, k);
  return result;
}



/** The body force that goes with it. */
class BodyForce : public TensorFunction<1, 2>
{
public:
  virtual Tensor<1, 2>
  value(const Point<2> &x) const override
  {
    const double lambda = K - 2. / 3. * G;
    Tensor<1, 2> force;
    const Jet    u[2] = {displacement(0, x), displacement(1, x)};
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        force[i] -= G * u[i].hessian[j][j] + (lambda + G) * u[j].hessian[i][j];
    return force;
  }
};



/** Errors in the L2 norm and in the L2 norm of the gradient. */
struct Errors
{
  double value;
  double gradient;
};

template <int n_components>
Errors
compute_errors(const BodyOnGrid<2>                                      &body,
               const PointGroups<2>                                     &groups,
               const LA::FieldVector                                    &field,
               const std::function<Jet(unsigned int, const Point<2> &)> &exact)
{
  Errors errors = {0., 0.};
  field.update_ghost_values();
  evaluate_field<n_components>(
    body.points,
    groups,
    body.space.lattice(),
    body.space.degree(),
    field,
    [&](const unsigned int                            q,
        const Tensor<1, n_components>                &value,
        const std::array<Tensor<1, 2>, n_components> &gradient) {
      for (unsigned int a = 0; a < n_components; ++a)
        {
          const Jet jet = exact(a, body.points.location(q));
          errors.value +=
            body.state.volume[q] * std::pow(value[a] - jet.value, 2);
          errors.gradient +=
            body.state.volume[q] * (gradient[a] - jet.gradient).norm_square();
        }
    });
  return {std::sqrt(errors.value), std::sqrt(errors.gradient)};
}



enum class Problem
{
  elasticity,
  patch,
  sliding_patch
};

Errors
solve_elasticity(BodyOnGrid<2> &body, const Problem problem)
{
  const LinearElastic<2> material(K, G, EnergySplit::none);
  const Degradation      degradation(1e-4);
  const double           h =
    body.space.lattice().cell_extents(body.points.cells()[0].level)[0];
  DisplacementSystem<2> system(
    material, degradation, penalty_factor * material.nitsche_stiffness() / h);
  body.reinit(system);

  const auto exact = [problem](const unsigned int a, const Point<2> &x) -> Jet {
    if (problem == Problem::elasticity)
      return displacement(a, x);
    Jet result;
    result.gradient =
      a == 0 ? Tensor<1, 2>({0.1, 0.03}) : Tensor<1, 2>({-0.07, 0.05});
    result.value = 0.2 + result.gradient * x;
    return result;
  };
  for (unsigned int q = 0; q < body.boundary_points.n_points(); ++q)
    {
      const Jet u[2]              = {exact(0, body.boundary_points.location(q)),
                                     exact(1, body.boundary_points.location(q))};
      body.boundary.prescribed[q] = Tensor<1, 2>({u[0].value, u[1].value});
      if (problem == Problem::sliding_patch)
        {
          const Tensor<1, 2>         &N = body.boundary.normal[q];
          const Tensor<1, 2>          t({-N[1], N[0]});
          const SymmetricTensor<2, 2> strain =
            symmetrize(Tensor<2, 2>({{u[0].gradient[0], u[0].gradient[1]},
                                     {u[1].gradient[0], u[1].gradient[1]}}));
          body.boundary.projection[q] = symmetrize(outer_product(N, N));
          body.boundary.traction[q]   = 2. * G * (t * (strain * N)) * t;
        }
    }

  LA::FieldVector u = system.make_vector(), residual = u;
  system.assemble_tangent(body.state, body.boundary, u, residual);
  if (problem == Problem::elasticity)
    system.add_body_force(body.state, BodyForce(), residual);
  solve_directly(system.matrix(), u, residual);
  u *= -1.;
  return compute_errors<2>(body, system.groups(), u, exact);
}



Errors
solve_damage(BodyOnGrid<2> &body)
{
  const double Gc = 1., l = 0.1;
  const auto   exact = [](const unsigned int, const Point<2> &x) {
    // cos(pi xi) cos(2 pi eta) in the coordinates of the square.
    const Tensor<1, 2> e({std::cos(angle), std::sin(angle)});
    const Tensor<1, 2> f({-std::sin(angle), std::cos(angle)});
    const double       a = numbers::PI, b = 2. * numbers::PI;
    const double       s = a * (e * x + 0.5), t = b * (f * x + 0.5);
    Jet                jet;
    jet.value    = 0.3 + 0.2 * std::cos(s) * std::cos(t);
    jet.gradient = -0.2 * (a * std::sin(s) * std::cos(t) * e +
                           b * std::cos(s) * std::sin(t) * f);
    // Only the trace is needed.
    jet.hessian[0][0] = -0.2 * (a * a + b * b) * std::cos(s) * std::cos(t);
    return jet;
  };
  for (unsigned int q = 0; q < body.points.n_points(); ++q)
    {
      const Jet d = exact(0, body.points.location(q));
      body.state.history[q] =
        Gc * (d.value / l - l * d.hessian[0][0]) / (2. * (1. - d.value));
    }

  DamageSystem<2> system(Gc, l);
  body.reinit(system);
  LA::FieldVector d = system.make_vector(), rhs = d;
  system.assemble(body.state, body.boundary, {}, rhs);
  solve_directly(system.matrix(), d, rhs);

  // The groups of a system of the displacement on the same space.
  const auto partitioner = make_partitioner(body.space, body.constraints, 1);
  PointGroups<2> groups;
  groups.reinit(body.points, {}, body.space, body.constraints, *partitioner);
  return compute_errors<1>(body, groups, d, exact);
}



void
table(const std::string &name, const unsigned int degree)
{
  deallog << name << ", degree " << degree << std::endl;
  std::vector<Errors> errors;
  for (unsigned int level = 0; level < 4; ++level)
    {
      parallel::distributed::Triangulation<2> triangulation(MPI_COMM_WORLD);
      GridGenerator::subdivided_hyper_cube(triangulation, 12, -0.75, 0.75);
      triangulation.refine_global(level);
      BodyOnGrid<2> body(triangulation,
                         PolygonBody::rotated_square(angle),
                         degree,
                         degree + 2);
      body.make_space(0.1);

      if (name == "patch test")
        {
          if (level > 1)
            break;
          deallog << "  n = " << (8 << level) << ": ";
          for (const auto problem : {Problem::patch, Problem::sliding_patch})
            {
              const Errors e = solve_elasticity(body, problem);
              deallog << (problem == Problem::patch ? "" : ", sliding ")
                      << verdict(std::max(e.value, e.gradient), 1e-9);
            }
          deallog << std::endl;
          continue;
        }

      errors.push_back(name == "damage" ?
                         solve_damage(body) :
                         solve_elasticity(body, Problem::elasticity));
      const Errors &e = errors.back();
      deallog << "  n = " << (8 << level) << ": " << digits(e.value, 3) << "  "
              << digits(e.gradient, 3);
      if (level > 0)
        {
          const Errors &f              = errors[level - 1];
          const double  order          = std::log2(f.value / e.value);
          const double  gradient_order = std::log2(f.gradient / e.gradient);
          char          text[60];
          std::snprintf(
            text, sizeof(text), "  orders %.1f %.1f", order, gradient_order);
          deallog << text << ' ' << verdict(degree + 0.9 - order, 0.) << ' '
                  << verdict(degree - 0.1 - gradient_order, 0.);
        }
      deallog << std::endl;
    }
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  initlog();

  for (unsigned int degree = 1; degree <= 3; ++degree)
    table("patch test", degree);
  for (unsigned int degree = 1; degree <= 3; ++degree)
    table("elasticity", degree);
  for (unsigned int degree = 1; degree <= 3; ++degree)
    table("damage", degree);
}
