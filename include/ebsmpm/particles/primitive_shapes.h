// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_primitive_shapes_h
#define ebsmpm_particles_primitive_shapes_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/shape.h>

#include <deal.II/base/function_parser.h>

#include <map>
#include <string>

namespace EBSMPM
{
  /**
   * The box with the opposite corners @p lower and @p upper, a rectangle in 2d.
   */
  template <int dim>
  class BoxShape : public Shape<dim>
  {
  public:
    /**
     * Constructor. @p lower must be below @p upper in all components, otherwise
     * ExcInput is thrown.
     */
    BoxShape(const Point<dim> &lower, const Point<dim> &upper);

    bool
    contains(const Point<dim> &p) const override;

    BoundingBox<dim>
    bounding_box() const override;

    using Shape<dim>::boundary_elements;

    /**
     * Every face is divided evenly.
     */
    std::vector<BoundaryElement<dim>>
    boundary_elements(const double            spacing,
                      const BoundingBox<dim> &window) const override;

  private:
    const Point<dim> lower;
    const Point<dim> upper;
    const double     tolerance;
  };



  /**
   * The ball with the given centre and radius, a disc in 2d.
   */
  template <int dim>
  class BallShape : public Shape<dim>
  {
  public:
    /**
     * Constructor. The radius must be positive, otherwise ExcInput is thrown.
     */
    BallShape(const Point<dim> &center, const double radius);

    bool
    contains(const Point<dim> &p) const override;

    BoundingBox<dim>
    bounding_box() const override;

    using Shape<dim>::boundary_elements;

    /**
     * The midpoints are on the circle or sphere and the areas are those of the
     * curved pieces, so that both the area of the surface and the volume
     * $\frac{1}{\text{dim}}\sum_b A_b\, x_b\cdot N_b$ are exact. In 3d the
     * pieces are arranged in bands around the z-axis.
     */
    std::vector<BoundaryElement<dim>>
    boundary_elements(const double            spacing,
                      const BoundingBox<dim> &window) const override;

  private:
    const Point<dim> center;
    const double     radius;
  };



  /**
   * Everything on one side of a plane, or of a line in 2d: all points with
   * $(x-p)\cdot n<0$.
   */
  template <int dim>
  class HalfSpaceShape : public Shape<dim>
  {
  public:
    /**
     * Constructor with a point on the plane and the normal, which points out
     * of the body and need not be of unit length. If it is zero, ExcInput is
     * thrown.
     */
    HalfSpaceShape(const Point<dim> &point, const Tensor<1, dim> &normal);

    bool
    contains(const Point<dim> &p) const override;

    BoundingBox<dim>
    bounding_box() const override;

    using Shape<dim>::boundary_elements;

    /**
     * Squares of the length @p spacing, as many as it takes to cover the
     * projection of @p window onto the plane.
     */
    std::vector<BoundaryElement<dim>>
    boundary_elements(const double            spacing,
                      const BoundingBox<dim> &window) const override;

  private:
    const Point<dim>     point;
    const Tensor<1, dim> normal;

    /**
     * The side to which a point on the plane belongs: the sign of the first
     * component of the normal that is not zero.
     */
    const double tie;
  };



  /**
   * All points where an expression in x, y, z is negative.
   *
   * It has the syntax of deal.II's FunctionParser and may use the constant pi
   * and those given. Such a body can be filled, and cut out of another one, but
   * offers no surface: use it for refined regions, or for bodies that carry no
   * boundary conditions.
   */
  template <int dim>
  class ExpressionShape : public Shape<dim>
  {
  public:
    /**
     * Constructor. If the expression cannot be evaluated, ExcInput is thrown.
     */
    ExpressionShape(const std::string                   &expression,
                    const std::map<std::string, double> &constants = {});

    bool
    contains(const Point<dim> &p) const override;

    BoundingBox<dim>
    bounding_box() const override;

    using Shape<dim>::boundary_elements;

    /**
     * Return nothing.
     */
    std::vector<BoundaryElement<dim>>
    boundary_elements(const double            spacing,
                      const BoundingBox<dim> &window) const override;

  private:
    FunctionParser<dim> function;
  };
} // namespace EBSMPM

#endif
