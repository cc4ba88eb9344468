// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_tests_assembly_bodies_h
#define ebsmpm_tests_assembly_bodies_h

// Bodies as exact quadrature rules on the part of the body in each cell, so
// that tests of the assembly do not see the quadrature error of a lattice of
// points. None of this belongs to the library.

#include <ebsmpm/base/config.h>

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace dealii;
using namespace EBSMPM;



template <int dim>
struct MaterialRecord
{
  Point<dim> x;
  double     volume;
};



template <int dim>
struct BoundaryRecord
{
  Point<dim>         x;
  double             area;
  Tensor<1, dim>     normal;
  types::boundary_id id;
};



/** A body, as quadrature rules on its intersection with boxes. */
template <int dim>
class Body
{
public:
  virtual ~Body() = default;

  /** Points and weights for polynomials of degree 2n-1 (2n-2 on triangles). */
  virtual std::vector<MaterialRecord<dim>>
  interior(const Point<dim>  &lower,
           const Point<dim>  &upper,
           const unsigned int n) const = 0;

  virtual std::vector<BoundaryRecord<dim>>
  boundary(const Point<dim>  &lower,
           const Point<dim>  &upper,
           const unsigned int n) const = 0;
};



/** An axis-parallel box; boundary ids as those of deal.II's hyper rectangle. */
template <int dim>
class BoxBody : public Body<dim>
{
public:
  BoxBody(const Point<dim> &a, const Point<dim> &b)
    : a(a)
    , b(b)
  {}

  virtual std::vector<MaterialRecord<dim>>
  interior(const Point<dim>  &lower,
           const Point<dim>  &upper,
           const unsigned int n) const override
  {
    std::vector<MaterialRecord<dim>> result;
    Point<dim>                       from, to;
    double                           volume = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        from[d] = std::max(lower[d], a[d]);
        to[d]   = std::min(upper[d], b[d]);
        if (to[d] - from[d] < 1e-12 * (upper[d] - lower[d]))
          return result;
        volume *= to[d] - from[d];
      }
    const QGauss<dim> quadrature(n);
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        Point<dim> x = from;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] += quadrature.point(q)[d] * (to[d] - from[d]);
        result.push_back({x, volume * quadrature.weight(q)});
      }
    return result;
  }

  virtual std::vector<BoundaryRecord<dim>>
  boundary(const Point<dim>  &lower,
           const Point<dim>  &upper,
           const unsigned int n) const override
  {
    std::vector<BoundaryRecord<dim>> result;
    const QGauss<dim - 1>            quadrature(n);
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        // A face on a grid line belongs to the cell on the body's side.
        const unsigned int d0       = face / 2;
        const double       sign     = (face % 2 == 0 ? -1. : 1.);
        const double       position = (face % 2 == 0 ? a[d0] : b[d0]);
        const double inside = position - sign * 1e-9 * (upper[d0] - lower[d0]);
        if (inside < lower[d0] || inside >= upper[d0])
          continue;

        double     area = 1.;
        Point<dim> from, to;
        for (unsigned int d = 0; d < dim; ++d)
          if (d != d0)
            {
              from[d] = std::max(lower[d], a[d]);
              to[d]   = std::min(upper[d], b[d]);
              if (to[d] - from[d] < 1e-12 * (upper[d] - lower[d]))
                area = 0.;
              area *= to[d] - from[d];
            }
        if (area <= 0.)
          continue;

        Tensor<1, dim> normal;
        normal[d0] = sign;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            Point<dim> x = from;
            x[d0]        = position;
            for (unsigned int d = 0, c = 0; d < dim; ++d)
              if (d != d0)
                x[d] += quadrature.point(q)[c++] * (to[d] - from[d]);
            result.push_back({x,
                              area * quadrature.weight(q),
                              normal,
                              static_cast<types::boundary_id>(face)});
          }
      }
    return result;
  }

private:
  const Point<dim> a, b;
};



/** A convex polygon, corners counterclockwise; edge i has the boundary id i. */
class PolygonBody : public Body<2>
{
public:
  explicit PolygonBody(const std::vector<Point<2>> &corners)
    : corners(corners)
  {}

  /** The unit square around its centre, turned by an angle. */
  static PolygonBody
  rotated_square(const double angle, const Point<2> &center = Point<2>())
  {
    const double          c = std::cos(angle), s = std::sin(angle);
    std::vector<Point<2>> corners;
    for (const auto &x : {Point<2>(-.5, -.5),
                          Point<2>(.5, -.5),
                          Point<2>(.5, .5),
                          Point<2>(-.5, .5)})
      corners.emplace_back(center[0] + c * x[0] - s * x[1],
                           center[1] + s * x[0] + c * x[1]);
    return PolygonBody(corners);
  }

  virtual std::vector<MaterialRecord<2>>
  interior(const Point<2>    &lower,
           const Point<2>    &upper,
           const unsigned int n) const override
  {
    // Clip the cell by one edge after the other.
    std::vector<Point<2>> polygon = {lower,
                                     Point<2>(upper[0], lower[1]),
                                     upper,
                                     Point<2>(lower[0], upper[1])};
    bool                  is_cut  = false;
    for (unsigned int e = 0; e < corners.size(); ++e)
      {
        std::vector<Point<2>> clipped;
        for (unsigned int i = 0; i < polygon.size(); ++i)
          {
            const Point<2> &x  = polygon[i];
            const Point<2> &y  = polygon[(i + 1) % polygon.size()];
            const double    dx = distance(e, x), dy = distance(e, y);
            if (dx <= 0.)
              clipped.push_back(x);
            if ((dx < 0. && dy > 0.) || (dx > 0. && dy < 0.))
              clipped.push_back(x + dx / (dx - dy) * (y - x));
            is_cut |= dx > 0.;
          }
        polygon = clipped;
      }

    std::vector<MaterialRecord<2>> result;
    if (polygon.size() < 3)
      return result;

    if (!is_cut)
      {
        const QGauss<2> quadrature(n);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            Point<2> x = lower;
            for (unsigned int d = 0; d < 2; ++d)
              x[d] += quadrature.point(q)[d] * (upper[d] - lower[d]);
            result.push_back({x,
                              quadrature.weight(q) * (upper[0] - lower[0]) *
                                (upper[1] - lower[1])});
          }
        return result;
      }

    // A fan of triangles, each the image of a square under Duffy's map.
    const QGauss<1> quadrature(n);
    for (unsigned int i = 1; i + 1 < polygon.size(); ++i)
      {
        const Tensor<1, 2> u          = polygon[i] - polygon[0];
        const Tensor<1, 2> v          = polygon[i + 1] - polygon[i];
        const double       twice_area = u[0] * v[1] - u[1] * v[0];
        if (twice_area < 1e-14 * (upper - lower).norm_square())
          continue;
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            {
              const double s = quadrature.point(a)[0];
              const double t = quadrature.point(b)[0];
              result.push_back(
                {polygon[0] + s * u + s * t * v,
                 twice_area * s * quadrature.weight(a) * quadrature.weight(b)});
            }
      }
    return result;
  }

  virtual std::vector<BoundaryRecord<2>>
  boundary(const Point<2>    &lower,
           const Point<2>    &upper,
           const unsigned int n) const override
  {
    std::vector<BoundaryRecord<2>> result;
    const QGauss<1>                quadrature(n);
    for (unsigned int e = 0; e < corners.size(); ++e)
      {
        const Point<2>    &x    = corners[e];
        const Tensor<1, 2> t    = corners[(e + 1) % corners.size()] - x;
        double             from = 0., to = 1.;
        for (unsigned int d = 0; d < 2; ++d)
          if (std::abs(t[d]) > 1e-12)
            {
              const double s0 = (lower[d] - x[d]) / t[d];
              const double s1 = (upper[d] - x[d]) / t[d];
              from            = std::max(from, std::min(s0, s1));
              to              = std::min(to, std::max(s0, s1));
            }
          else if (x[d] < lower[d] || x[d] >= upper[d])
            to = 0.;
        if (to - from < 1e-12)
          continue;
        const Tensor<1, 2> normal = cross_product_2d(t) / t.norm();
        for (unsigned int q = 0; q < n; ++q)
          result.push_back(
            {x + (from + quadrature.point(q)[0] * (to - from)) * t,
             (to - from) * t.norm() * quadrature.weight(q),
             normal,
             static_cast<types::boundary_id>(e)});
      }
    return result;
  }

private:
  /** Twice signed area with an edge; positive outside. */
  double
  distance(const unsigned int e, const Point<2> &y) const
  {
    const Point<2> &x = corners[e];
    const Point<2> &z = corners[(e + 1) % corners.size()];
    return (z[1] - x[1]) * (y[0] - x[0]) - (z[0] - x[0]) * (y[1] - x[1]);
  }

  const std::vector<Point<2>> corners;
};



/**
 * Points that have moved: lists of records, of which a cell gets those that are
 * in it. The lists 'material_order' and 'boundary_order' then tell which record
 * has become which point of BodyOnGrid. For serial computations.
 */
template <int dim>
class RecordedBody : public Body<dim>
{
public:
  std::vector<MaterialRecord<dim>> material;
  std::vector<BoundaryRecord<dim>> boundary_records;

  mutable std::vector<unsigned int> material_order;
  mutable std::vector<unsigned int> boundary_order;

  virtual std::vector<MaterialRecord<dim>>
  interior(const Point<dim> &lower,
           const Point<dim> &upper,
           const unsigned int) const override
  {
    std::vector<MaterialRecord<dim>> result;
    for (unsigned int i = 0; i < material.size(); ++i)
      if (is_inside(material[i].x, lower, upper))
        {
          result.push_back(material[i]);
          material_order.push_back(i);
        }
    return result;
  }

  virtual std::vector<BoundaryRecord<dim>>
  boundary(const Point<dim> &lower,
           const Point<dim> &upper,
           const unsigned int) const override
  {
    std::vector<BoundaryRecord<dim>> result;
    for (unsigned int i = 0; i < boundary_records.size(); ++i)
      if (is_inside(boundary_records[i].x, lower, upper))
        {
          result.push_back(boundary_records[i]);
          boundary_order.push_back(i);
        }
    return result;
  }

private:
  static bool
  is_inside(const Point<dim> &x,
            const Point<dim> &lower,
            const Point<dim> &upper)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (x[d] < lower[d] || x[d] >= upper[d])
        return false;
    return true;
  }
};

#endif
