// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_point_values_h
#define ebsmpm_assembly_point_values_h

#include <ebsmpm/materials/material.h>

#include <ebsmpm/assembly/point_state.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace EBSMPM
{
  /**
   * Return the deformation gradient at the end of the step,
   * $\mathbf F=(\mathbf I+\nabla_n\Delta\mathbf u)\mathbf F_n$.
   *
   * @param gradient of the increment; row $a$ is that of component $a$
   * @param F_n deformation gradient at the start of the step
   */
  template <int dim>
  inline Tensor<2, dim>
  deformation(const std::array<Tensor<1, dim>, dim> &gradient,
              const Tensor<2, dim>                  &F_n)
  {
    Tensor<2, dim> F = F_n;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          F[i][k] += gradient[i][j] * F_n[j][k];
    return F;
  }



  /**
   * Return what is unmet of the Dirichlet condition at boundary point @p q,
   * $\mathbf w=\mathbf\Pi(\mathbf u_n+\Delta\mathbf u-\bar{\mathbf u})$.
   */
  template <int dim>
  inline Tensor<1, dim>
  mismatch(const BoundaryState<dim> &boundary,
           const unsigned int        q,
           const Tensor<1, dim>     &increment)
  {
    return boundary.projection[q] *
           (boundary.displacement[q] + increment - boundary.prescribed[q]);
  }



  /**
   * Return the branch that point @p q is held on. If the array is empty, no
   * point is held on any.
   */
  inline EnergyBranch
  branch_of(const std::vector<EnergyBranch> &branches, const unsigned int q)
  {
    return branches.empty() ? EnergyBranch::by_state : branches[q];
  }
} // namespace EBSMPM

#endif
