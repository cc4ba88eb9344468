// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_material_h
#define ebsmpm_materials_material_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/materials/energy_split.h>
#include <ebsmpm/materials/material_batch.h>
#include <ebsmpm/materials/traction_batch.h>

#include <deal.II/base/tensor.h>

#include <string>

namespace EBSMPM
{
  /**
   * A hyperelastic material whose energy a phase-field crack degrades: pure
   * functions of the deformation gradient $\mathbf F$, without a mesh, a point
   * or a history.
   *
   * The stored energy consists of a part that the damage releases and an intact
   * one,
   * @f[
   *   \Psi(\mathbf F, d) = g(d)\,\Psi^+(\mathbf F) + \Psi^-(\mathbf F),
   * @f]
   * (method, section 2), so that the first Piola-Kirchhoff stress and its
   * derivative are
   * @f[
   *   \mathbf P = g\,\mathbf P^+ + \mathbf P^-, \qquad
   *   \mathbf A = \frac{\partial \mathbf P}{\partial \mathbf F}
   *             = g\,\mathbf A^+ + \mathbf A^- .
   * @f]
   * The factor $g$ comes from Degradation; $\Psi^+$ drives the history field of
   * the damage equation. The systems of the assembly layer see materials
   * through this class only.
   *
   * In two space dimensions the model is plane strain, and in one dimension
   * uniaxial strain: $\mathbf F$ is completed by ones on the diagonal, and the
   * trace, the determinant and the isochoric part are those of the
   * three-dimensional tensor.
   *
   * @code
   *   const std::unique_ptr<Material<dim>> material =
   *     make_material<dim>("neo-Hookean",
   *                        EnergySplit::volumetric_deviatoric,
   *                        bulk_modulus,
   *                        shear_modulus);
   *
   *   typename Material<dim>::Response response;
   *   material->response(F, degradation.value(d), response);
   *   residual += V0 * scalar_product(response.P, grad_v * F_n);
   * @endcode
   *
   * All functions are const and free of allocations and of communication; they
   * can be called from several threads. All are abstract, although most could
   * be derived from response(), because all are called in inner loops.
   *
   * A state with $\det\mathbf F \le 0$, or with a NaN in it, raises
   * ExcSolverFailure, which makes the load stepping repeat the step with a
   * smaller increment.
   */
  template <int dim>
  class Material
  {
  public:
    /**
     * All that the displacement system needs from a point.
     */
    struct Response
    {
      /**
       * The energy density $\Psi^+$ per reference volume, not multiplied by
       * $g$.
       */
      double psi_degraded = 0.;

      /**
       * The energy density $\Psi^-$.
       */
      double psi_intact = 0.;

      /**
       * The stress $\mathbf P = g\,\mathbf P^+ + \mathbf P^-$.
       */
      Tensor<2, dim> P;

      /**
       * The tangent $A_{iJkL} = \partial P_{iJ} / \partial F_{kL}$. It has the
       * major symmetry, $A_{iJkL} = A_{kLiJ}$, but no minor ones.
       */
      Tensor<4, dim> A;
    };

    /**
     * Constructor. Both moduli must be positive, otherwise ExcParameter is
     * raised. They are those of the three-dimensional material for all @p dim.
     */
    Material(const double      bulk_modulus,
             const double      shear_modulus,
             const EnergySplit split);

    virtual ~Material() = default;

    /**
     * Return the name under which make_material() knows this material.
     */
    virtual std::string
    name() const = 0;

    /**
     * Compute the two parts of the energy density, $\Psi^+$ and $\Psi^-$.
     */
    virtual void
    energies(const Tensor<2, dim> &F,
             double               &psi_degraded,
             double               &psi_intact) const = 0;

    /**
     * Return the branch that the state @p F is on.
     */
    virtual EnergyBranch
    branch(const Tensor<2, dim> &F) const = 0;

    /**
     * Compute the stress $g\,\mathbf P^+ + \mathbf P^-$.
     */
    virtual void
    stress(const Tensor<2, dim> &F,
           const double          g,
           Tensor<2, dim>       &P,
           const EnergyBranch    branch = EnergyBranch::by_state) const = 0;

    /**
     * Return $\mathbf P^+$, the derivative of $\Psi^+$. The damage equation's
     * Nitsche term contains it.
     */
    virtual Tensor<2, dim>
    degraded_stress(const Tensor<2, dim> &F) const = 0;

    /**
     * Compute energies, stress and tangent at once.
     */
    virtual void
    response(const Tensor<2, dim> &F,
             const double          g,
             Response             &response,
             const EnergyBranch    branch = EnergyBranch::by_state) const = 0;

    /**
     * Compute stresses of several points, and tangents as well if
     * @p with_tangent, see MaterialBatch. The default is to ask stress() and
     * response() about one point after the other.
     */
    virtual void
    respond(MaterialBatch<dim> &batch, const bool with_tangent) const;

    /**
     * Compute tractions and their derivatives at several points, and second
     * derivatives as well if @p with_second, see TractionBatch. The default is
     * to ask response() and tangent_derivative() about one point after the
     * other.
     */
    virtual void
    respond(TractionBatch<dim> &batch, const bool with_second) const;

    /**
     * Return the derivative of the tangent in the direction @p W,
     * $\frac{\partial A_{iJkL}}{\partial F_{mN}} W_{mN}$. With
     * $\mathbf W = (\mathbf u-\bar{\mathbf u})\otimes\mathbf N$ this is what
     * the symmetric Nitsche term contributes to a consistent tangent (method,
     * section 3).
     */
    virtual Tensor<4, dim>
    tangent_derivative(
      const Tensor<2, dim> &F,
      const double          g,
      const Tensor<2, dim> &W,
      const EnergyBranch    branch = EnergyBranch::by_state) const = 0;

    /**
     * Raise ExcSolverFailure unless @p J is positive and finite.
     */
    static void
    check_determinant(const double J);

    /**
     * Return the bulk modulus $K$.
     */
    double
    bulk_modulus() const;

    /**
     * Return the shear modulus $G$.
     */
    double
    shear_modulus() const;

    /**
     * Return which part of the energy is degraded.
     */
    EnergySplit
    energy_split() const;

    /**
     * Return the modulus of uniaxial strain, $K + \frac43 G$. Divided by the
     * cell size, it is the unit of the penalty factor.
     */
    double
    nitsche_stiffness() const;

  protected:
    /**
     * The bulk modulus.
     */
    const double K;

    /**
     * The shear modulus.
     */
    const double G;

    /**
     * The part of the energy that is degraded.
     */
    const EnergySplit split;
  };



  // ------------------------- inline functions -------------------------

  template <int dim>
  inline double
  Material<dim>::bulk_modulus() const
  {
    return K;
  }



  template <int dim>
  inline double
  Material<dim>::shear_modulus() const
  {
    return G;
  }



  template <int dim>
  inline EnergySplit
  Material<dim>::energy_split() const
  {
    return split;
  }



  template <int dim>
  inline double
  Material<dim>::nitsche_stiffness() const
  {
    return K + 4. / 3. * G;
  }
} // namespace EBSMPM

#endif
