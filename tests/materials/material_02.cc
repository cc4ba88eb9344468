// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Values: the homogeneous bar of uniaxial strain with the damage that belongs
// to it, its peak, and what is degraded in tension and in compression. Errors:
// constants out of range, unknown names, an inverted point, a NaN.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/degradation.h>
#include <ebsmpm/materials/elastic_constants.h>
#include <ebsmpm/materials/make_material.h>

#include <functional>
#include <limits>

#include "../tests.h"

const double nan_value = std::numeric_limits<double>::quiet_NaN();



/**
 * Return damage and nominal stress of a homogeneous bar.
 */
std::pair<double, double>
bar(const Material<2> &material, const double stretch)
{
  const double      Gc = 2.7e-3, l = 0.015;
  const Degradation degradation(1e-4);

  Tensor<2, 2> F;
  F[0][0] = stretch;
  F[1][1] = 1.;

  double H, intact;
  material.energies(F, H, intact);
  const double d = H / (H + Gc / (2. * l));

  Tensor<2, 2> P;
  material.stress(F, degradation.value(d), P);
  return {d, P[0][0]};
}



void
test_values()
{
  const double K = ElasticConstants::bulk_modulus(210., 0.3);
  const double G = ElasticConstants::shear_modulus(210., 0.3);
  deallog << "K = " << K << ", G = " << G << std::endl;

  const auto material = make_material<2>(
    "neo-Hookean", energy_split_from_name("volumetric-deviatoric"), K, G);
  deallog << "K + 4G/3 = " << material->nitsche_stiffness() << std::endl;

  const auto peak = bar(*material, 1.01455);
  deallog << "d = " << peak.first << ", P = " << peak.second << std::endl;

  double largest = 0., at = 0.;
  for (unsigned int i = 1; i <= 4000; ++i)
    {
      const double stretch = 1. + 1e-5 * i;
      const double P       = bar(*material, stretch).second;
      if (P > largest)
        {
          largest = P;
          at      = stretch;
        }
    }
  deallog << "largest P = " << largest << " at F = " << at << std::endl;

  for (const double stretch : {0.9, 1.1})
    for (const std::string name : {"neo-Hookean", "linear elastic"})
      for (const std::string split : {"volumetric-deviatoric", "none"})
        {
          const auto material =
            make_material<3>(name, energy_split_from_name(split), K, G);
          Tensor<2, 3> F;
          for (unsigned int i = 0; i < 3; ++i)
            F[i][i] = stretch;
          double plus, minus;
          material->energies(F, plus, minus);
          // The deviatoric energy of a dilatation vanishes up to round-off.
          deallog << name << ", " << split << ", stretch " << stretch
                  << ": degraded " << (std::abs(plus) < 1e-12 ? 0. : plus)
                  << ", intact " << minus << std::endl;
        }

  const Degradation degradation(1e-4);
  deallog << "g:";
  for (const double d : {-0.1, 0., 0.5, 0.999, 1., 1.2})
    deallog << ' ' << degradation.value(d);
  deallog << ", g': " << Degradation::derivative(0.25) << std::endl;
}



void
test_error(const std::function<void()> &function)
{
  // The text alone: what() also gives file and line.
  const auto print = [](const ExceptionBase &exc) {
    std::ostringstream text;
    exc.print_info(text);
    std::string message = text.str();
    while (!message.empty() && message.back() == '\n')
      message.pop_back();
    deallog << message.substr(message.find_first_not_of(' ')) << std::endl;
  };

  try
    {
      function();
      deallog << "FAILED: no exception" << std::endl;
    }
  catch (const ExcParameter &exc)
    {
      print(exc);
    }
  catch (const ExcSolverFailure &exc)
    {
      print(exc);
    }
}



void
test_errors()
{
  const auto none = EnergySplit::none;
  test_error([] { ElasticConstants::bulk_modulus(0., 0.3); });
  test_error([] { ElasticConstants::bulk_modulus(1., 0.5); });
  test_error([] { ElasticConstants::shear_modulus(1., -1.); });
  test_error([] { ElasticConstants::shear_modulus(1., nan_value); });
  test_error([&] { make_material<2>("neo-Hookean", none, -1., 1.); });
  test_error([&] { make_material<2>("linear elastic", none, 1., 0.); });
  test_error([&] { make_material<3>("rubber", none, 1., 1.); });
  test_error([] { energy_split_from_name("spectral"); });
  test_error([] { Degradation(-0.1); });
  test_error([] { Degradation(1.); });

  Tensor<2, 2> inverted, undefined;
  inverted[0][0]  = -0.5;
  inverted[1][1]  = 1.;
  undefined[0][0] = nan_value;
  undefined[1][1] = 1.;

  const auto neo    = make_material<2>("neo-Hookean", none, 1., 1.);
  const auto linear = make_material<2>("linear elastic", none, 1., 1.);
  double     plus, minus;
  test_error([&] { neo->energies(inverted, plus, minus); });
  test_error([&] { neo->degraded_stress(undefined); });
  test_error([&] { linear->energies(undefined, plus, minus); });
}



int
main()
{
  initlog();
  deallog << std::setprecision(8);
  test_values();
  test_errors();
}
