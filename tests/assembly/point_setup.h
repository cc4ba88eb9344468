// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_tests_assembly_point_setup_h
#define ebsmpm_tests_assembly_point_setup_h

// Bodies whose material and boundary points are exact quadrature rules on the
// part of the body in each cell, so that tests of the assembly do not see the
// quadrature error of a lattice of points. None of this belongs to the library.

#include <ebsmpm/base/compat.h>

#include <ebsmpm/splines/extension.h>

#include <ebsmpm/assembly/displacement_system.h>
#include <ebsmpm/assembly/field_evaluation.h>
#include <ebsmpm/assembly/supports.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/trilinos_solver.h>

#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "../splines/verdict.h"

using namespace dealii;
using namespace EBSMPM;



/**
 * A number between -1 and 1 that depends on a position and a component, the
 * less smoothly the larger the frequency.
 */
template <int dim>
inline double
scatter(const Point<dim>  &x,
        const unsigned int component,
        const double       frequency = 17.3)
{
  double argument = 1. + 0.7 * component;
  for (unsigned int d = 0; d < dim; ++d)
    argument += frequency * (1. + 0.3 * d + 0.1 * (component % 7)) * x[d];
  return std::sin(argument);
}



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



/**
 * A body on a grid: points, space, constraints, and the state of an undeformed
 * body, all of whose boundary is prescribed, in arrays that a test changes as
 * it likes before it makes systems of them.
 */
template <int dim>
struct BodyOnGrid
{
  using Pattern = typename PointGroups<dim>::Pattern;

  BodyOnGrid(const Triangulation<dim> &triangulation,
             const Body<dim>          &body,
             const unsigned int        degree,
             const unsigned int        n_quadrature_points)
    : triangulation(triangulation)
    , space(triangulation, degree)
  {
    material_handler.initialize(triangulation, mapping, 0);
    boundary_handler.initialize(triangulation, mapping, 0);

    // Insert the points cell by cell, so that arrays filled on the way have
    // the order of CellPoints.
    types::particle_index material_id = 0, boundary_id = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const Point<dim> lower = cell->vertex(0);
        const Point<dim> upper =
          cell->vertex(GeometryInfo<dim>::vertices_per_cell - 1);
        const auto unit = [&](const Point<dim> &x) {
          Point<dim> xi;
          for (unsigned int d = 0; d < dim; ++d)
            xi[d] = (x[d] - lower[d]) / (upper[d] - lower[d]);
          return xi;
        };
        for (const auto &p : body.interior(lower, upper, n_quadrature_points))
          {
            material_handler.insert_particle(p.x,
                                             unit(p.x),
                                             material_id++,
                                             cell);
            state.volume.push_back(p.volume);
          }
        for (const auto &b : body.boundary(lower, upper, n_quadrature_points))
          {
            boundary_handler.insert_particle(b.x,
                                             unit(b.x),
                                             boundary_id++,
                                             cell);
            boundary.area.push_back(b.area);
            boundary.normal.push_back(b.normal);
            boundary.boundary_id.push_back(b.id);
          }
      }
    material_handler.update_cached_numbers();
    boundary_handler.update_cached_numbers();
    points.reinit(material_handler, space.lattice());
    boundary_points.reinit(boundary_handler, space.lattice());

    state.resize(points.n_points());
    boundary.resize(boundary_points.n_points());
    for (auto &F : state.F)
      F = unit_symmetric_tensor<dim>();
    for (auto &F : boundary.F)
      F = unit_symmetric_tensor<dim>();
    for (auto &c : boundary.constrained)
      c.fill(true);
  }

  /** What the points say about functions; for make_space(). */
  typename SplineSpace<dim>::SupportTable
  supports() const
  {
    std::vector<double> volumes(state.volume);
    for (unsigned int q = 0; q < volumes.size(); ++q)
      volumes[q] *= determinant(state.F[q]);

    typename SplineSpace<dim>::SupportTable table;
    add_supports(points, volumes, patterns, space, table);
    add_supports(boundary_points, {}, boundary_patterns, space, table);
    return table;
  }

  void
  make_space(const double threshold)
  {
    make_space(supports(), threshold);
  }

  void
  make_space(const typename SplineSpace<dim>::SupportTable &table,
             const double                                   threshold)
  {
    space.reinit(table, threshold);
    report = make_extension_constraints(space, constraints);
  }

  /** Give a system the points and functions. */
  template <typename System>
  void
  reinit(System &system) const
  {
    system.reinit(
      points, boundary_points, space, constraints, patterns, boundary_patterns);
  }

  /**
   * Set the coefficients of the functions that this process owns to what
   * 'value' says about the key, the Greville point and a component.
   */
  void
  set_coefficients(LA::FieldVector                           &field,
                   const unsigned int                         n_components,
                   const std::function<double(const FunctionKey<dim> &,
                                              const Point<dim> &,
                                              unsigned int)> &value) const
  {
    for (const auto &entry : space.functions())
      if (space.locally_owned().is_element(entry.second.index) &&
          entry.second.index < space.n_independent())
        for (unsigned int a = 0; a < n_components; ++a)
          field(n_components * entry.second.index + a) =
            value(entry.first,
                  space.lattice().greville_point(entry.first, space.degree()),
                  a);
  }

  /** A vector of numbers between -1 and 1, the same on any number of ranks. */
  void
  scatter_coefficients(LA::FieldVector   &field,
                       const unsigned int n_components,
                       const unsigned int seed = 0) const
  {
    set_coefficients(field,
                     n_components,
                     [seed](const FunctionKey<dim> &,
                            const Point<dim>  &x,
                            const unsigned int a) {
                       return scatter(x, a + 5 * seed, 4.);
                     });
  }

  const Triangulation<dim>       &triangulation;
  MappingCartesian<dim>           mapping;
  Particles::ParticleHandler<dim> material_handler;
  Particles::ParticleHandler<dim> boundary_handler;
  SplineSpace<dim>                space;
  CellPoints<dim>                 points;
  CellPoints<dim>                 boundary_points;
  MaterialState<dim>              state;
  BoundaryState<dim>              boundary;
  std::vector<Pattern>            patterns;
  std::vector<Pattern>            boundary_patterns;
  AffineConstraints<double>       constraints;
  ExtensionReport                 report;
};



/**
 * A body after a load step, on the same grid: the points at their new positions
 * with what they carry. Serial.
 */
template <int dim>
std::unique_ptr<BodyOnGrid<dim>>
move_body(const BodyOnGrid<dim>         &old,
          const DisplacementSystem<dim> &system,
          const LA::FieldVector         &increment)
{
  const auto update          = system.update_points(old.state, increment);
  const auto boundary_update = system.update_points(old.boundary, increment);
  RecordedBody<dim> record;
  for (unsigned int q = 0; q < old.points.n_points(); ++q)
    record.material.push_back(
      {old.points.location(q) + update.displacement_increment[q],
       old.state.volume[q]});
  for (unsigned int q = 0; q < old.boundary_points.n_points(); ++q)
    record.boundary_records.push_back(
      {old.boundary_points.location(q) +
         boundary_update.displacement_increment[q],
       old.boundary.area[q],
       old.boundary.normal[q],
       old.boundary.boundary_id[q]});

  auto result = std::make_unique<BodyOnGrid<dim>>(old.triangulation,
                                                  record,
                                                  old.space.degree(),
                                                  0);
  AssertThrow(result->points.n_points() == old.points.n_points() &&
                result->boundary_points.n_points() ==
                  old.boundary_points.n_points(),
              ExcMessage("Points have left the grid."));
  for (unsigned int q = 0; q < result->points.n_points(); ++q)
    {
      const unsigned int i     = record.material_order[q];
      result->state.F[q]       = update.F[i];
      result->state.damage[q]  = old.state.damage[i];
      result->state.history[q] = old.state.history[i];
    }
  for (unsigned int q = 0; q < result->boundary_points.n_points(); ++q)
    {
      const unsigned int i       = record.boundary_order[q];
      result->boundary.F[q]      = boundary_update.F[i];
      result->boundary.damage[q] = old.boundary.damage[i];
      result->boundary.displacement[q] =
        old.boundary.displacement[i] +
        boundary_update.displacement_increment[i];
      result->boundary.constrained[q] = old.boundary.constrained[i];
      result->boundary.prescribed[q]  = old.boundary.prescribed[i];
    }
  return result;
}



/** Solve a system with a serial factorisation. */
inline void
solve_directly(const LA::SparseMatrix &matrix,
               LA::FieldVector        &solution,
               const LA::FieldVector  &right_hand_side)
{
  solution.zero_out_ghost_values();
  SolverControl                  control(1, 0., false, false);
  TrilinosWrappers::SolverDirect solver(control);
  solver.solve(matrix, solution, right_hand_side);
}

#endif
