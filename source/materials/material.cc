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
        Tensor<2, dim> F, F_n;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              F[i][j]   = batch.F(i, j)[p];
              F_n[i][j] = batch.F_n(i, j)[p];
            }
        const double       V      = batch.volume()[p];
        const double       g      = batch.degradation()[p];
        const double       held   = batch.branch()[p];
        const EnergyBranch branch = held > 0. ? EnergyBranch::expanded :
                                    held < 0. ? EnergyBranch::compressed :
                                                EnergyBranch::by_state;
        if (with_tangent)
          this->response(F, g, response, branch);
        else
          stress(F, g, response.P, branch);

        const Tensor<2, dim> S = V * response.P * transpose(F_n);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            batch.stress(i, j)[p] = S[i][j];
        if (!with_tangent)
          continue;

        for (unsigned int i = 0, pair = 0; i < dim; ++i)
          for (unsigned int k = i; k < dim; ++k, ++pair)
            {
              Tensor<2, dim> VA;
              for (unsigned int b = 0; b < dim; ++b)
                for (unsigned int d = 0; d < dim; ++d)
                  VA[b][d] = V * response.A[i][b][k][d];
              const Tensor<2, dim> c = F_n * VA * transpose(F_n);
              for (unsigned int j = 0; j < dim; ++j)
                for (unsigned int l = 0; l < dim; ++l)
                  batch.tangent(pair, j, l)[p] = c[j][l];
            }
      }
  }



  template class Material<1>;
  template class Material<2>;
  template class Material<3>;
} // namespace EBSMPM
