// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_notch_h
#define ebsmpm_particles_notch_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/boundary_points.h>
#include <ebsmpm/particles/material_points.h>
#include <ebsmpm/particles/shape.h>

#include <memory>

namespace EBSMPM
{
  /**
   * Initial cracks. There are three ways to give a body one:
   * <ol>
   * <li>A gap: do not fill it with points in the first place. The shape of the
   * body is a difference,
   * <tt>box(0,0, 1,1) - box(0,0.49, 0.5,0.51)</tt>. Quadratic splines bridge a
   * gap of one or two cells; it takes three, or a slit in addition, to separate
   * its sides.</li>
   * <li>A slit: the body is complete, but the points next to a plane know from
   * the start to which side of it they belong, see label_slit(). This is the
   * mechanism of growing cracks.</li>
   * <li>Damage: a large history in a band, see initial_history().</li>
   * </ol>
   */
  namespace Notch
  {
    /**
     * A slit: the part of a plane (line in 2d) that is open.
     *
     * @code
     *        ________________________________
     *   w   |  side = -n             |  ahead|
     *   d   |########################|       |      ^ n
     *   ----+========================+-------+---   |   plane
     *   d   |########################|       |
     *   w   |  side = +n  ___________|_______|
     *           open                   r
     * @endcode
     * Points within @p label_width (w) of the plane get a side, also a bit
     * ahead of the tip (r), where functions of the slit reach. Points within
     * @p damage_width (d) of the open part (#) have a peak damage of 1.
     */
    template <int dim>
    struct Slit
    {
      /**
       * A point on the plane.
       */
      Point<dim> point;

      /**
       * The normal of the plane, of any length.
       */
      Tensor<1, dim> normal;

      /**
       * Where the slit is open: a point of the plane is on it if it is in this
       * body, for example a half space whose plane goes through the tip.
       */
      std::shared_ptr<const Shape<dim>> open_region;

      /**
       * How far from the plane points are labelled. Four cells is a good
       * choice.
       */
      double label_width;

      /**
       * How far ahead of the tip points are labelled, or zero for the label
       * width. Labels are for ever: a crack that turns right at the tip needs
       * them to be few. Two cells is where points read functions of the slit.
       */
      double label_reach = 0.;

      /**
       * How far from the plane points count as broken. It should reach a
       * cell or two, so that all functions next to the plane are separable.
       */
      double damage_width;

      /**
       * How far behind the tip points count as broken. The opening of quadratic
       * splines reaches beyond the last function that is separable: with zero,
       * a slit acts as if it was longer by a quarter of a cell to one and a
       * quarter, according to where its tip is in the cell; with 0.45 cells, by
       * minus to plus half a cell.
       */
      double tip_margin = 0.;
    };



    /**
     * Add boundary points on both faces of a slit, as far as it is open and in
     * @p body: at the same positions, each with the area and with the normal
     * that points out of the material on its side, into the slit. To be called
     * before label_slit(). Collective.
     *
     * @code
     *   --------x--------x--------x------   upper: normal -n, number upper_id
     *           |        |        |              (n points upwards)
     *   --------x--------x--------x------   lower: normal +n, number lower_id
     * @endcode
     *
     * @param body the body that has the slit
     * @param spacing the largest length of the elements
     * @param lower_id, @p upper_id the numbers that the points get
     * @param boundary_points get the new points
     */
    template <int dim>
    void
    add_faces(const Slit<dim>                         &slit,
              const std::shared_ptr<const Shape<dim>> &body,
              const double                             spacing,
              const types::boundary_id                 lower_id,
              const types::boundary_id                 upper_id,
              BoundaryPoints<dim>                     &boundary_points);



    /**
     * Give the points next to a slit their labels: the side vector, which is
     * the unit vector perpendicular to the plane and towards it; "frozen"; and
     * the peak damage. A point on the plane (up to $10^{-10}$ label widths)
     * counts as being on the side to which the normal points; but a boundary
     * point there whose own normal is along the plane's, on a face of the slit,
     * is on the side out of which its normal points.
     *
     * Both kinds of points are to be in their reference positions.
     */
    template <int dim>
    void
    label_slit(const Slit<dim>     &slit,
               MaterialPoints<dim> &points,
               BoundaryPoints<dim> &boundary_points);



    /**
     * Set the history of all points in @p shape to @p value, except where it is
     * larger already. In terms of the fracture energy and the length scale, the
     * damage that belongs to a history H without gradients is
     * $d = H/(H+G_c/(2l))$.
     */
    template <int dim>
    void
    initial_history(const Shape<dim>    &shape,
                    const double         value,
                    MaterialPoints<dim> &points);
  } // namespace Notch
} // namespace EBSMPM

#endif
