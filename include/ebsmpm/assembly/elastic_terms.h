// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_elastic_terms_h
#define ebsmpm_assembly_elastic_terms_h

#include <ebsmpm/materials/degradation.h>
#include <ebsmpm/materials/material.h>

#include <ebsmpm/assembly/group_products.h>
#include <ebsmpm/assembly/local_system.h>
#include <ebsmpm/assembly/point_state.h>

#include <vector>

namespace EBSMPM
{
  /**
   * The virtual work of the stress, for one group of material points: the first
   * sum of the residual of DisplacementSystem.
   *
   * With the gradients $\mathbf G_I=\nabla_n B_I$ of the functions of the cell,
   * and $\mathbf c_{ijkl}=V_0 F_{jB} A_{iBkD} F_{lD}$ (where $\mathbf F$ is
   * that at the start of the step), residual and tangent are
   * @f[
   *   r_{Ii} = \sum_p V_0 (\mathbf P\mathbf F_n^T)_{ij}\, G_{Ij}, \qquad
   *   K_{Ii,Jk} = \sum_p G_{Ij}\, c_{ijkl}\, G_{Jl}
   * @f]
   * (method, section 1). The tangent of all points is computed as a single
   * product $\mathbf G^T(\mathbf c\,\mathbf G)$ of matrices whose rows are
   * points and directions, see GroupProducts; and the material computes
   * several points side by side, see MaterialBatch.
   *
   * @code
   * ElasticTerms<dim> terms(material, degradation);
   * terms.initialize(n_functions_per_cell, groups.max_n_points());
   * local.reinit(points, groups, group);
   * local.gather(increment);
   * terms.compute(AssemblyTask::tangent, state, {}, local);
   * @endcode
   *
   * Memory is allocated by initialize() only.
   */
  template <int dim>
  class ElasticTerms
  {
  public:
    /** Constructor. The objects given must live as long as this one. */
    ElasticTerms(const Material<dim> &material, const Degradation &degradation);

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
     * @param state the material points
     * @param branches on which the points are held, or an empty array
     * @param local the group and the increment at its points
     */
    void
    compute(const AssemblyTask               task,
            const MaterialState<dim>        &state,
            const std::vector<EnergyBranch> &branches,
            LocalSystem<dim>                &local);

  private:
    /** Compute the gradients of all functions, and what the material needs. */
    void
    deform(const MaterialState<dim>        &state,
           const std::vector<EnergyBranch> &branches,
           const LocalSystem<dim>          &local);

    /** Add to the residual, from the stress at all points. */
    void
    add_residual(LocalSystem<dim> &local);

    const Material<dim> &material;
    const Degradation   &degradation;

    MaterialBatch<dim>      batch;
    GroupProducts<dim, dim> products;
  };
} // namespace EBSMPM

#endif
