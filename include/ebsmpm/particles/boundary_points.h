// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_boundary_points_h
#define ebsmpm_particles_boundary_points_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/boundary_point.h>
#include <ebsmpm/particles/point_set.h>

#include <vector>

namespace EBSMPM
{
  /**
   * All boundary points: the quadrature points for boundary conditions, which
   * move with the body like MaterialPoints.
   *
   * PointGenerator::boundary() creates them from the surface of a body. Where
   * the boundary lies on a grid line, a point is in the cell on the body's
   * side; sort() keeps that up while the body moves.
   */
  template <int dim>
  class BoundaryPoints : public PointSet<dim, BoundaryPoint<dim>>
  {
  public:
    /**
     * A boundary point to be inserted.
     */
    struct Record
    {
      Point<dim> location;

      /**
       * The locally owned cell that contains the point.
       */
      typename Triangulation<dim>::active_cell_iterator cell;

      double             area;
      Tensor<1, dim>     normal;
      types::boundary_id boundary_id;
    };

    using PointSet<dim, BoundaryPoint<dim>>::PointSet;

    /**
     * Add points. Each process gives those in its own cells. Collective.
     *
     * The numbers depend on the order of the records of one cell only.
     */
    void
    insert(const std::vector<Record> &records);

    /**
     * Return the sum of the reference areas of the points of one part of the
     * boundary. Collective.
     */
    double
    total_area(const types::boundary_id boundary_id) const;
  };
} // namespace EBSMPM

#endif
