// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_point_state_h
#define ebsmpm_assembly_point_state_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <vector>

namespace EBSMPM
{
  /**
   * What the systems of the assembly have to know about the material points, in
   * plain arrays with the numbering of CellPoints.
   *
   * Most of it is the accepted state at the start of the load step, which does
   * not change until the step is accepted; the damage and the history field are
   * the current iterates. Since the points themselves are written only when the
   * step is accepted, a failed step leaves nothing to restore.
   */
  template <int dim>
  struct MaterialState
  {
    /** Reference volume $V_0$. */
    std::vector<double> volume;

    /** Deformation gradient $\mathbf F_n$ at the start of the step. */
    std::vector<Tensor<2, dim>> F;

    /** Damage, the current iterate, in $[0,1]$. */
    std::vector<double> damage;

    /** History field $\mathcal H$, the current iterate. */
    std::vector<double> history;

    /** Give all arrays the size @p n. */
    void
    resize(const unsigned int n)
    {
      volume.resize(n);
      F.resize(n);
      damage.resize(n);
      history.resize(n);
    }
  };



  /**
   * What the systems have to know about the boundary points: the same as for
   * the material points, and the boundary data at the end of the step.
   */
  template <int dim>
  struct BoundaryState
  {
    /** Reference area $A_0$. */
    std::vector<double> area;

    /** Reference unit outward normal $\mathbf N$. */
    std::vector<Tensor<1, dim>> normal;

    /** Displacement $\mathbf u_n$ at the start of the step. */
    std::vector<Tensor<1, dim>> displacement;

    /** Deformation gradient $\mathbf F_n$ at the start of the step. */
    std::vector<Tensor<2, dim>> F;

    /** Damage, the current iterate. */
    std::vector<double> damage;

    /** Boundary id. */
    std::vector<types::boundary_id> boundary_id;

    /** Prescribed displacement $\bar{\mathbf u}$ at the end of the step. */
    std::vector<Tensor<1, dim>> prescribed;

    /**
     * The projection $\mathbf\Pi$ onto the directions in which the displacement
     * is prescribed; the others are free of traction. The identity where the
     * body is held, $\mathbf N\otimes\mathbf N$ where it slides along the
     * boundary.
     */
    std::vector<SymmetricTensor<2, dim>> projection;

    /**
     * Force per reference area at the end of the step, $\mathbf t$, in
     * directions that are not prescribed.
     */
    std::vector<Tensor<1, dim>> traction;

    /** Give all arrays the size @p n. */
    void
    resize(const unsigned int n)
    {
      area.resize(n);
      normal.resize(n);
      displacement.resize(n);
      F.resize(n);
      damage.resize(n);
      boundary_id.resize(n);
      prescribed.resize(n);
      projection.resize(n);
      traction.resize(n);
    }
  };
} // namespace EBSMPM

#endif
