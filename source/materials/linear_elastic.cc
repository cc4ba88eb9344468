// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/linear_elastic.h>

#include <cmath>

namespace EBSMPM
{
  namespace
  {
    /**
     * Return the dilatation, the trace of the strain. It is the one quantity
     * that every function computes first, so here is the check for a NaN.
     */
    template <int dim>
    double
    dilatation(const Tensor<2, dim> &F)
    {
      AssertThrow(numbers::is_finite(F.norm_square()),
                  ExcSolverFailure(
                    "The deformation gradient at a point is not finite."));
      return trace(F) - dim;
    }



    /**
     * Return the stress that belongs to degraded moduli.
     */
    template <int dim>
    Tensor<2, dim>
    stress_from_moduli(const Tensor<2, dim> &F,
                       const double          theta,
                       const double          K,
                       const double          G)
    {
      Tensor<2, dim> P;
      for (unsigned int i = 0; i < dim; ++i)
        {
          for (unsigned int j = 0; j < dim; ++j)
            P[i][j] = G * (F[i][j] + F[j][i]);
          P[i][i] += (K - 2. / 3. * G) * theta - 2. * G;
        }
      return P;
    }



    template <int dim>
    double
    deviatoric_energy(const Tensor<2, dim> &F,
                      const double          theta,
                      const double          G)
    {
      double squares = 0.;
      for (unsigned int i = 0; i < dim; ++i)
        {
          squares += (F[i][i] - 1.) * (F[i][i] - 1.);
          for (unsigned int j = i + 1; j < dim; ++j)
            squares += 0.5 * (F[i][j] + F[j][i]) * (F[i][j] + F[j][i]);
        }
      return G * (squares - theta * theta / 3.);
    }
  } // namespace



  template <int dim>
  LinearElastic<dim>::LinearElastic(const double      bulk_modulus,
                                    const double      shear_modulus,
                                    const EnergySplit split)
    : Material<dim>(bulk_modulus, shear_modulus, split)
  {}



  template <int dim>
  std::string
  LinearElastic<dim>::name() const
  {
    return "linear elastic";
  }



  template <int dim>
  bool
  LinearElastic<dim>::volumetric_part_degrades(const double       theta,
                                               const EnergyBranch branch) const
  {
    if (this->split == EnergySplit::none)
      return true;
    return branch == EnergyBranch::by_state ? theta >= 0. :
                                              branch == EnergyBranch::expanded;
  }



  template <int dim>
  EnergyBranch
  LinearElastic<dim>::branch(const Tensor<2, dim> &F) const
  {
    return dilatation(F) >= 0. ? EnergyBranch::expanded :
                                 EnergyBranch::compressed;
  }



  template <int dim>
  void
  LinearElastic<dim>::energies(const Tensor<2, dim> &F,
                               double               &psi_degraded,
                               double               &psi_intact) const
  {
    const double theta      = dilatation(F);
    const double volumetric = 0.5 * this->K * theta * theta;

    psi_degraded = deviatoric_energy(F, theta, this->G);
    psi_intact   = 0.;
    (volumetric_part_degrades(theta) ? psi_degraded : psi_intact) += volumetric;
  }



  template <int dim>
  void
  LinearElastic<dim>::stress(const Tensor<2, dim> &F,
                             const double          g,
                             Tensor<2, dim>       &P,
                             const EnergyBranch    branch) const
  {
    const double theta = dilatation(F);
    const double g_vol = volumetric_part_degrades(theta, branch) ? g : 1.;
    P = stress_from_moduli(F, theta, g_vol * this->K, g * this->G);
  }



  template <int dim>
  Tensor<2, dim>
  LinearElastic<dim>::degraded_stress(const Tensor<2, dim> &F) const
  {
    const double theta  = dilatation(F);
    const double K_plus = volumetric_part_degrades(theta) ? this->K : 0.;
    return stress_from_moduli(F, theta, K_plus, this->G);
  }



  template <int dim>
  void
  LinearElastic<dim>::response(const Tensor<2, dim> &F,
                               const double          g,
                               Response             &response,
                               const EnergyBranch    branch) const
  {
    const double theta      = dilatation(F);
    const bool   degrades   = volumetric_part_degrades(theta, branch);
    const double volumetric = 0.5 * this->K * theta * theta;

    response.psi_degraded = deviatoric_energy(F, theta, this->G);
    response.psi_intact   = 0.;
    (degrades ? response.psi_degraded : response.psi_intact) += volumetric;

    const double K = (degrades ? g : 1.) * this->K;
    const double G = g * this->G;

    response.P = stress_from_moduli(F, theta, K, G);
    response.A = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          response.A[i][j][i][j] += G;
          response.A[i][j][j][i] += G;
          response.A[i][i][j][j] += K - 2. / 3. * G;
        }
  }



  template <int dim>
  Tensor<4, dim>
  LinearElastic<dim>::tangent_derivative(const Tensor<2, dim> &,
                                         const double,
                                         const Tensor<2, dim> &,
                                         const EnergyBranch) const
  {
    return Tensor<4, dim>();
  }



  template class LinearElastic<1>;
  template class LinearElastic<2>;
  template class LinearElastic<3>;
} // namespace EBSMPM
