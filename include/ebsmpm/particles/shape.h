// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_shape_h
#define ebsmpm_particles_shape_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace EBSMPM
{
  /**
   * A flat piece of the surface of a Shape: a segment in 2d, a parallelogram
   * in 3d. It becomes one boundary point, see PointGenerator::boundary().
   */
  template <int dim>
  struct BoundaryElement
  {
    /**
     * The centre of the element.
     */
    Point<dim> midpoint;

    /**
     * The length of the element in 2d, its area in 3d.
     */
    double area;

    /**
     * The unit normal, which points out of the body.
     */
    Tensor<1, dim> normal;

    /**
     * The <tt>dim-1</tt> vectors from the centre of the element to the centres
     * of its sides. They let a set operation cut the element where the other
     * body begins. All zero if the element must not be cut, since it is only
     * an approximation of something curved.
     */
    std::array<Tensor<1, dim>, dim - 1> half_axes;
  };



  /**
   * A body, described by the points that belong to it and by its surface.
   *
   * Shapes say what is to be filled with material points, where the points are
   * denser, which part of the surface carries a boundary condition, and where
   * a notch is. They know of no grid. Derived classes are the primitives
   * BoxShape, BallShape, HalfSpaceShape and ExpressionShape; the set operations
   * UnionShape, IntersectionShape and DifferenceShape; and TransformedShape,
   * which moves any of them. parse_shape() builds all of them from one line of
   * a parameter file, for instance
   * @code
   *   const auto plate =
   *     parse_shape<2>("box(0,0, 1,1) - ball(0.5,0.5, 0.2)");
   *   if (plate->contains(Point<2>(0.1, 0.1)))
   *     ...
   *   for (const BoundaryElement<2> &e : plate->boundary_elements(0.01))
   *     length += e.area;
   * @endcode
   *
   * <h3>Points on the surface</h3>
   *
   * A body whose edge runs through the centres of sub-cells, or two bodies that
   * share a face, must not be at the mercy of the last digit. contains()
   * therefore decides as if the point was moved by a tiny amount, $10^{-12}$
   * of the size of the body, into the direction of the coordinate axes: a face
   * that looks into the negative direction of an axis belongs to the body, the
   * opposite one does not. Two boxes side by side then share no point, and
   * leave none out.
   */
  template <int dim>
  class Shape
  {
  public:
    /**
     * Destructor.
     */
    virtual ~Shape() = default;

    /**
     * Return whether the point @p p belongs to the body.
     */
    virtual bool
    contains(const Point<dim> &p) const = 0;

    /**
     * Return a box that contains the body. Where the body has no end, the box
     * ends at a number so large that it means infinity, see is_bounded().
     */
    virtual BoundingBox<dim>
    bounding_box() const = 0;

    /**
     * Return the pieces of the surface, not longer than @p spacing, that are
     * needed to cover what is in the box @p window. A body of finite size may
     * ignore the window.
     *
     * The sum of the areas is the area of the surface up to rounding, for all
     * primitives, and also for their combinations wherever something cuts a
     * flat surface in 2d, or parallel to the elements in 3d (if the cut is
     * oblique, up to $10^{-5}$ of @p spacing). Otherwise (an oblique plane
     * through a 3d box, or anything that cuts a ball) it is accurate to a
     * fraction of @p spacing times the length of the cut.
     */
    virtual std::vector<BoundaryElement<dim>>
    boundary_elements(const double            spacing,
                      const BoundingBox<dim> &window) const = 0;

    /**
     * The same for the whole surface. The body must be bounded; otherwise
     * ExcInput is thrown.
     */
    std::vector<BoundaryElement<dim>>
    boundary_elements(const double spacing) const;
  };



  /**
   * Return the box that stands for the whole space.
   */
  template <int dim>
  BoundingBox<dim>
  unbounded_box();



  /**
   * Return whether @p box is bounded in all directions.
   */
  template <int dim>
  bool
  is_bounded(const BoundingBox<dim> &box);
} // namespace EBSMPM

#endif
