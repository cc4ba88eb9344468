// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Material::respond(): several points side by side give what stress(),
// response() and tangent_derivative() say about one after the other, for
// stresses and for tractions, in all dimensions, for all materials and
// branches, for all instruction sets of the machine, for numbers of points that
// fill registers and that do not, near the undeformed state and far away. A
// point with a NaN is noticed among many, and one that is turned inside out,
// which only linear elasticity does not mind.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/make_material.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "../tests.h"

#include "../instruction_sets.h"



/** Give tractions their vectors; stresses have none. */
template <int dim>
void
set_vectors(MaterialBatch<dim> &, const unsigned int)
{}

template <int dim>
void
set_vectors(TractionBatch<dim> &batch, const unsigned int p)
{
  Tensor<1, dim> N, w;
  for (unsigned int i = 0; i < dim; ++i)
    {
      N[i] = std::cos(2. * p + i);
      w[i] = 0.1 * std::sin(3. * p + 5. * i);
    }
  batch.set_vectors(p, N, w);
}



/** Fill a batch with points that are stretched, and sheared differently. */
template <typename Batch, int dim>
void
fill(Batch &batch, const unsigned int n_points, const double stretch)
{
  batch.initialize(n_points);
  batch.reinit(n_points);
  for (unsigned int p = 0; p < n_points; ++p)
    {
      Tensor<2, dim> F   = stretch * unit_symmetric_tensor<dim>();
      Tensor<2, dim> F_n = unit_symmetric_tensor<dim>();
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            F[i][j] += 0.1 * std::sin(1. + 7. * p + 3. * i + 11. * j);
            F_n[i][j] += 0.1 * std::cos(5. * p + i + 4. * j);
          }
      batch.set(p,
                F,
                F_n,
                0.1 + 0.01 * p,
                1. / (1. + p),
                p % 3 == 0 ? EnergyBranch::by_state :
                p % 3 == 1 ? EnergyBranch::expanded :
                             EnergyBranch::compressed);
      set_vectors(batch, p);
    }
}



/** Visit all answers about a point. */
template <int dim, typename Function>
void
for_each_answer(MaterialBatch<dim> &batch,
                const unsigned int  p,
                const bool          with_derivatives,
                const Function     &function)
{
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      {
        function(batch.stress(i, j)[p]);
        if (with_derivatives)
          for (unsigned int b = 0; b < batch.n_pairs; ++b)
            function(batch.tangent(b, i, j)[p]);
      }
}

template <int dim, typename Function>
void
for_each_answer(TractionBatch<dim> &batch,
                const unsigned int  p,
                const bool          with_derivatives,
                const Function     &function)
{
  for (unsigned int i = 0; i < dim; ++i)
    {
      function(batch.traction(i)[p]);
      for (unsigned int k = 0; k < dim; ++k)
        {
          for (unsigned int l = 0; l < dim; ++l)
            function(batch.derivative(i, k, l)[p]);
          if (with_derivatives)
            for (unsigned int b = 0; b < batch.n_pairs; ++b)
              function(batch.second_derivative(b, i, k)[p]);
        }
    }
}



template <typename Batch, int dim>
void
test(const Material<dim> &material)
{
  double error = 0.;
  for (const double stretch : {0.6, 1., 1.7})
    for (const unsigned int n : {1U, 4U, 9U, 16U})
      for (const bool with_derivatives : {false, true})
        for_each_instruction_set([&]() {
          Batch batch, expected;
          fill<Batch, dim>(batch, n, stretch);
          fill<Batch, dim>(expected, n, stretch);
          material.respond(batch, with_derivatives);
          // The base class asks about one point after the other.
          material.Material<dim>::respond(expected, with_derivatives);

          for (unsigned int p = 0; p < n; ++p)
            {
              std::vector<double> answers;
              for_each_answer(batch, p, with_derivatives, [&](const double a) {
                answers.push_back(a);
              });
              auto answer = answers.begin();
              for_each_answer(
                expected, p, with_derivatives, [&](const double b) {
                  const double difference = std::abs(*answer++ - b) / 175.;
                  if (!(difference <= error))
                    error = difference;
                });
            }
        });
  deallog << (error < 1e-12 ? "  the same" :
                              "  FAILED, " + std::to_string(error))
          << std::endl;

  for (const double bad : {-1., 0., std::numeric_limits<double>::quiet_NaN()})
    {
      Batch batch;
      fill<Batch, dim>(batch, 9, 1.);
      Tensor<2, dim> F = unit_symmetric_tensor<dim>();
      F[0][0]          = bad;
      batch.set(
        5, F, unit_symmetric_tensor<dim>(), 1., 1., EnergyBranch::by_state);
      std::set<bool> refused;
      for_each_instruction_set([&]() {
        try
          {
            material.respond(batch, true);
            refused.insert(false);
          }
        catch (const ExcSolverFailure &)
          {
            refused.insert(true);
          }
      });
      deallog << (refused.size() > 1 ? "  FAILED" :
                  *refused.begin()   ? "  refused" :
                                       "  accepted")
              << std::endl;
    }
}



template <int dim>
void
test(const std::string &name, const EnergySplit split)
{
  const auto material = make_material<dim>(name, split, 175., 80.77);
  deallog << dim << "d, " << name << ", stresses:" << std::endl;
  test<MaterialBatch<dim>>(*material);
  deallog << dim << "d, " << name << ", tractions:" << std::endl;
  test<TractionBatch<dim>>(*material);
}



int
main()
{
  initlog();
  for (const std::string name : {"neo-Hookean", "linear elastic"})
    {
      test<1>(name, EnergySplit::volumetric_deviatoric);
      test<2>(name, EnergySplit::volumetric_deviatoric);
      test<3>(name, EnergySplit::volumetric_deviatoric);
      test<2>(name, EnergySplit::none);
    }
}
