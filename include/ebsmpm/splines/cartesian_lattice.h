// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_splines_cartesian_lattice_h
#define ebsmpm_splines_cartesian_lattice_h

#include <ebsmpm/splines/function_key.h>

#include <deal.II/base/point.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace EBSMPM
{
  /**
   * Lattice coordinates of the cells of a Cartesian grid.
   *
   * The coarse cells must be equal boxes on a lattice, as those of
   * GridGenerator::subdivided_hyper_rectangle(); holes are allowed. The lattice
   * index of a refined cell follows from its CellId by integer arithmetic, so
   * that all processes agree on it without any tolerance.
   *
   * @code
   * CartesianLattice<dim> lattice(triangulation);
   * for (const auto &cell : triangulation.active_cell_iterators())
   *   if (cell->is_locally_owned())
   *     const auto index = lattice.cell_index(cell);
   * @endcode
   *
   * Nothing is stored but the positions of the coarse cells, which every
   * process of a distributed triangulation knows anyway; nothing is
   * communicated.
   */
  template <int dim>
  class CartesianLattice
  {
  public:
    using Index = std::array<std::int32_t, dim>;

    /**
     * Read the lattice off the coarse cells of @p triangulation. Throws
     * ExcNotCartesian if they are not equal, axis-parallel boxes on a lattice.
     */
    explicit CartesianLattice(const Triangulation<dim> &triangulation);

    /** Return the lattice index of a cell among the cells of its level. */
    Index
    cell_index(const typename Triangulation<dim>::cell_iterator &cell) const;

    /** Return the edge lengths of the cells of a level. */
    Tensor<1, dim>
    cell_extents(const unsigned int level) const;

    /**
     * Return one over these lengths, which turns derivatives with respect to
     * unit coordinates into real ones.
     */
    Tensor<1, dim>
    inverse_cell_extents(const unsigned int level) const;

    /**
     * Return function @p i, in lexicographic order, of those of degree
     * @p degree that a cell sees (in part 0).
     */
    FunctionKey<dim>
    cell_function(const Index       &cell_index,
                  const unsigned int level,
                  const unsigned int degree,
                  const unsigned int i) const;

    /**
     * Return the centre of the support of a B-spline of degree @p degree (its
     * Greville point).
     */
    Point<dim>
    greville_point(const FunctionKey<dim> &key,
                   const unsigned int      degree) const;

    /**
     * Return the function of a level whose Greville point is next to @p x, in
     * part 0. Of two that are equally close, it is always the upper one, in
     * spite of roundoff in @p x.
     */
    FunctionKey<dim>
    nearest_function(const Point<dim>  &x,
                     const unsigned int level,
                     const unsigned int degree) const;

    /** Return the corner from which the indices are counted. */
    const Point<dim> &
    origin() const;

    /** The coarse cells of a grid do not form a lattice. */
    DeclException0(ExcNotCartesian);

  private:
    Point<dim>         lower_corner;
    Tensor<1, dim>     coarse_extents;
    Tensor<1, dim>     inverse_coarse_extents;
    std::vector<Index> coarse_indices;
  };
} // namespace EBSMPM

#endif
