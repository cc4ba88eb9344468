// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_fracture_crack_opening_h
#define ebsmpm_fracture_crack_opening_h

#include <ebsmpm/fracture/crack_partition.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace EBSMPM
{
  /** How far the lips of the discrete cracks are apart. */
  struct CrackOpening
  {
    /**
     * The smallest opening of all functions with material on both sides, zero
     * if there are none. It is negative where lips overlap: they have no
     * contact.
     */
    double smallest = 0.;
  };



  /**
   * Measure the opening of the cracks at all functions that their two sides
   * read differently. With the mean positions $\bar{\mathbf x}$ and reference
   * positions $\bar{\mathbf X}$ of the points of either side in the support
   * (weighted by function and volume), it is
   * @f[
   *   g_I = (\bar{\mathbf x}_\text{other}-\bar{\mathbf x}_\text{own})\cdot
   *   \mathbf m_I - (\bar{\mathbf X}_\text{other}-\bar{\mathbf X}_\text{own})
   *   \cdot\mathbf M_I, \qquad
   *   \mathbf M_I = \frac{\bar{\mathbf F}^T\mathbf m_I}{|\bar{\mathbf
   *   F}^T\mathbf m_I|},
   * @f]
   * where $\mathbf m_I$, the side vector, points from the function's own side
   * to the other one. Where a crack is open so wide that no support reaches
   * across, there is nothing to measure. Collective.
   *
   * @param points where the points were at the start of the step
   * @param partition the partition of the step
   * @param volumes of the points
   * @param displacements of the points at the start of the step
   * @param increments of the displacement during the step
   * @param F deformation gradients at the end of the step
   */
  template <int dim>
  CrackOpening
  crack_opening(const CellPoints<dim>             &points,
                const CrackPartition<dim>         &partition,
                const std::vector<double>         &volumes,
                const std::vector<Tensor<1, dim>> &displacements,
                const std::vector<Tensor<1, dim>> &increments,
                const std::vector<Tensor<2, dim>> &F);
} // namespace EBSMPM

#endif
