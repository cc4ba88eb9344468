// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/primitive_shapes.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <sstream>

namespace EBSMPM
{
  namespace
  {
    // The distance, relative to the size of a body, by which contains() moves
    // a point. It is far above rounding and far below the steps with which
    // the set operations look to both sides of a surface.
    constexpr double relative_tolerance = 1e-12;



    // Divide the parallelogram (segment in 2d) with the given corner and edges
    // into elements not longer than spacing.
    template <int dim>
    void
    divide_face(const Point<dim>                          &corner,
                const std::array<Tensor<1, dim>, dim - 1> &edges,
                const double                               area,
                const Tensor<1, dim>                      &normal,
                const double                               spacing,
                std::vector<BoundaryElement<dim>>         &elements)
    {
      std::array<unsigned int, dim - 1> n;
      unsigned int                      n_elements = 1;
      BoundaryElement<dim>              element;
      for (unsigned int d = 0; d < dim - 1; ++d)
        {
          // An edge that is a multiple of the spacing must not get one element
          // more because of rounding.
          n[d] = std::max(1., std::ceil(edges[d].norm() / spacing - 1e-6));
          n_elements *= n[d];
          element.half_axes[d] = edges[d] / (2. * n[d]);
        }
      element.area   = area / n_elements;
      element.normal = normal;

      for (unsigned int i = 0; i < n_elements; ++i)
        {
          element.midpoint = corner;
          unsigned int j   = i;
          for (unsigned int d = 0; d < dim - 1; ++d)
            {
              element.midpoint += edges[d] * ((j % n[d] + 0.5) / n[d]);
              j /= n[d];
            }
          elements.push_back(element);
        }
    }



    // Return dim-1 unit vectors perpendicular to the given one and to each
    // other.
    std::array<Tensor<1, 2>, 1>
    tangents(const Tensor<1, 2> &n)
    {
      return {{Point<2>(-n[1], n[0])}};
    }



    std::array<Tensor<1, 3>, 2>
    tangents(const Tensor<1, 3> &n)
    {
      unsigned int smallest = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(n[d]) < std::abs(n[smallest]))
          smallest = d;

      std::array<Tensor<1, 3>, 2> t;
      t[0] = cross_product_3d(n, Point<3>::unit_vector(smallest));
      t[0] /= t[0].norm();
      t[1] = cross_product_3d(n, t[0]);
      return t;
    }



    // The pieces of a circle.
    void
    divide_sphere(const Point<2>                  &center,
                  const double                     radius,
                  const double                     spacing,
                  std::vector<BoundaryElement<2>> &elements)
    {
      const unsigned int n =
        std::max(3., std::ceil(2. * numbers::PI * radius / spacing - 1e-6));
      BoundaryElement<2> element;
      element.area = 2. * numbers::PI * radius / n;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double phi = 2. * numbers::PI * (i + 0.5) / n;
          element.normal   = Point<2>(std::cos(phi), std::sin(phi));
          element.midpoint = center + radius * element.normal;
          elements.push_back(element);
        }
    }



    // The pieces of a sphere: bands between two heights z, and sectors thereof.
    void
    divide_sphere(const Point<3>                  &center,
                  const double                     radius,
                  const double                     spacing,
                  std::vector<BoundaryElement<3>> &elements)
    {
      const unsigned int n_bands =
        std::max(2., std::ceil(numbers::PI * radius / spacing - 1e-6));
      for (unsigned int band = 0; band < n_bands; ++band)
        {
          const double z0 = std::cos(numbers::PI * band / n_bands);
          const double z1 = std::cos(numbers::PI * (band + 1) / n_bands);
          // Archimedes: the area of a band is proportional to its height, so
          // this is the height of its centre of area.
          const double       z = 0.5 * (z0 + z1);
          const double       r = std::sqrt(1. - z * z);
          const unsigned int n =
            std::max(3.,
                     std::ceil(2. * numbers::PI * r * radius / spacing - 1e-6));

          BoundaryElement<3> element;
          element.area = 2. * numbers::PI * radius * radius * (z0 - z1) / n;
          for (unsigned int i = 0; i < n; ++i)
            {
              const double phi = 2. * numbers::PI * (i + 0.5) / n;
              element.normal =
                Point<3>(r * std::cos(phi), r * std::sin(phi), z);
              element.midpoint = center + radius * element.normal;
              elements.push_back(element);
            }
        }
    }
  } // namespace



  template <int dim>
  BoxShape<dim>::BoxShape(const Point<dim> &lower, const Point<dim> &upper)
    : lower(lower)
    , upper(upper)
    , tolerance(relative_tolerance * lower.distance(upper))
  {
    for (unsigned int d = 0; d < dim; ++d)
      AssertThrow(lower[d] < upper[d],
                  ExcInput("A box must have a first corner with smaller "
                           "coordinates than the second one."));
  }



  template <int dim>
  bool
  BoxShape<dim>::contains(const Point<dim> &p) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (p[d] < lower[d] - tolerance || p[d] >= upper[d] - tolerance)
        return false;
    return true;
  }



  template <int dim>
  BoundingBox<dim>
  BoxShape<dim>::bounding_box() const
  {
    return BoundingBox<dim>(std::make_pair(lower, upper));
  }



  template <int dim>
  std::vector<BoundaryElement<dim>>
  BoxShape<dim>::boundary_elements(const double spacing,
                                   const BoundingBox<dim> & /*window*/) const
  {
    std::vector<BoundaryElement<dim>> elements;
    for (unsigned int d = 0; d < dim; ++d)
      {
        std::array<Tensor<1, dim>, dim - 1> edges;
        double                              area = 1;
        for (unsigned int i = 0; i < dim - 1; ++i)
          {
            const unsigned int e = (d + 1 + i) % dim;
            edges[i][e]          = upper[e] - lower[e];
            area *= upper[e] - lower[e];
          }

        for (const double side : {-1., 1.})
          {
            Point<dim> corner = lower;
            if (side > 0)
              corner[d] = upper[d];
            divide_face<dim>(corner,
                             edges,
                             area,
                             side * Point<dim>::unit_vector(d),
                             spacing,
                             elements);
          }
      }
    return elements;
  }



  template <int dim>
  BallShape<dim>::BallShape(const Point<dim> &center, const double radius)
    : center(center)
    , radius(radius)
  {
    AssertThrow(radius > 0, ExcInput("The radius of a ball must be positive."));
  }



  template <int dim>
  bool
  BallShape<dim>::contains(const Point<dim> &p) const
  {
    return p.distance_square(center) <
           radius * radius * (1. - 2. * relative_tolerance);
  }



  template <int dim>
  BoundingBox<dim>
  BallShape<dim>::bounding_box() const
  {
    Tensor<1, dim> r;
    for (unsigned int d = 0; d < dim; ++d)
      r[d] = radius;
    return BoundingBox<dim>(std::make_pair(center - r, center + r));
  }



  template <int dim>
  std::vector<BoundaryElement<dim>>
  BallShape<dim>::boundary_elements(const double spacing,
                                    const BoundingBox<dim> & /*window*/) const
  {
    std::vector<BoundaryElement<dim>> elements;
    divide_sphere(center, radius, spacing, elements);
    return elements;
  }



  template <int dim>
  HalfSpaceShape<dim>::HalfSpaceShape(const Point<dim>     &point,
                                      const Tensor<1, dim> &normal)
    : point(point)
    , normal(normal / normal.norm())
    , tie([&normal]() {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(normal[d]) > relative_tolerance * normal.norm())
          return std::copysign(1., normal[d]);
      return 1.;
    }())
  {
    AssertThrow(normal.norm() > 0,
                ExcInput("The normal of a half space must not be zero."));
  }



  template <int dim>
  bool
  HalfSpaceShape<dim>::contains(const Point<dim> &p) const
  {
    // The body has no size, so what rounding can do depends on the coordinates.
    const double tolerance = relative_tolerance * (p.norm() + point.norm());
    return (p - point) * normal < -tie * tolerance;
  }



  template <int dim>
  BoundingBox<dim>
  HalfSpaceShape<dim>::bounding_box() const
  {
    BoundingBox<dim> box = unbounded_box<dim>();
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (normal[d] > 1. - relative_tolerance)
          box.get_boundary_points().second[d] = point[d];
        if (normal[d] < -1. + relative_tolerance)
          box.get_boundary_points().first[d] = point[d];
      }
    return box;
  }



  template <int dim>
  std::vector<BoundaryElement<dim>>
  HalfSpaceShape<dim>::boundary_elements(const double            spacing,
                                         const BoundingBox<dim> &window) const
  {
    AssertThrow(is_bounded(window),
                ExcInput("The surface of a half space can be divided into "
                         "elements only after it has been intersected with a "
                         "bounded body."));

    // Cover the projection of the window, beginning at a multiple of the
    // spacing from the given point.
    const std::array<Tensor<1, dim>, dim - 1> directions = tangents(normal);
    std::array<Tensor<1, dim>, dim - 1>       edges;
    Point<dim>                                corner = point;
    double                                    area   = 1;
    for (unsigned int i = 0; i < dim - 1; ++i)
      {
        double begin = 0;
        double end   = 0;
        for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_cell; ++v)
          {
            const double s = (window.vertex(v) - point) * directions[i];
            begin          = (v == 0 ? s : std::min(begin, s));
            end            = (v == 0 ? s : std::max(end, s));
          }
        begin = spacing * std::floor(begin / spacing + 1e-6);
        end   = spacing * std::max(std::ceil(end / spacing - 1e-6),
                                 std::round(begin / spacing) + 1.);
        corner += begin * directions[i];
        edges[i] = (end - begin) * directions[i];
        area *= end - begin;
      }

    std::vector<BoundaryElement<dim>> elements;
    divide_face<dim>(corner, edges, area, normal, spacing, elements);
    return elements;
  }



  template <int dim>
  ExpressionShape<dim>::ExpressionShape(
    const std::string                   &expression,
    const std::map<std::string, double> &constants)
  {
    std::map<std::string, double> all_constants = constants;
    all_constants.emplace("pi", numbers::PI);

    // The expression is compiled when it is needed for the first time, and
    // whatever is wrong with it turns up then.
    try
      {
        function.initialize(FunctionParser<dim>::default_variable_names(),
                            expression,
                            all_constants);
        function.value(Point<dim>());
      }
    catch (const ExceptionBase &e)
      {
        std::ostringstream reason;
        e.print_info(reason);
        AssertThrow(false,
                    ExcInput("The expression '" + expression +
                             "' cannot be evaluated: " +
                             Utilities::trim(reason.str())));
      }
  }



  template <int dim>
  bool
  ExpressionShape<dim>::contains(const Point<dim> &p) const
  {
    return function.value(p) < 0;
  }



  template <int dim>
  BoundingBox<dim>
  ExpressionShape<dim>::bounding_box() const
  {
    return unbounded_box<dim>();
  }



  template <int dim>
  std::vector<BoundaryElement<dim>>
  ExpressionShape<dim>::boundary_elements(
    const double /*spacing*/,
    const BoundingBox<dim> & /*window*/) const
  {
    return {};
  }



  template class BoxShape<2>;
  template class BoxShape<3>;
  template class BallShape<2>;
  template class BallShape<3>;
  template class HalfSpaceShape<2>;
  template class HalfSpaceShape<3>;
  template class ExpressionShape<2>;
  template class ExpressionShape<3>;
} // namespace EBSMPM
