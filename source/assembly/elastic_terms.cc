// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/bspline_kernel.h>

#include <ebsmpm/assembly/dense_kernels.h>
#include <ebsmpm/assembly/elastic_terms.h>
#include <ebsmpm/assembly/point_values.h>

#include <algorithm>

namespace EBSMPM
{
  namespace internal
  {
    namespace ElasticTermsImplementation
    {
      /**
       * The rows of cG of one point: $c_{ijkl} G_l$ in row $j$, for $i\le k$
       * only.
       */
      template <int dim>
      inline void
      multiply_gradients(const Tensor<4, dim> &A,
                         const double          V,
                         const Tensor<2, dim> &F_n,
                         const unsigned int    n,
                         const unsigned int    stride,
                         const double         *G,
                         double               *cG)
      {
        for (unsigned int i = 0, pair = 0; i < dim; ++i)
          for (unsigned int k = i; k < dim; ++k, ++pair)
            {
              Tensor<2, dim> VA;
              for (unsigned int b = 0; b < dim; ++b)
                for (unsigned int d = 0; d < dim; ++d)
                  VA[b][d] = V * A[i][b][k][d];
              const Tensor<2, dim> c = F_n * VA * transpose(F_n);
              for (unsigned int j = 0; j < dim; ++j)
                {
                  double *row = cG + j * stride + pair * n;
                  for (unsigned int J = 0; J < n; ++J)
                    {
                      double sum = c[j][0] * G[J];
                      for (unsigned int l = 1; l < dim; ++l)
                        sum += c[j][l] * G[l * n + J];
                      row[J] = sum;
                    }
                }
            }
      }
    } // namespace ElasticTermsImplementation
  }   // namespace internal

  using namespace internal::ElasticTermsImplementation;



  template <int dim>
  ElasticTerms<dim>::ElasticTerms(const Material<dim> &material,
                                  const Degradation   &degradation)
    : material(material)
    , degradation(degradation)
  {}



  template <int dim>
  void
  ElasticTerms<dim>::initialize(const unsigned int n_functions,
                                const unsigned int max_n_points)
  {
    const unsigned int n_points = std::max(max_n_points, 1U);

    // The padding of the rows must be zero.
    stride = DenseKernels::padded(n_pairs * n_functions);
    G.resize(dim * n_points * n_functions);
    cG.assign(dim * n_points * stride, 0.);
    product.resize(n_functions * stride);
  }



  template <int dim>
  void
  ElasticTerms<dim>::compute(const AssemblyTask               task,
                             const MaterialState<dim>        &state,
                             const std::vector<EnergyBranch> &branches,
                             LocalSystem<dim>                &local)
  {
    const unsigned int n = local.n_functions();
    std::array<double, BSplineKernel<dim>::max_n_functions> B;
    typename Material<dim>::Response                        response;

    double *G_p  = G.data();
    double *cG_p = cG.data();
    for (unsigned int p = 0; p < local.n_points();
         ++p, G_p += dim * n, cG_p += dim * stride)
      {
        local.values_and_gradients(p, B.data(), G_p);

        const unsigned int    q   = local.point(p);
        const Tensor<2, dim> &F_n = state.F[q];
        const Tensor<2, dim>  F   = deformation<dim>(local.gradient(G_p), F_n);
        const double          V   = state.volume[q];
        const double          g   = degradation.value(state.damage[q]);
        const EnergyBranch    branch = branch_of(branches, q);
        if (task == AssemblyTask::residual)
          material.stress(F, g, response.P, branch);
        else
          material.response(F, g, response, branch);

        const Tensor<2, dim> stress = V * response.P * transpose(F_n);
        for (unsigned int I = 0; I < n; ++I)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              local.residual[I][i] += stress[i][j] * G_p[j * n + I];

        if (task != AssemblyTask::residual)
          multiply_gradients(response.A, V, F_n, n, stride, G_p, cG_p);
      }

    if (task != AssemblyTask::residual)
      multiply(local);
  }



  template <int dim>
  void
  ElasticTerms<dim>::multiply(LocalSystem<dim> &local)
  {
    const unsigned int n = local.n_functions();
    DenseKernels::transposed_product(dim * local.n_points(),
                                     n,
                                     stride,
                                     G.data(),
                                     n,
                                     cG.data(),
                                     product.data());

    // Unfold into a block per pair of components, the lower ones by symmetry.
    for (unsigned int i = 0, pair = 0; i < dim; ++i)
      for (unsigned int k = i; k < dim; ++k, ++pair)
        {
          double *upper = local.tangent_block(i, k);
          double *lower = local.tangent_block(k, i);
          for (unsigned int I = 0; I < n; ++I)
            for (unsigned int J = 0; J < n; ++J)
              {
                const double value = product[I * stride + pair * n + J];
                upper[I * n + J]   = value;
                if (k != i)
                  lower[J * n + I] = value;
              }
        }
  }



  template class ElasticTerms<2>;
  template class ElasticTerms<3>;
} // namespace EBSMPM
