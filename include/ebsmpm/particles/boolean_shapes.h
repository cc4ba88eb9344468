// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_boolean_shapes_h
#define ebsmpm_particles_boolean_shapes_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/shape.h>

#include <memory>

namespace EBSMPM
{
  /**
   * What the set operations UnionShape, IntersectionShape and DifferenceShape
   * have in common: two bodies A and B, and the way the surface is found.
   *
   * The surface of a combination consists of those parts of the surfaces of A
   * and B across which the combination really changes. Whether it does is found
   * by looking at two points, a tiny step before and behind the surface. Since
   * on the surface of A the state of A is known, it is enough to ask the other
   * body:
   * <table>
   * <tr><th></th> <th>keep of A</th> <th>keep of B</th></tr>
   * <tr><td>A + B</td> <td>B is not outside</td>
   *     <td>A is neither outside nor inside</td></tr>
   * <tr><td>A & B</td> <td>B is inside</td> <td>A is on both sides</td></tr>
   * <tr><td>A - B</td> <td>B is not inside</td>
   *     <td>A is on both sides; the normal is reversed</td></tr>
   * </table>
   * Here "inside" and "outside" mean the point a step against and along the
   * normal. The conditions for B are strict, so that a face that A and B have
   * in common is taken from A and does not appear twice, or not at all where
   * the two bodies touch from opposite sides.
   *
   * An element that is partly kept is cut, see Shape::boundary_elements().
   */
  template <int dim>
  class BooleanShape : public Shape<dim>
  {
  public:
    /**
     * Constructor with the bodies A and B.
     */
    BooleanShape(const std::shared_ptr<const Shape<dim>> &a,
                 const std::shared_ptr<const Shape<dim>> &b);

    using Shape<dim>::boundary_elements;

    std::vector<BoundaryElement<dim>>
    boundary_elements(const double            spacing,
                      const BoundingBox<dim> &window) const override;

  protected:
    /**
     * Which of the two bodies an element comes from.
     */
    enum class Origin
    {
      a,
      b
    };

    /**
     * Return whether a surface element of one body belongs to the surface of
     * the combination, if a step against (@p inside) and along (@p outside) its
     * normal is in the other body.
     */
    virtual bool
    keep(const Origin origin, const bool inside, const bool outside) const = 0;

    /**
     * Return 1, or -1 if the normals of the elements of B are to be reversed.
     */
    virtual double
    orientation_of_b() const;

    const std::shared_ptr<const Shape<dim>> a;
    const std::shared_ptr<const Shape<dim>> b;

  private:
    void
    add_elements(const Origin                             origin,
                 const double                             spacing,
                 const std::vector<BoundaryElement<dim>> &candidates,
                 std::vector<BoundaryElement<dim>>       &elements) const;
  };



  /**
   * All points of A or B.
   */
  template <int dim>
  class UnionShape : public BooleanShape<dim>
  {
  public:
    using BooleanShape<dim>::BooleanShape;

    bool
    contains(const Point<dim> &p) const override;

    BoundingBox<dim>
    bounding_box() const override;

  protected:
    bool
    keep(const typename BooleanShape<dim>::Origin origin,
         const bool                               inside,
         const bool                               outside) const override;
  };



  /**
   * All points of both A and B.
   */
  template <int dim>
  class IntersectionShape : public BooleanShape<dim>
  {
  public:
    using BooleanShape<dim>::BooleanShape;

    bool
    contains(const Point<dim> &p) const override;

    BoundingBox<dim>
    bounding_box() const override;

  protected:
    bool
    keep(const typename BooleanShape<dim>::Origin origin,
         const bool                               inside,
         const bool                               outside) const override;
  };



  /**
   * All points of A that are not in B.
   */
  template <int dim>
  class DifferenceShape : public BooleanShape<dim>
  {
  public:
    using BooleanShape<dim>::BooleanShape;

    bool
    contains(const Point<dim> &p) const override;

    BoundingBox<dim>
    bounding_box() const override;

  protected:
    bool
    keep(const typename BooleanShape<dim>::Origin origin,
         const bool                               inside,
         const bool                               outside) const override;

    double
    orientation_of_b() const override;
  };
} // namespace EBSMPM

#endif
