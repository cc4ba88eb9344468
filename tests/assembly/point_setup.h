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

// A body of bodies.h on a grid, with all that systems are made of: points,
// their state, functions and constraints. None of this belongs to the library.

#include <ebsmpm/base/compat.h>

#include <ebsmpm/splines/extension.h>

#include <ebsmpm/assembly/boundary_resultants.h>
#include <ebsmpm/assembly/displacement_system.h>
#include <ebsmpm/assembly/field_evaluation.h>
#include <ebsmpm/assembly/supports.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/trilinos_solver.h>

#include <deal.II/particles/particle_handler.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "../splines/verdict.h"
#include "bodies.h"

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
    for (auto &Pi : boundary.projection)
      Pi = unit_symmetric_tensor<dim>();
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



/** The energies of a body after a load step. */
template <int dim>
typename DisplacementSystem<dim>::Energies
energies_of(const DisplacementSystem<dim> &system,
            const BodyOnGrid<dim>         &body,
            const LA::FieldVector         &increment)
{
  const auto update = system.update_points(body.boundary, increment);
  return system.energies(body.state,
                         system.update_points(body.state, increment),
                         body.boundary,
                         update,
                         system.flux(body.boundary, update));
}



/** The reactions of the boundaries to a load step. */
template <int dim>
std::map<types::boundary_id, Tensor<1, dim>>
reactions_of(const DisplacementSystem<dim>         &system,
             const BodyOnGrid<dim>                 &body,
             const LA::FieldVector                 &increment,
             const std::vector<types::boundary_id> &ids)
{
  return BoundaryResultants::reactions(
    body.boundary,
    system.flux(body.boundary, system.update_points(body.boundary, increment)),
    ids,
    body.space.communicator());
}



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
      result->boundary.projection[q] = old.boundary.projection[i];
      result->boundary.prescribed[q] = old.boundary.prescribed[i];
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
