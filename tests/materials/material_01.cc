// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Derivatives and symmetries of all materials: the stress against differences
// of the energy, the tangent against differences of the stress, the derivative
// of the tangent against differences of the tangent, on both sides of the
// switch of the energy split; major symmetry; the stress-only path and the
// degraded stress against the full response; plane strain against three
// dimensions; objectivity.

#include <ebsmpm/materials/elastic_constants.h>
#include <ebsmpm/materials/make_material.h>

#include <deal.II/base/point.h>

#include <deal.II/physics/transformations.h>

#include <functional>

#include "../tests.h"

const double g = 0.37;



/**
 * Collect the largest relative error of several checks of the same kind.
 */
struct Check
{
  Check(const std::string &what, const double tolerance)
    : what(what)
    , tolerance(tolerance)
  {}

  ~Check()
  {
    if (error <= tolerance)
      deallog << what << ": within " << tolerance << std::endl;
    else
      deallog << what << ": FAILED with " << error << std::endl;
  }

  template <typename T>
  void
  compare(const T &a, const T &b, const double scale)
  {
    const double difference = (a - b).norm() / scale;
    // A NaN must not pass.
    if (!(difference <= error))
      error = difference;
  }

  void
  compare(const double a, const double b, const double scale)
  {
    compare(Tensor<1, 1>({a}), Tensor<1, 1>({b}), scale);
  }

  const std::string what;
  const double      tolerance;
  double            error = 0.;
};



/**
 * Return the derivative of a function of F with respect to F_kL by a difference
 * of fourth order.
 */
template <int dim, typename T>
T
difference(const std::function<T(const Tensor<2, dim> &)> &f,
           const Tensor<2, dim>                           &F,
           const Tensor<2, dim>                           &direction)
{
  const double h = 1e-3;
  return (8. * (f(F + h * direction) - f(F - h * direction)) -
          (f(F + 2. * h * direction) - f(F - 2. * h * direction))) /
         (12. * h);
}



template <int dim>
Tensor<2, dim>
unit(const unsigned int i, const unsigned int j)
{
  Tensor<2, dim> e;
  e[i][j] = 1.;
  return e;
}



/**
 * Return deformation gradients with a determinant above and below one, with
 * shear and rotation.
 */
template <int dim>
std::vector<Tensor<2, dim>>
deformation_gradients()
{
  Tensor<2, dim> shear;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      shear[i][j] = (i == j ? 1. : 0.) + 0.1 * std::sin(1. + 3. * i + 5. * j);

  std::vector<Tensor<2, dim>> result;
  for (const double J : {0.8, 1.25})
    result.push_back(std::pow(J / determinant(shear), 1. / dim) * shear);
  return result;
}



template <int dim>
void
test_derivatives(const Material<dim> &material)
{
  deallog << material.name() << ", dim = " << dim << std::endl;

  using Response = typename Material<dim>::Response;

  Check P("stress", 1e-8), A("tangent", 1e-8),
    DA("derivative of the tangent", 1e-8), major("major symmetry", 1e-14),
    paths("single parts against the response", 1e-14);

  const auto energy = [&](const Tensor<2, dim> &F) {
    double plus, minus;
    material.energies(F, plus, minus);
    return g * plus + minus;
  };
  const auto energy_plus = [&](const Tensor<2, dim> &F) {
    double plus, minus;
    material.energies(F, plus, minus);
    return plus;
  };
  const auto stress = [&](const Tensor<2, dim> &F) {
    Tensor<2, dim> result;
    material.stress(F, g, result);
    return result;
  };

  for (const Tensor<2, dim> &F : deformation_gradients<dim>())
    {
      Response response;
      material.response(F, g, response);
      const double scale = material.nitsche_stiffness();

      paths.compare(response.P, stress(F), scale);
      paths.compare(response.psi_degraded, energy_plus(F), scale);
      paths.compare(g * response.psi_degraded + response.psi_intact,
                    energy(F),
                    scale);

      Tensor<2, dim> W;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          W[i][j] = std::cos(2. * i + 3. * j);
      for (const EnergyBranch branch : {EnergyBranch::by_state,
                                        EnergyBranch::expanded,
                                        EnergyBranch::compressed})
        {
          const auto tangent = [&](const Tensor<2, dim> &F) {
            Response response;
            material.response(F, g, response, branch);
            return response.A;
          };
          DA.compare(material.tangent_derivative(F, g, W, branch),
                     difference<dim, Tensor<4, dim>>(tangent, F, W),
                     scale);
        }

      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int l = 0; l < dim; ++l)
          {
            P.compare(response.P[k][l],
                      difference<dim, double>(energy, F, unit<dim>(k, l)),
                      scale);
            P.compare(material.degraded_stress(F)[k][l],
                      difference<dim, double>(energy_plus, F, unit<dim>(k, l)),
                      scale);

            const auto dP =
              difference<dim, Tensor<2, dim>>(stress, F, unit<dim>(k, l));
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                {
                  A.compare(response.A[i][j][k][l], dP[i][j], scale);
                  major.compare(response.A[i][j][k][l],
                                response.A[k][l][i][j],
                                scale);
                }
          }
    }
}



void
test_plane_strain(const Material<2> &two, const Material<3> &three)
{
  Check check("plane strain against three dimensions", 1e-14);
  for (const Tensor<2, 2> &F : deformation_gradients<2>())
    {
      Tensor<2, 3> F3;
      F3[2][2] = 1.;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          F3[i][j] = F[i][j];

      Material<2>::Response plane;
      Material<3>::Response space;
      two.response(F, g, plane);
      three.response(F3, g, space);
      const double scale = two.nitsche_stiffness();
      check.compare(plane.psi_degraded, space.psi_degraded, scale);
      check.compare(plane.psi_intact, space.psi_intact, scale);
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          {
            check.compare(plane.P[i][j], space.P[i][j], scale);
            for (unsigned int k = 0; k < 2; ++k)
              for (unsigned int l = 0; l < 2; ++l)
                check.compare(plane.A[i][j][k][l], space.A[i][j][k][l], scale);
          }
    }
}



void
test_objectivity(const Material<3> &material)
{
  Check check("objectivity", 1e-13);
  for (const Tensor<2, 3> &F : deformation_gradients<3>())
    {
      const Tensor<2, 3> Q =
        Physics::Transformations::Rotations::rotation_matrix_3d(
          Point<3>(2. / 3., 1. / 3., 2. / 3.), 1.1);
      double plus, minus, plus_rotated, minus_rotated;
      material.energies(F, plus, minus);
      material.energies(Q * F, plus_rotated, minus_rotated);
      check.compare(plus_rotated, plus, material.shear_modulus());
      check.compare(minus_rotated, minus, material.shear_modulus());
    }
}



int
main()
{
  initlog();

  const double K = ElasticConstants::bulk_modulus(2.1, 0.3);
  const double G = ElasticConstants::shear_modulus(2.1, 0.3);
  for (const auto split :
       {EnergySplit::volumetric_deviatoric, EnergySplit::none})
    {
      deallog << (split == EnergySplit::none ? "no split" : "split")
              << std::endl;
      for (const std::string name : {"neo-Hookean", "linear elastic"})
        {
          const auto one   = make_material<1>(name, split, K, G);
          const auto two   = make_material<2>(name, split, K, G);
          const auto three = make_material<3>(name, split, K, G);
          test_derivatives(*one);
          test_derivatives(*two);
          test_derivatives(*three);
          test_plane_strain(*two, *three);
          if (name == "neo-Hookean")
            test_objectivity(*three);
        }
    }
}
