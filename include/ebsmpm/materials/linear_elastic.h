// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_linear_elastic_h
#define ebsmpm_materials_linear_elastic_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/materials/material.h>

namespace EBSMPM
{
  /**
   * Isotropic linear elasticity at small strains, for comparisons with codes
   * and closed forms that use it.
   *
   * With $\boldsymbol\varepsilon = \text{sym}(\mathbf F - \mathbf I)$, its
   * three-dimensional deviator $\mathbf e$ and
   * $\theta = \text{tr}\,\boldsymbol\varepsilon$, the energy is
   * @f[
   *   \Psi_\text{vol} = \frac K2\theta^2, \qquad
   *   \Psi_\text{dev} = G\,\mathbf e : \mathbf e .
   * @f]
   * With EnergySplit::volumetric_deviatoric, the volumetric part is degraded
   * where $\theta\ge0$ and intact elsewhere, which is the small-strain limit of
   * the switch in NeoHookean. Without damage the tangent is constant, so that
   * Newton's method converges in one step.
   *
   * This material is not objective: rigid rotations strain it. It has no
   * condition on $\det\mathbf F$; only a NaN raises ExcSolverFailure.
   *
   * See the base class for usage.
   */
  template <int dim>
  class LinearElastic : public Material<dim>
  {
  public:
    using typename Material<dim>::Response;

    /**
     * Constructor, with the moduli $K$ and $G$.
     */
    LinearElastic(const double      bulk_modulus,
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

    /**
     * Return zero, as the tangent does not depend on @p F, except where the
     * sign of the dilatation changes.
     */
    virtual Tensor<4, dim>
    tangent_derivative(
      const Tensor<2, dim> &F,
      const double          g,
      const Tensor<2, dim> &W,
      const EnergyBranch    branch = EnergyBranch::by_state) const override;

  private:
    /**
     * Return whether the volumetric energy is degraded at the dilatation
     * @p theta.
     */
    bool
    volumetric_part_degrades(
      const double       theta,
      const EnergyBranch branch = EnergyBranch::by_state) const;
  };
} // namespace EBSMPM

#endif
