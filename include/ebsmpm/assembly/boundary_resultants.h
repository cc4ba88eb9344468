// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_boundary_resultants_h
#define ebsmpm_assembly_boundary_resultants_h

#include <ebsmpm/assembly/displacement_system.h>
#include <ebsmpm/assembly/point_state.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <map>
#include <vector>

namespace EBSMPM
{
  /**
   * Sums over the boundary points that say what the boundary does to the body.
   *
   * All arguments are those of DisplacementSystem at the end of a load step, in
   * which the boundary points have been given @p update. All functions are
   * collective.
   */
  namespace BoundaryResultants
  {
    /**
     * Return the sums of the flux over each of the boundaries, in the
     * directions that are prescribed, $\sum_b A_0\,\mathbf\Pi\,\mathbf f$.
     *
     * @param boundary the state at the start of the step
     * @param flux $\mathbf f$ at all points, see DisplacementSystem::flux()
     * @param ids all ids that the points of any process have
     * @param communicator the processes
     */
    template <int dim>
    std::map<types::boundary_id, Tensor<1, dim>>
    reactions(const BoundaryState<dim>              &boundary,
              const std::vector<Tensor<1, dim>>     &flux,
              const std::vector<types::boundary_id> &ids,
              const MPI_Comm                         communicator);

    /**
     * Return the force that does work on the load $u$ on which the prescribed
     * displacements depend,
     * @f[
     *   T = \sum_b A_0\, \mathbf f\cdot\frac{\partial\bar{\mathbf u}}{\partial
     *   u}.
     * @f]
     * If a boundary is pulled by $u$, this is the force on it; if the ends of a
     * beam are turned against each other by the angle $u$, it is the torque.
     *
     * @param boundary, @p flux, @p communicator as for reactions()
     * @param rates $\partial\bar{\mathbf u}/\partial u$ at all points
     */
    template <int dim>
    double
    conjugate_force(const BoundaryState<dim>          &boundary,
                    const std::vector<Tensor<1, dim>> &flux,
                    const std::vector<Tensor<1, dim>> &rates,
                    const MPI_Comm                     communicator);

    /**
     * Return the work of the (constant) tractions on the whole displacement,
     * $\sum_b A_0\,\mathbf t\cdot\mathbf u$.
     */
    template <int dim>
    double
    traction_work(const BoundaryState<dim>                       &boundary,
                  const typename DisplacementSystem<dim>::Update &update,
                  const MPI_Comm                                  communicator);

    /**
     * Return the volume that the boundaries with the numbers @p ids have given
     * free, $-\sum_b A_0\,\mathbf u\cdot\mathbf N$ (2d: the area).
     * For the two faces of a crack, this is the integral of the normal part of
     * the displacement jump: the volume of the opened crack.
     */
    template <int dim>
    double
    opened_volume(const BoundaryState<dim>                       &boundary,
                  const typename DisplacementSystem<dim>::Update &update,
                  const std::vector<types::boundary_id>          &ids,
                  const MPI_Comm                                  communicator);
  } // namespace BoundaryResultants
} // namespace EBSMPM

#endif
