// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_generators_h
#define ebsmpm_particles_generators_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/boundary_points.h>
#include <ebsmpm/particles/material_points.h>
#include <ebsmpm/particles/shape.h>

#include <memory>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * Functions that create the points of a body.
   *
   * The body is described by a Shape and has nothing to do with the grid, which
   * must only be large enough. A specimen with a fixed lower and a driven upper
   * edge, for example:
   * @code
   *   const auto body = parse_shape<2>("box(0,0, 1,1)");
   *
   *   PointGenerator::FillData<2> data;
   *   data.n_points_per_direction = 3;
   *   MaterialPoints<2> points(triangulation, mapping);
   *   PointGenerator::fill(*body, data, points);
   *
   *   BoundaryPoints<2> boundary_points(triangulation, mapping);
   *   PointGenerator::boundary(*body,
   *                            {{0, "y < 1e-6"}, {1, "y > 1 - 1e-6"}},
   *                            0.5 * cell_size,
   *                            boundary_points);
   * @endcode
   * All functions give the same points, with the same numbers, on any number of
   * processes.
   */
  namespace PointGenerator
  {
    /**
     * Where the points of a cell are.
     */
    enum class Layout
    {
      /**
       * The cell is divided into equal boxes. There is a point of the box's
       * volume at the centre of each if that is in the body. Points stay well
       * distributed when they move; this is the usual choice.
       */
      midpoint,

      /**
       * The points and weights of Gauss quadrature. This integrates polynomials
       * exactly, but only as long as the body consists of whole cells and the
       * points have not moved; where the surface cuts a cell, the volume is
       * less accurate than with midpoints.
       */
      gauss
    };



    /**
     * A part of the body in which points are denser or less dense.
     */
    template <int dim>
    struct Region
    {
      std::shared_ptr<const Shape<dim>> shape;
      unsigned int                      n_points_per_direction;
    };



    /**
     * How to fill a body.
     */
    template <int dim>
    struct FillData
    {
      /**
       * The number of points per cell and direction.
       */
      unsigned int n_points_per_direction = 3;

      /**
       * Where these points are.
       */
      Layout layout = Layout::midpoint;

      /**
       * Exceptions from the number of points. A cell whose centre is in one of
       * these regions, the first if in several, gets the region's number.
       */
      std::vector<Region<dim>> regions = {};

      /**
       * The points in these bodies cannot be damaged.
       */
      std::vector<std::shared_ptr<const Shape<dim>>> undamageable = {};
    };



    /**
     * A part of the surface that gets boundary points.
     */
    struct BoundarySelection
    {
      /**
       * The number that the points carry.
       */
      types::boundary_id boundary_id;

      /**
       * An Expression in the variables x, y, z of the position and nx, ny, nz
       * of the outward normal (without the last ones in 2d). What is not zero
       * there, is selected; "1" selects everything.
       */
      std::string condition;
    };



    /**
     * Return how many points fill() will create in a cell. This is what the
     * weights for the distribution of the grid are made of, before there are
     * points.
     */
    template <int dim>
    unsigned int
    count_points_in_cell(
      const Shape<dim>                                        &shape,
      const FillData<dim>                                     &data,
      const typename Triangulation<dim>::active_cell_iterator &cell);



    /**
     * Add the points of the body @p shape to @p points. Collective.
     *
     * A body that reaches beyond the grid is cut off there without a message:
     * compare MaterialPoints::total_volume().
     */
    template <int dim>
    void
    fill(const Shape<dim>    &shape,
         const FillData<dim> &data,
         MaterialPoints<dim> &points);



    /**
     * Add a boundary point at the centre of each element, with the number given
     * for it. All processes give all elements, and keep what is in their cells.
     * Collective.
     *
     * Every point goes to the cell that contains the body just behind the
     * point, so an edge may run along grid lines, and along the rim of the
     * grid. If a point is outside of the grid, ExcPointOutsideGrid is thrown on
     * all processes.
     */
    template <int dim>
    void
    insert_elements(const std::vector<BoundaryElement<dim>> &elements,
                    const std::vector<types::boundary_id>   &boundary_ids,
                    BoundaryPoints<dim>                     &points);



    /**
     * Divide the surface of @p shape into elements not longer than @p spacing,
     * and add a boundary point at the centre of each that one of the
     * @p selections wants; the first one that does gives the number.
     * See insert_elements(). Collective.
     */
    template <int dim>
    void
    boundary(const Shape<dim>                     &shape,
             const std::vector<BoundarySelection> &selections,
             const double                          spacing,
             BoundaryPoints<dim>                  &points);
  } // namespace PointGenerator
} // namespace EBSMPM

#endif
