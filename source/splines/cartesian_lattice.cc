// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/cartesian_lattice.h>

#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <cmath>

namespace EBSMPM
{
  template <int dim>
  CartesianLattice<dim>::CartesianLattice(
    const Triangulation<dim> &triangulation)
  {
    constexpr unsigned int n_vertices = GeometryInfo<dim>::vertices_per_cell;

    lower_corner = triangulation.begin(0)->vertex(0);
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      for (unsigned int d = 0; d < dim; ++d)
        lower_corner[d] = std::min(lower_corner[d], cell->vertex(0)[d]);

    coarse_extents = triangulation.begin(0)->vertex(n_vertices - 1) -
                     triangulation.begin(0)->vertex(0);
    for (unsigned int d = 0; d < dim; ++d)
      {
        AssertThrow(coarse_extents[d] > 0., ExcNotCartesian());
        inverse_coarse_extents[d] = 1. / coarse_extents[d];
      }

    coarse_indices.resize(triangulation.n_cells(0));
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      {
        // The id of a coarse cell is not its index: p4est numbers its trees
        // in an order of its own.
        const auto id = cell->id().get_coarse_cell_id();
        if (id >= coarse_indices.size())
          coarse_indices.resize(id + 1);

        for (unsigned int d = 0; d < dim; ++d)
          {
            const double position =
              (cell->vertex(0)[d] - lower_corner[d]) / coarse_extents[d];
            AssertThrow(std::abs(position - std::round(position)) < 1e-6,
                        ExcNotCartesian());
            coarse_indices[id][d] =
              static_cast<std::int32_t>(std::lround(position));

            // Bit d of the number of a vertex says on which side it is.
            for (unsigned int v = 0; v < n_vertices; ++v)
              AssertThrow(std::abs(cell->vertex(v)[d] - cell->vertex(0)[d] -
                                   ((v >> d) & 1) * coarse_extents[d]) <
                            1e-6 * coarse_extents[d],
                          ExcNotCartesian());
          }
      }
  }



  template <int dim>
  typename CartesianLattice<dim>::Index
  CartesianLattice<dim>::cell_index(
    const typename Triangulation<dim>::cell_iterator &cell) const
  {
    const CellId id     = cell->id();
    Index        result = coarse_indices[id.get_coarse_cell_id()];

    // Bit d of a child's number says whether it is the upper half in
    // direction d.
    for (const auto child : id.get_child_indices())
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = 2 * result[d] + ((child >> d) & 1);
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  CartesianLattice<dim>::cell_extents(const unsigned int level) const
  {
    return coarse_extents / static_cast<double>(1U << level);
  }



  template <int dim>
  Tensor<1, dim>
  CartesianLattice<dim>::inverse_cell_extents(const unsigned int level) const
  {
    return inverse_coarse_extents * static_cast<double>(1U << level);
  }



  template <int dim>
  FunctionKey<dim>
  CartesianLattice<dim>::cell_function(const Index       &cell_index,
                                       const unsigned int level,
                                       const unsigned int degree,
                                       const unsigned int i) const
  {
    FunctionKey<dim> result;
    result.level = level;
    result.index = cell_index;
    for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= degree + 1)
      result.index[d] += rest % (degree + 1);
    return result;
  }



  template <int dim>
  Point<dim>
  CartesianLattice<dim>::greville_point(const FunctionKey<dim> &key,
                                        const unsigned int      degree) const
  {
    const Tensor<1, dim> h = cell_extents(key.level);
    Point<dim>           result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = lower_corner[d] + (key.index[d] + 0.5 * (1. - degree)) * h[d];
    return result;
  }



  template <int dim>
  FunctionKey<dim>
  CartesianLattice<dim>::nearest_function(const Point<dim>  &x,
                                          const unsigned int level,
                                          const unsigned int degree) const
  {
    constexpr double     margin = 1e-6;
    const Tensor<1, dim> h      = cell_extents(level);
    FunctionKey<dim>     result;
    result.level = level;
    for (unsigned int d = 0; d < dim; ++d)
      result.index[d] = static_cast<std::int32_t>(std::floor(
        (x[d] - lower_corner[d]) / h[d] - 0.5 * (1. - degree) + 0.5 + margin));
    return result;
  }



  template <int dim>
  const Point<dim> &
  CartesianLattice<dim>::origin() const
  {
    return lower_corner;
  }



  template class CartesianLattice<1>;
  template class CartesianLattice<2>;
  template class CartesianLattice<3>;
} // namespace EBSMPM
