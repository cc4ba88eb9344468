// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_nitsche_terms_h
#define ebsmpm_assembly_nitsche_terms_h

#include <ebsmpm/materials/degradation.h>
#include <ebsmpm/materials/material.h>

#include <ebsmpm/assembly/group_products.h>
#include <ebsmpm/assembly/local_system.h>
#include <ebsmpm/assembly/point_state.h>

#include <vector>

namespace EBSMPM
{
  /**
   * What acts on the boundary, for one group of boundary points: Dirichlet
   * conditions by Nitsche's method, the second sum of the residual of
   * DisplacementSystem, and given tractions.
   *
   * With $\mathbf w=\mathbf\Pi(\mathbf u_n+\Delta\mathbf u-\bar{\mathbf u})$,
   * where $\mathbf\Pi$ projects onto the directions that are prescribed (all,
   * some components, or the normal), the energy of the boundary terms is
   * $\sum_b A_0(\frac\beta2|\mathbf w|^2-\mathbf w\cdot\mathbf P\mathbf N)$.
   * Let $B_I$ be the functions of the cell, $\mathbf G_I=\nabla_n B_I$, and
   * @f[
   *   T^i_{kl} = N_B A_{iBkD} F_{lD}, \qquad
   *   t^i_{Jk} = T^i_{kl}\, G_{Jl}
   * @f]
   * the derivative of component $i$ of the traction $\mathbf P\mathbf N$ with
   * respect to the gradient of the increment, and to its coefficients
   * ($\mathbf F$ here is $\mathbf F_n$). With the derivative of $\mathbf A$ in
   * the direction $\mathbf W=\mathbf w\otimes\mathbf N$, $\mathrm d\mathbf A$,
   * residual and tangent are
   * @f{align*}{
   *   r_{Ij} &= \sum_b A_0 \Bigl[ B_I\,
   *     (\beta w_j - \Pi_{ji} P_{iB} N_B) - w_i\, T^i_{jl}\, G_{Il} \Bigr], \\
   *   K_{Ij,Jk} &= \sum_b A_0 \Bigl[ \beta\,\Pi_{jk}\, B_I B_J
   *     - B_I\, \Pi_{ji}\, t^i_{Jk} - \Pi_{ki}\, t^i_{Ij}\, B_J
   *     - G_{Im} F_{mB}\, \mathrm dA_{jBkD}\, F_{lD} G_{Jl} \Bigr]
   * @f}
   * (equation (6) of Sugai et al.; method, section 3). The last term is of the
   * size of the mismatch, but without it Newton's method would not be
   * quadratic. Tractions $\mathbf t$ per reference area add $-\sum_b A_0
   * B_I t_j$ to the residual, and nothing to the tangent.
   *
   * @code
   * NitscheTerms<dim> terms(material, degradation, beta);
   * terms.initialize(n_functions_per_cell, groups.max_n_points());
   * local.reinit(boundary_points, groups, group);
   * local.gather(increment);
   * terms.compute(AssemblyTask::tangent, boundary, {}, local);
   * @endcode
   *
   * These are GroupProducts in terms of value and gradient, with the
   * coefficients
   * @f{align*}{
   *   c_{i0k0} &= A_0\,\beta\,\Pi_{ik}, &
   *   c_{i0kl} &= -A_0\,\Pi_{im} T^m_{kl}, \\
   *   c_{ijk0} &= -A_0\,\Pi_{km} T^m_{ij}, &
   *   c_{ijkl} &= -A_0\, F_{jB}\,\mathrm dA_{iBkD}\,F_{lD}.
   * @f}
   *
   * The material computes several points side by side, see TractionBatch.
   * Memory is allocated by initialize() only.
   */
  template <int dim>
  class NitscheTerms
  {
  public:
    /**
     * Constructor. The objects given must live as long as this one.
     *
     * @param material the elastic energy
     * @param degradation the function $g(d)$
     * @param penalty the factor $\beta$, stress per length
     */
    NitscheTerms(const Material<dim> &material,
                 const Degradation   &degradation,
                 const double         penalty);

    /**
     * Allocate memory for groups of at most @p max_n_points points that see
     * @p n_functions functions.
     */
    void
    initialize(const unsigned int n_functions, const unsigned int max_n_points);

    /**
     * Add to the residual of @p local, and overwrite its tangent if that is
     * wanted.
     *
     * @param task what is wanted
     * @param boundary the boundary points
     * @param branches on which the points are held, or an empty array
     * @param local the group and the increment at its points
     */
    void
    compute(const AssemblyTask               task,
            const BoundaryState<dim>        &boundary,
            const std::vector<EnergyBranch> &branches,
            LocalSystem<dim>                &local);

  private:
    /** Compute the functions at the points, and what the material needs. */
    void
    evaluate(const BoundaryState<dim>        &boundary,
             const std::vector<EnergyBranch> &branches,
             const LocalSystem<dim>          &local);

    /** The numbers that the residual consists of, an array over the points. */
    double *
    dual(const unsigned int j, const unsigned int i)
    {
      return duals.data() + (j * dim + i) * batch.row_length();
    }

    /** The array of $c_{ijkl}$ for pair number @p pair of $i\le k$. */
    double *
    coefficient(const unsigned int pair,
                const unsigned int j,
                const unsigned int l)
    {
      return coefficients.data() +
             ((pair * (dim + 1) + j) * (dim + 1) + l) * batch.row_length();
    }

    /** The array of $\Pi_{ij}$. */
    double *
    projection(const unsigned int i, const unsigned int j)
    {
      return projections.data() + (i * dim + j) * batch.row_length();
    }

    /** Combine the answers of the material for several points side by side. */
    struct Combine;
    friend struct Combine;

    const Material<dim> &material;
    const Degradation   &degradation;
    const double         beta;

    TractionBatch<dim>          batch;
    GroupProducts<dim, dim + 1> products;

    std::vector<double> projections;
    bool                is_diagonal = true;
    std::vector<double> duals;
    std::vector<double> coefficients;
  };
} // namespace EBSMPM

#endif
