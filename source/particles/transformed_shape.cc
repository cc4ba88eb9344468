// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/particles/transformed_shape.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/symmetric_tensor.h>

namespace EBSMPM
{
  namespace
  {
    // The box around the rotated and shifted corners of a box.
    template <int dim>
    BoundingBox<dim>
    transform(const BoundingBox<dim> &box,
              const Tensor<2, dim>   &rotation,
              const Tensor<1, dim>   &translation)
    {
      if (!is_bounded(box))
        return unbounded_box<dim>();

      std::vector<Point<dim>> corners;
      for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_cell; ++v)
        corners.emplace_back(rotation * Tensor<1, dim>(box.vertex(v)) +
                             translation);
      return BoundingBox<dim>(corners);
    }
  } // namespace



  template <int dim>
  TransformedShape<dim>::TransformedShape(
    const std::shared_ptr<const Shape<dim>> &shape,
    const Tensor<2, dim>                    &rotation,
    const Tensor<1, dim>                    &translation)
    : shape(shape)
    , rotation(rotation)
    , translation(translation)
  {
    Assert((rotation * transpose(rotation) - unit_symmetric_tensor<dim>())
               .norm() < 1e-10,
           ExcMessage("The matrix is not orthogonal."));
  }



  template <int dim>
  bool
  TransformedShape<dim>::contains(const Point<dim> &p) const
  {
    return shape->contains(
      Point<dim>(transpose(rotation) * (Tensor<1, dim>(p) - translation)));
  }



  template <int dim>
  BoundingBox<dim>
  TransformedShape<dim>::bounding_box() const
  {
    return transform(shape->bounding_box(), rotation, translation);
  }



  template <int dim>
  std::vector<BoundaryElement<dim>>
  TransformedShape<dim>::boundary_elements(const double            spacing,
                                           const BoundingBox<dim> &window) const
  {
    const Tensor<2, dim>              inverse  = transpose(rotation);
    std::vector<BoundaryElement<dim>> elements = shape->boundary_elements(
      spacing, transform<dim>(window, inverse, -(inverse * translation)));

    for (BoundaryElement<dim> &element : elements)
      {
        element.midpoint =
          Point<dim>(rotation * Tensor<1, dim>(element.midpoint) + translation);
        element.normal = rotation * element.normal;
        for (Tensor<1, dim> &half_axis : element.half_axes)
          half_axis = rotation * half_axis;
      }
    return elements;
  }



  template class TransformedShape<2>;
  template class TransformedShape<3>;
} // namespace EBSMPM
