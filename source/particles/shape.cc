// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/shape.h>

namespace EBSMPM
{
  namespace
  {
    // Not the largest number there is: such a box is still to be rotated and
    // shifted without overflow.
    constexpr double infinity = 1e300;
  } // namespace



  template <int dim>
  std::vector<BoundaryElement<dim>>
  Shape<dim>::boundary_elements(const double spacing) const
  {
    const BoundingBox<dim> box = bounding_box();
    AssertThrow(is_bounded(box),
                ExcInput("The surface of a body without end cannot be divided "
                         "into elements; intersect the body with a box."));
    return boundary_elements(spacing, box);
  }



  template <int dim>
  BoundingBox<dim>
  unbounded_box()
  {
    Point<dim> corner;
    for (unsigned int d = 0; d < dim; ++d)
      corner[d] = infinity;
    return BoundingBox<dim>(std::make_pair(-corner, corner));
  }



  template <int dim>
  bool
  is_bounded(const BoundingBox<dim> &box)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (box.lower_bound(d) < -1e-10 * infinity ||
          box.upper_bound(d) > 1e-10 * infinity)
        return false;
    return true;
  }



  template class Shape<2>;
  template class Shape<3>;

  template BoundingBox<2>
  unbounded_box<2>();
  template BoundingBox<3>
  unbounded_box<3>();

  template bool
  is_bounded<2>(const BoundingBox<2> &);
  template bool
  is_bounded<3>(const BoundingBox<3> &);
} // namespace EBSMPM
