// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_fracture_crack_directions_h
#define ebsmpm_fracture_crack_directions_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace EBSMPM
{
  /**
   * Directions across a crack: what DamageRidge and CrackPartition have to
   * agree upon.
   */
  namespace CrackDirections
  {
    /** Offsets smaller than this part of a cell are ties. */
    constexpr double tie = 0.01;



    /** Return the direction of an axis that counts as positive. */
    template <int dim>
    inline Tensor<1, dim>
    canonical(const Tensor<1, dim> &axis)
    {
      // The largest component, by a margin, so that an axis along a coordinate
      // direction does not depend on roundoff in the others.
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(axis[d]) > 0.5 / std::sqrt(1. * dim))
          return axis[d] > 0 ? axis : -axis;
      return axis;
    }



    /** Return the components in a type that messages may contain. */
    template <int dim>
    inline std::array<double, dim>
    to_array(const Tensor<1, dim> &t)
    {
      std::array<double, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = t[d];
      return result;
    }



    /** The inverse of to_array(). */
    template <std::size_t dim>
    inline Tensor<1, static_cast<int>(dim)>
    to_tensor(const std::array<double, dim> &a)
    {
      Tensor<1, static_cast<int>(dim)> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = a[d];
      return result;
    }
  } // namespace CrackDirections
} // namespace EBSMPM

#endif
