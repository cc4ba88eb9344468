// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_material_points_h
#define ebsmpm_particles_material_points_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/material_point.h>
#include <ebsmpm/particles/point_set.h>

#include <vector>

namespace EBSMPM
{
  /**
   * All material points: the quadrature points of the method, which carry
   * everything that has a history.
   *
   * PointGenerator::fill() creates the points of a body, insert() any others;
   * then points.handler() gives access cell by cell, and MaterialPoint to the
   * state of each:
   * @code
   *   MaterialPoints<dim> points(triangulation, mapping);
   *   PointGenerator::fill(*parse_shape<dim>("ball(0,0, 1)"), {}, points);
   *
   *   for (const auto &cell : triangulation.active_cell_iterators())
   *     if (cell->is_locally_owned())
   *       for (auto &particle : points.handler().particles_in_cell(cell))
   *         {
   *           MaterialPoint<dim> point(particle.get_properties());
   *           mass += density * point.reference_volume();
   *         }
   * @endcode
   * After the points were moved, sort() must be called. See PointSet for what
   * holds in parallel.
   */
  template <int dim>
  class MaterialPoints : public PointSet<dim, MaterialPoint<dim>>
  {
  public:
    /**
     * A material point to be inserted. It is in its reference state, without
     * displacement and damage.
     */
    struct Record
    {
      Point<dim> location;

      /**
       * The locally owned cell that contains the point.
       */
      typename Triangulation<dim>::active_cell_iterator cell;

      double volume;
      bool   damageable = true;
    };

    using PointSet<dim, MaterialPoint<dim>>::PointSet;

    /**
     * Add points. Each process gives those in its own cells. Collective.
     *
     * The numbers depend on the order of the records of one cell only.
     */
    void
    insert(const std::vector<Record> &records);

    /**
     * Return the sum of all reference volumes. Collective.
     */
    double
    total_volume() const;
  };
} // namespace EBSMPM

#endif
