// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/material.h>

#include <cmath>

namespace EBSMPM
{
  namespace
  {
    /** What a batch was given about one of its points. */
    template <int dim>
    struct GivenPoint
    {
      GivenPoint(const PointBatch<dim> &batch, const unsigned int p)
        : weight(batch.weight()[p])
        , g(batch.degradation()[p])
        , branch(batch.branch()[p] > 0. ? EnergyBranch::expanded :
                 batch.branch()[p] < 0. ? EnergyBranch::compressed :
                                          EnergyBranch::by_state)
      {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              F[i][j]   = batch.F(i, j)[p];
              F_n[i][j] = batch.F_n(i, j)[p];
            }
      }

      /** Return the tensor of weight F_jB A_iBkD F_lD in j and l. */
      Tensor<2, dim>
      push_forward(const Tensor<4, dim> &A,
                   const unsigned int    i,
                   const unsigned int    k) const
      {
        Tensor<2, dim> of_pair;
        for (unsigned int b = 0; b < dim; ++b)
          for (unsigned int d = 0; d < dim; ++d)
            of_pair[b][d] = weight * A[i][b][k][d];
        return F_n * of_pair * transpose(F_n);
      }

      Tensor<2, dim> F;
      Tensor<2, dim> F_n;

      const double       weight;
      const double       g;
      const EnergyBranch branch;
    };
  } // namespace



  template <int dim>
  Material<dim>::Material(const double      bulk_modulus,
                          const double      shear_modulus,
                          const EnergySplit split)
    : K(bulk_modulus)
    , G(shear_modulus)
    , split(split)
  {
    // Written so that a NaN fails, too.
    AssertThrow(K > 0. && std::isfinite(K),
                ExcParameter("Material/Bulk modulus",
                             std::to_string(K),
                             "a positive number"));
    AssertThrow(G > 0. && std::isfinite(G),
                ExcParameter("Material/Shear modulus",
                             std::to_string(G),
                             "a positive number"));
  }



  template <int dim>
  void
  Material<dim>::check_determinant(const double J)
  {
    // The negation also catches a NaN.
    AssertThrow(J > 0. && std::isfinite(J),
                ExcSolverFailure(
                  "The deformation gradient at a point has the determinant " +
                  std::to_string(J) + ", but it must be positive."));
  }



  template <int dim>
  void
  Material<dim>::respond(MaterialBatch<dim> &batch,
                         const bool          with_tangent) const
  {
    Response response;
    for (unsigned int p = 0; p < batch.n_points(); ++p)
      {
        const GivenPoint<dim> point(batch, p);
        if (with_tangent)
          this->response(point.F, point.g, response, point.branch);
        else
          stress(point.F, point.g, response.P, point.branch);

        const Tensor<2, dim> S =
          point.weight * response.P * transpose(point.F_n);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            batch.stress(i, j)[p] = S[i][j];
        if (!with_tangent)
          continue;

        for (unsigned int i = 0, pair = 0; i < dim; ++i)
          for (unsigned int k = i; k < dim; ++k, ++pair)
            {
              const Tensor<2, dim> c = point.push_forward(response.A, i, k);
              for (unsigned int j = 0; j < dim; ++j)
                for (unsigned int l = 0; l < dim; ++l)
                  batch.tangent(pair, j, l)[p] = c[j][l];
            }
      }
  }



  template <int dim>
  void
  Material<dim>::respond(TractionBatch<dim> &batch,
                         const bool          with_second) const
  {
    Response response;
    for (unsigned int p = 0; p < batch.n_points(); ++p)
      {
        const GivenPoint<dim> point(batch, p);
        Tensor<1, dim>        N, w;
        for (unsigned int i = 0; i < dim; ++i)
          {
            N[i] = batch.normal(i)[p];
            w[i] = batch.w(i)[p];
          }
        this->response(point.F, point.g, response, point.branch);

        const Tensor<1, dim> t = point.weight * response.P * N;
        for (unsigned int i = 0; i < dim; ++i)
          {
            batch.traction(i)[p] = t[i];

            Tensor<2, dim> NA;
            for (unsigned int b = 0; b < dim; ++b)
              for (unsigned int k = 0; k < dim; ++k)
                for (unsigned int d = 0; d < dim; ++d)
                  NA[k][d] += point.weight * N[b] * response.A[i][b][k][d];
            const Tensor<2, dim> T = NA * transpose(point.F_n);
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = 0; l < dim; ++l)
                batch.derivative(i, k, l)[p] = T[k][l];
          }
        if (!with_second)
          continue;

        const Tensor<4, dim> dA = tangent_derivative(point.F,
                                                     point.g,
                                                     outer_product(w, N),
                                                     point.branch);
        for (unsigned int i = 0, pair = 0; i < dim; ++i)
          for (unsigned int k = i; k < dim; ++k, ++pair)
            {
              const Tensor<2, dim> c = point.push_forward(dA, i, k);
              for (unsigned int j = 0; j < dim; ++j)
                for (unsigned int l = 0; l < dim; ++l)
                  batch.second_derivative(pair, j, l)[p] = c[j][l];
            }
      }
  }



  template class Material<1>;
  template class Material<2>;
  template class Material<3>;
} // namespace EBSMPM
