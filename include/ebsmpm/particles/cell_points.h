// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_cell_points_h
#define ebsmpm_particles_cell_points_h

#include <ebsmpm/splines/cartesian_lattice.h>

#include <deal.II/base/point.h>

#include <deal.II/grid/tria.h>

#include <deal.II/particles/particle_handler.h>

#include <vector>

namespace EBSMPM
{
  /**
   * Where the points of this process are at the start of a load step: cell by
   * cell, with contiguous numbers.
   *
   * Within a load step, points do not move through the grid (weak forms are
   * written on the start-of-step configuration). So this class numbers them
   * once, $0,\ldots,n-1$, those of a cell one after the other, and the systems
   * of the assembly keep what they need to know about a point in plain arrays
   * with that number. Within a cell, points are in the order of their ids, so
   * that sums over a cell do not depend on where its points came from.
   *
   * @code
   * CellPoints<dim> points;
   * points.reinit(material_points.handler(), lattice);
   * for (const auto &cell : points.cells())
   *   for (unsigned int q = cell.begin; q < cell.end; ++q)
   *     do_something_at(points.unit_point(q));
   * @endcode
   *
   * The object refers to the particles, and is invalid as soon as these are
   * sorted or removed.
   */
  template <int dim>
  class CellPoints
  {
  public:
    /** A cell with points in it. */
    struct Cell
    {
      typename Triangulation<dim>::active_cell_iterator iterator;

      /** Lattice index and level of the cell. */
      typename CartesianLattice<dim>::Index index;
      unsigned int                          level;

      /** The numbers of its points are begin, ..., end-1. */
      unsigned int begin;
      unsigned int end;
    };

    /** Number the locally owned particles of @p handler. */
    void
    reinit(Particles::ParticleHandler<dim> &handler,
           const CartesianLattice<dim>     &lattice);

    /** The cells that have points, in the order of the triangulation. */
    const std::vector<Cell> &
    cells() const
    {
      return cell_list;
    }

    /** Number of points on this process. */
    unsigned int
    n_points() const
    {
      return unit_points.size();
    }

    /** Position of a point in the coordinates of the unit cell. */
    const Point<dim> &
    unit_point(const unsigned int q) const
    {
      return unit_points[q];
    }

    /** Position of a point. */
    const Point<dim> &
    location(const unsigned int q) const
    {
      return particles[q]->get_location();
    }

    /** The particle that carries the point. */
    const Particles::ParticleIterator<dim> &
    particle(const unsigned int q) const
    {
      return particles[q];
    }

    /** The properties of the particle that carries the point. */
    ArrayView<double>
    properties(const unsigned int q) const
    {
      return const_cast<Particles::ParticleIterator<dim> &>(particles[q])
        ->get_properties();
    }

  private:
    std::vector<Cell>                             cell_list;
    std::vector<Point<dim>>                       unit_points;
    std::vector<Particles::ParticleIterator<dim>> particles;
  };
} // namespace EBSMPM

#endif
