// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_point_fields_h
#define ebsmpm_output_point_fields_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/output/point_writer.h>

namespace EBSMPM
{
  /**
   * Return a writer with what one usually wants to see of MaterialPoints: the
   * scalars damage, history, peak_damage, J (the determinant of the deformation
   * gradient), reference_volume, damageable and label_frozen, and the vectors
   * displacement and side.
   *
   * @code
   * const auto writer = make_material_point_writer<dim>();
   * writer.write(points.handler(), series, step, time);
   * @endcode
   */
  template <int dim>
  PointWriter<dim>
  make_material_point_writer();

  /**
   * The same for BoundaryPoints: the scalars damage, peak_damage,
   * reference_area, boundary_id and label_frozen, and the vectors displacement,
   * side and normal, which is the one of the deformed body.
   */
  template <int dim>
  PointWriter<dim>
  make_boundary_point_writer();
} // namespace EBSMPM

#endif
