// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_transformed_shape_h
#define ebsmpm_particles_transformed_shape_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/shape.h>

#include <memory>

namespace EBSMPM
{
  /**
   * A body that has been rotated about the origin and then shifted: all points
   * $R x + t$ with x in the original body.
   *
   * @code
   *   const auto square =
   *     std::make_shared<BoxShape<2>>(Point<2>(), Point<2>(1, 1));
   *   const TransformedShape<2> tilted(
   *     square,
   *     Physics::Transformations::Rotations::rotation_matrix_2d(0.4));
   * @endcode
   */
  template <int dim>
  class TransformedShape : public Shape<dim>
  {
  public:
    /**
     * Constructor. The matrix @p rotation must be orthogonal.
     */
    TransformedShape(const std::shared_ptr<const Shape<dim>> &shape,
                     const Tensor<2, dim>                    &rotation,
                     const Tensor<1, dim> &translation = Tensor<1, dim>());

    bool
    contains(const Point<dim> &p) const override;

    BoundingBox<dim>
    bounding_box() const override;

    using Shape<dim>::boundary_elements;

    std::vector<BoundaryElement<dim>>
    boundary_elements(const double            spacing,
                      const BoundingBox<dim> &window) const override;

  private:
    const std::shared_ptr<const Shape<dim>> shape;
    const Tensor<2, dim>                    rotation;
    const Tensor<1, dim>                    translation;
  };
} // namespace EBSMPM

#endif
