// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_supports_h
#define ebsmpm_assembly_supports_h

#include <ebsmpm/splines/spline_space.h>

#include <ebsmpm/particles/cell_points.h>

#include <ebsmpm/assembly/point_groups.h>

#include <vector>

namespace EBSMPM
{
  /**
   * Add to @p supports what points say about the functions they read: that
   * these exist, and the fraction of them that the points occupy,
   * @f[
   *   \phi_I \mathrel{+}= \frac{\sum_p B_I(\mathbf x_p) v_p}{\int B_I}.
   * @f]
   * The result is what SplineSpace::reinit() wants.
   *
   * Boundary points have no volume, but the functions they read must exist as
   * well, where a boundary lies on the rim of the last cell with material.
   * These get their value by extension.
   *
   * @param points the points
   * @param volumes current volume $v_p$ of each point; an empty array stands
   *   for points without volume
   * @param patterns which functions are read as twins, see PointGroups; may be
   *   empty
   * @param space tells which functions a cell sees
   * @param supports table to which the shares are added
   */
  template <int dim>
  void
  add_supports(const CellPoints<dim>                                 &points,
               const std::vector<double>                             &volumes,
               const std::vector<typename PointGroups<dim>::Pattern> &patterns,
               const SplineSpace<dim>                                &space,
               typename SplineSpace<dim>::SupportTable               &supports);
} // namespace EBSMPM

#endif
