// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_neo_hookean_h
#define ebsmpm_materials_neo_hookean_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/materials/material.h>

namespace EBSMPM
{
  /**
   * The compressible neo-Hookean material of the paper.
   *
   * The energy is (method, section 2)
   * @f[
   *   \Psi_\text{vol} = \frac K2\left[\frac{J^2-1}2 - \ln J\right], \qquad
   *   \Psi_\text{dev} = \frac G2\left(J^{-2/3}\,\text{tr}(\mathbf F\mathbf F^T)
   *                     - 3\right), \qquad J = \det\mathbf F .
   * @f]
   * With EnergySplit::volumetric_deviatoric, all of it is degraded if $J\ge1$,
   * and only $\Psi_\text{dev}$ if $J<1$. As $\Psi_\text{vol}$ and its
   * derivative vanish at $J=1$, energy and stress are continuous there; the
   * tangent jumps by $(1-g)K$ times a dyad.
   *
   * With $\mathbf H = \mathbf F^{-T}$, stress and tangent are sums of few
   * dyads, which is how they are computed:
   * @f[
   *   \mathbf P = p_1\mathbf F + p_2\mathbf H, \qquad
   *   A_{iJkL} = p_1\,\delta_{ik}\delta_{JL}
   *            + c_2\,(F_{iJ}H_{kL} + H_{iJ}F_{kL})
   *            + c_3\,H_{iJ}H_{kL} - p_2\,H_{iL}H_{kJ} .
   * @f]
   * The four coefficients are functions of $J$ and
   * $\text{tr}(\mathbf F\mathbf F^T)$ alone, hence also the derivative of the
   * tangent is in closed form.
   *
   * See the base class for usage.
   */
  template <int dim>
  class NeoHookean : public Material<dim>
  {
  public:
    using typename Material<dim>::Response;

    /**
     * Constructor, with the moduli $K$ and $G$.
     */
    NeoHookean(const double      bulk_modulus,
               const double      shear_modulus,
               const EnergySplit split = EnergySplit::volumetric_deviatoric);

    virtual std::string
    name() const override;

    virtual void
    energies(const Tensor<2, dim> &F,
             double               &psi_degraded,
             double               &psi_intact) const override;

    virtual EnergyBranch
    branch(const Tensor<2, dim> &F) const override;

    virtual void
    stress(const Tensor<2, dim> &F,
           const double          g,
           Tensor<2, dim>       &P,
           const EnergyBranch branch = EnergyBranch::by_state) const override;

    virtual Tensor<2, dim>
    degraded_stress(const Tensor<2, dim> &F) const override;

    virtual void
    response(const Tensor<2, dim> &F,
             const double          g,
             Response             &response,
             const EnergyBranch branch = EnergyBranch::by_state) const override;

    /** Several points side by side, see Lanes. */
    virtual void
    respond(MaterialBatch<dim> &batch, const bool with_tangent) const override;
    virtual void
    respond(TractionBatch<dim> &batch, const bool with_second) const override;

    virtual Tensor<4, dim>
    tangent_derivative(
      const Tensor<2, dim> &F,
      const double          g,
      const Tensor<2, dim> &W,
      const EnergyBranch    branch = EnergyBranch::by_state) const override;

  private:
    /**
     * Return whether the volumetric energy is degraded at the determinant
     * @p J.
     */
    bool
    volumetric_part_degrades(
      const double       J,
      const EnergyBranch branch = EnergyBranch::by_state) const;
  };
} // namespace EBSMPM

#endif
