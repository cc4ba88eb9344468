// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/neo_hookean.h>

#include <cmath>

namespace EBSMPM
{
  namespace
  {
    /**
     * What energy, stress and tangent are made of.
     */
    template <int dim>
    struct Kinematics
    {
      explicit Kinematics(const Tensor<2, dim> &F)
        : J(determinant(F))
        , trace(static_cast<double>(3 - dim))
      {
        Material<dim>::check_determinant(J);

        double squares = 0.;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            squares += F[i][j] * F[i][j];
        trace += squares;

        const double root = 1. / std::cbrt(J);
        isochoric         = root * root;
      }

      /**
       * The determinant.
       */
      double J;

      /**
       * The trace of F F^T, with the ones of the directions that are left out.
       */
      double trace;

      /**
       * J^{-2/3}.
       */
      double isochoric;
    };



    template <int dim>
    double
    volumetric_energy(const Kinematics<dim> &k, const double K)
    {
      return 0.5 * K * (0.5 * (k.J * k.J - 1.) - std::log(k.J));
    }



    template <int dim>
    double
    deviatoric_energy(const Kinematics<dim> &k, const double G)
    {
      return 0.5 * G * (k.isochoric * k.trace - 3.);
    }



    /**
     * Return the stress that belongs to degraded moduli.
     */
    template <int dim>
    Tensor<2, dim>
    stress_from_moduli(const Tensor<2, dim>  &F,
                       const Kinematics<dim> &k,
                       const double           K,
                       const double           G)
    {
      const double p1 = G * k.isochoric;
      const double p2 = 0.5 * K * (k.J * k.J - 1.) - p1 * k.trace / 3.;
      return p1 * F + p2 * transpose(invert(F));
    }
  } // namespace



  template <int dim>
  NeoHookean<dim>::NeoHookean(const double      bulk_modulus,
                              const double      shear_modulus,
                              const EnergySplit split)
    : Material<dim>(bulk_modulus, shear_modulus, split)
  {}



  template <int dim>
  std::string
  NeoHookean<dim>::name() const
  {
    return "neo-Hookean";
  }



  template <int dim>
  bool
  NeoHookean<dim>::volumetric_part_degrades(const double       J,
                                            const EnergyBranch branch) const
  {
    if (this->split == EnergySplit::none)
      return true;
    return branch == EnergyBranch::by_state ? J >= 1. :
                                              branch == EnergyBranch::expanded;
  }



  template <int dim>
  EnergyBranch
  NeoHookean<dim>::branch(const Tensor<2, dim> &F) const
  {
    return Kinematics<dim>(F).J >= 1. ? EnergyBranch::expanded :
                                        EnergyBranch::compressed;
  }



  template <int dim>
  void
  NeoHookean<dim>::energies(const Tensor<2, dim> &F,
                            double               &psi_degraded,
                            double               &psi_intact) const
  {
    const Kinematics<dim> k(F);
    const double          volumetric = volumetric_energy(k, this->K);

    psi_degraded = deviatoric_energy(k, this->G);
    psi_intact   = 0.;
    (volumetric_part_degrades(k.J) ? psi_degraded : psi_intact) += volumetric;
  }



  template <int dim>
  void
  NeoHookean<dim>::stress(const Tensor<2, dim> &F,
                          const double          g,
                          Tensor<2, dim>       &P,
                          const EnergyBranch    branch) const
  {
    const Kinematics<dim> k(F);
    const double g_vol = volumetric_part_degrades(k.J, branch) ? g : 1.;
    P                  = stress_from_moduli(F, k, g_vol * this->K, g * this->G);
  }



  template <int dim>
  Tensor<2, dim>
  NeoHookean<dim>::degraded_stress(const Tensor<2, dim> &F) const
  {
    const Kinematics<dim> k(F);
    const double          K_plus = volumetric_part_degrades(k.J) ? this->K : 0.;
    return stress_from_moduli(F, k, K_plus, this->G);
  }



  template <int dim>
  void
  NeoHookean<dim>::response(const Tensor<2, dim> &F,
                            const double          g,
                            Response             &response,
                            const EnergyBranch    branch) const
  {
    const Kinematics<dim> k(F);
    const Tensor<2, dim>  H          = transpose(invert(F));
    const bool            degrades   = volumetric_part_degrades(k.J, branch);
    const double          K          = degrades ? g * this->K : this->K;
    const double          volumetric = volumetric_energy(k, this->K);

    response.psi_degraded = deviatoric_energy(k, this->G);
    response.psi_intact   = 0.;
    (degrades ? response.psi_degraded : response.psi_intact) += volumetric;

    const double p1 = g * this->G * k.isochoric;
    const double p2 = 0.5 * K * (k.J * k.J - 1.) - p1 * k.trace / 3.;
    const double c2 = -2. / 3. * p1;
    const double c3 = K * k.J * k.J + 2. / 9. * p1 * k.trace;

    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          response.P[i][j] = p1 * F[i][j] + p2 * H[i][j];

          // The terms with a factor of the indices kL are gathered.
          const double of_F = c2 * H[i][j];
          const double of_H = c2 * F[i][j] + c3 * H[i][j];
          for (unsigned int m = 0; m < dim; ++m)
            for (unsigned int n = 0; n < dim; ++n)
              response.A[i][j][m][n] =
                of_F * F[m][n] + of_H * H[m][n] - p2 * H[i][n] * H[m][j];
          response.A[i][j][i][j] += p1;
        }
  }



  template <int dim>
  Tensor<4, dim>
  NeoHookean<dim>::tangent_derivative(const Tensor<2, dim> &F,
                                      const double          g,
                                      const Tensor<2, dim> &W,
                                      const EnergyBranch    branch) const
  {
    const Kinematics<dim> k(F);
    const Tensor<2, dim>  H = transpose(invert(F));
    const double          K =
      volumetric_part_degrades(k.J, branch) ? g * this->K : this->K;

    // Directional derivatives: of H, of ln J and of the trace. A derivative has
    // the prefix d_.
    const Tensor<2, dim> d_H     = -(H * transpose(W) * H);
    const double         d_log_J = scalar_product(H, W);
    const double         d_trace = 2. * scalar_product(F, W);

    const double J2 = k.J * k.J;
    const double p1 = g * this->G * k.isochoric;
    const double p2 = 0.5 * K * (J2 - 1.) - p1 * k.trace / 3.;
    const double c2 = -2. / 3. * p1;
    const double c3 = K * J2 + 2. / 9. * p1 * k.trace;

    const double d_p1 = -2. / 3. * p1 * d_log_J;
    const double d_p2 = K * J2 * d_log_J - (d_p1 * k.trace + p1 * d_trace) / 3.;
    const double d_c2 = -2. / 3. * d_p1;
    const double d_c3 =
      2. * K * J2 * d_log_J + 2. / 9. * (d_p1 * k.trace + p1 * d_trace);

    Tensor<4, dim> d_A;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          const double of_W = c2 * H[i][j];
          const double of_F = d_c2 * H[i][j] + c2 * d_H[i][j];
          const double of_H =
            d_c2 * F[i][j] + c2 * W[i][j] + d_c3 * H[i][j] + c3 * d_H[i][j];
          const double of_d_H = c2 * F[i][j] + c3 * H[i][j];
          for (unsigned int m = 0; m < dim; ++m)
            for (unsigned int n = 0; n < dim; ++n)
              d_A[i][j][m][n] =
                of_W * W[m][n] + of_F * F[m][n] + of_H * H[m][n] +
                of_d_H * d_H[m][n] - d_p2 * H[i][n] * H[m][j] -
                p2 * (d_H[i][n] * H[m][j] + H[i][n] * d_H[m][j]);
          d_A[i][j][i][j] += d_p1;
        }
    return d_A;
  }



  template class NeoHookean<1>;
  template class NeoHookean<2>;
  template class NeoHookean<3>;
} // namespace EBSMPM
