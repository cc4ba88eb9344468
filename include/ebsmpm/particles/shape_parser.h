// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_shape_parser_h
#define ebsmpm_particles_shape_parser_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/shape.h>

#include <map>
#include <memory>
#include <string>

namespace EBSMPM
{
  /**
   * Build a body from its description, as parameter files use it.
   *
   * The primitives are (with coordinates for 2d; in 3d a point or vector has
   * three)
   * <ul>
   * <li><tt>box(x0,y0, x1,y1)</tt>, opposite corners,</li>
   * <li><tt>ball(x,y, r)</tt>, centre and radius,</li>
   * <li><tt>half_space(x,y, nx,ny)</tt>, a point on the plane and the normal
   * that points out of the body,</li>
   * <li><tt>expression("x^2 + 2*y^2 - 1")</tt>, all points where this is
   * negative,</li>
   * </ul>
   * which can be moved
   * <ul>
   * <li><tt>rotate(angle, shape)</tt> about the origin, counter-clockwise, in
   * radians; in 3d <tt>rotate(angle, ax,ay,az, shape)</tt> about an axis
   * through the origin,</li>
   * <li><tt>translate(dx,dy, shape)</tt>,</li>
   * </ul>
   * and combined: <tt>+</tt> is the union, <tt>-</tt> the difference,
   * <tt>&</tt> the intersection, which binds more tightly; parentheses group.
   * A number may be any expression that Expression understands, for instance
   * <tt>1/31</tt> or <tt>0.5+h</tt>, if @p constants has an "h".
   *
   * @code
   *   # a square with a notch from the left
   *   box(0,0, 1,1) - box(-1,0.5-h, 0.5,0.5+h)
   * @endcode
   *
   * If the text cannot be understood, ExcInput is thrown. It says at which
   * position (counted from 1) what was expected.
   */
  template <int dim>
  std::shared_ptr<const Shape<dim>>
  parse_shape(const std::string                   &text,
              const std::map<std::string, double> &constants = {});
} // namespace EBSMPM

#endif
