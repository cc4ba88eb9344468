// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_cell_locator_h
#define ebsmpm_particles_cell_locator_h

#include <ebsmpm/base/grid_watch.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/grid/grid_tools_cache.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * Finds the one cell that contains a point, on a grid of axis-parallel boxes.
   *
   * Every point of the grid, also on a face, an edge or a vertex, belongs to
   * exactly one cell, and to the same one for any number of processes and
   * whatever cell it comes from. The rule is the one of half-open intervals: a
   * point on a face belongs to the cell in the positive direction; except at
   * the rim of the grid, whose points all belong to it.
   *
   * So that rounding does not decide, the comparisons are shifted by
   * tolerance(), a length of $10^{-10}$ times the smallest cell:
   * @code
   *          cell A                cell B                rim
   *   |---------------------|---------------------|
   *  [                     )[                       ]
   *    <- shifted by the tolerance
   * @endcode
   *
   * Searching starts from a cell close by and walks from neighbor to neighbor.
   * Where that leaves what this process knows (locally owned and ghost cells),
   * candidate_ranks() tells which processes should look among their own cells
   * with find_owned(). PointSet uses all this to sort points into cells.
   *
   * Particles::ParticleHandler has a search of its own. There, a point on a
   * face stays in the cell it comes from, or goes to the first one found, and
   * it is lost if it leaves the ghost cells in one move.
   */
  template <int dim>
  class CellLocator
  {
  public:
    using cell_iterator = typename Triangulation<dim>::active_cell_iterator;

    /**
     * The extent of a cell, prepared for fast decisions.
     */
    class Box
    {
    public:
      /**
       * Constructor.
       */
      Box(const cell_iterator &cell, const double tolerance);

      /**
       * Return whether a point belongs to the cell, by the rule above.
       */
      bool
      contains(const Point<dim> &p) const;

      /**
       * Return the coordinates on the reference cell.
       */
      Point<dim>
      to_unit(const Point<dim> &p) const;

      /**
       * Return the face of the cell that is to be crossed first on the way to
       * @p p, or invalid_unsigned_int if the cell contains the point.
       */
      unsigned int
      face_towards(const Point<dim> &p) const;

    private:
      Point<dim>     lower;
      Point<dim>     lower_limit;
      Point<dim>     upper_limit;
      Tensor<1, dim> inverse_extents;
    };

    /**
     * Constructor. Collective.
     */
    CellLocator(const Triangulation<dim> &triangulation,
                const Mapping<dim>       &mapping);

    /**
     * Adapt to a grid that has changed; do nothing if it has not. Collective,
     * and to be called before the functions below.
     */
    void
    update();

    /**
     * Return how far beside a face a point still counts as being on it.
     */
    double
    tolerance() const;

    /**
     * Return the extent of a cell.
     */
    Box
    box(const cell_iterator &cell) const;

    /**
     * Return the cell that contains @p p if it is locally owned or a ghost and
     * can be reached from @p start, otherwise the end of the cells.
     */
    cell_iterator
    find_from(const cell_iterator &start, const Point<dim> &p) const;

    /**
     * Return the locally owned cell that contains @p p, or the end of the
     * cells. This costs a search in a tree.
     */
    cell_iterator
    find_owned(const Point<dim> &p) const;

    /**
     * Return the other processes that may own the cell that contains @p p.
     */
    std::vector<unsigned int>
    candidate_ranks(const Point<dim> &p) const;

    /**
     * Return a text that describes the extent of the grid.
     */
    std::string
    describe_grid() const;

  private:
    /**
     * Return whether a point is in the box around the cells of a process.
     */
    bool
    is_in_box(const Point<dim> &p, const unsigned int rank) const;

    const Triangulation<dim> &triangulation;
    const unsigned int        own_rank;
    GridTools::Cache<dim>     cache;

    /**
     * Whether the grid has changed since the last call of update().
     */
    GridWatch watch;

    /**
     * The absolute tolerance.
     */
    double absolute_tolerance;

    /**
     * The box around the locally owned cells of each process, two corners one
     * after the other. Upside down if it owns none.
     */
    std::vector<std::array<Point<dim>, 2>> boxes;
  };



  // ---------------------------- inline functions ----------------------------



  template <int dim>
  inline CellLocator<dim>::Box::Box(const cell_iterator &cell,
                                    const double         tolerance)
  {
    const Point<dim> &upper =
      cell->vertex(GeometryInfo<dim>::vertices_per_cell - 1);
    lower = cell->vertex(0);
    for (unsigned int d = 0; d < dim; ++d)
      {
        inverse_extents[d] = 1. / (upper[d] - lower[d]);
        lower_limit[d]     = lower[d] - tolerance;
        upper_limit[d] =
          upper[d] + (cell->at_boundary(2 * d + 1) ? tolerance : -tolerance);
      }
  }



  template <int dim>
  inline bool
  CellLocator<dim>::Box::contains(const Point<dim> &p) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!(p[d] >= lower_limit[d] && p[d] < upper_limit[d]))
        return false;
    return true;
  }



  template <int dim>
  inline Point<dim>
  CellLocator<dim>::Box::to_unit(const Point<dim> &p) const
  {
    Point<dim> xi;
    for (unsigned int d = 0; d < dim; ++d)
      xi[d] = (p[d] - lower[d]) * inverse_extents[d];
    return xi;
  }



  template <int dim>
  inline double
  CellLocator<dim>::tolerance() const
  {
    return absolute_tolerance;
  }



  template <int dim>
  inline typename CellLocator<dim>::Box
  CellLocator<dim>::box(const cell_iterator &cell) const
  {
    return Box(cell, absolute_tolerance);
  }
} // namespace EBSMPM

#endif
