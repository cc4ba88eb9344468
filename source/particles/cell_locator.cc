// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/compat.h>

#include <ebsmpm/particles/cell_locator.h>

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <limits>
#include <sstream>

namespace EBSMPM
{
  namespace
  {
    // The tolerance in terms of the smallest cell. Positions are accurate to
    // about 1e-16 of their size, so this leaves room for grids of some 10,000
    // cells per direction.
    constexpr double relative_tolerance = 1e-10;

    // Points that move over more cells than this are searched in the tree.
    constexpr unsigned int max_steps = 64;
  } // namespace



  template <int dim>
  unsigned int
  CellLocator<dim>::Box::face_towards(const Point<dim> &p) const
  {
    unsigned int face    = numbers::invalid_unsigned_int;
    double       largest = -1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double below = (lower_limit[d] - p[d]) * inverse_extents[d];
        const double above = (p[d] - upper_limit[d]) * inverse_extents[d];
        // The lower end of the interval belongs to it, the upper one does not.
        if (below > 0 && below > largest)
          {
            largest = below;
            face    = 2 * d;
          }
        if (above >= 0 && above > largest)
          {
            largest = above;
            face    = 2 * d + 1;
          }
      }
    return face;
  }



  template <int dim>
  CellLocator<dim>::CellLocator(const Triangulation<dim> &triangulation,
                                const Mapping<dim>       &mapping)
    : triangulation(triangulation)
    , own_rank(
        Utilities::MPI::this_mpi_process(get_mpi_communicator(triangulation)))
    , cache(triangulation, mapping)
    , watch(triangulation)
    , absolute_tolerance(0)
  {
    update();
  }



  template <int dim>
  void
  CellLocator<dim>::update()
  {
    const MPI_Comm comm = get_mpi_communicator(triangulation);
    if (Utilities::MPI::max(watch.has_changed() ? 1u : 0u, comm) == 0)
      return;
    // The locator may be older than the grid, which is then still empty.
    if (triangulation.n_levels() == 0)
      return;
    watch.reset();
    cache.mark_for_update();

    double                    smallest = std::numeric_limits<double>::max();
    std::array<Point<dim>, 2> corners;
    for (unsigned int d = 0; d < dim; ++d)
      {
        corners[0][d] = std::numeric_limits<double>::max();
        corners[1][d] = std::numeric_limits<double>::lowest();
      }
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const Point<dim> &lower = cell->vertex(0);
          const Point<dim> &upper =
            cell->vertex(GeometryInfo<dim>::vertices_per_cell - 1);
          for (unsigned int d = 0; d < dim; ++d)
            {
              smallest      = std::min(smallest, upper[d] - lower[d]);
              corners[0][d] = std::min(corners[0][d], lower[d]);
              corners[1][d] = std::max(corners[1][d], upper[d]);
            }
        }

    absolute_tolerance =
      relative_tolerance * Utilities::MPI::min(smallest, comm);

    std::vector<double> own;
    for (const Point<dim> &corner : corners)
      for (unsigned int d = 0; d < dim; ++d)
        own.push_back(corner[d]);
    const std::vector<std::vector<double>> all =
      Utilities::MPI::all_gather(comm, own);
    boxes.resize(all.size());
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          boxes[rank][c][d] = all[rank][c * dim + d];
  }



  template <int dim>
  typename CellLocator<dim>::cell_iterator
  CellLocator<dim>::find_from(const cell_iterator &start,
                              const Point<dim>    &p) const
  {
    const cell_iterator end(triangulation.end());

    cell_iterator cell = start;
    for (unsigned int step = 0; step < max_steps; ++step)
      {
        if (cell->is_artificial())
          return end;

        const unsigned int face = box(cell).face_towards(p);
        if (face == numbers::invalid_unsigned_int)
          return cell;
        if (cell->at_boundary(face))
          return end;

        // The neighbor may be refined; go on with its child next to the point.
        typename Triangulation<dim>::cell_iterator neighbor =
          cell->neighbor(face);
        while (neighbor->has_children())
          {
            const Point<dim> &lower = neighbor->vertex(0);
            const Point<dim> &upper =
              neighbor->vertex(GeometryInfo<dim>::vertices_per_cell - 1);
            unsigned int child = 0;
            for (unsigned int d = 0; d < dim; ++d)
              if (p[d] >= 0.5 * (lower[d] + upper[d]) - absolute_tolerance)
                child += (1 << d);
            neighbor = neighbor->child(child);
          }
        cell = neighbor;
      }
    return end;
  }



  template <int dim>
  typename CellLocator<dim>::cell_iterator
  CellLocator<dim>::find_owned(const Point<dim> &p) const
  {
    // Most points that are not here are not even close.
    if (!is_in_box(p, own_rank))
      return cell_iterator(triangulation.end());

    Point<dim> lower = p, upper = p;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] -= 2. * absolute_tolerance;
        upper[d] += 2. * absolute_tolerance;
      }
    const BoundingBox<dim> surroundings(std::make_pair(lower, upper));

    const auto &tree = cache.get_locally_owned_cell_bounding_boxes_rtree();
    for (auto candidate =
           tree.qbegin(boost::geometry::index::intersects(surroundings));
         candidate != tree.qend();
         ++candidate)
      if (box(candidate->second).contains(p))
        return candidate->second;
    return cell_iterator(triangulation.end());
  }



  template <int dim>
  std::vector<unsigned int>
  CellLocator<dim>::candidate_ranks(const Point<dim> &p) const
  {
    std::vector<unsigned int> ranks;
    for (unsigned int rank = 0; rank < boxes.size(); ++rank)
      if (rank != own_rank && is_in_box(p, rank))
        ranks.push_back(rank);
    return ranks;
  }



  template <int dim>
  bool
  CellLocator<dim>::is_in_box(const Point<dim>  &p,
                              const unsigned int rank) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (p[d] < boxes[rank][0][d] - absolute_tolerance ||
          p[d] > boxes[rank][1][d] + absolute_tolerance)
        return false;
    return true;
  }



  template <int dim>
  std::string
  CellLocator<dim>::describe_grid() const
  {
    Point<dim> lower = boxes[0][0];
    Point<dim> upper = boxes[0][1];
    for (const auto &box : boxes)
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], box[0][d]);
          upper[d] = std::max(upper[d], box[1][d]);
        }

    std::ostringstream text;
    for (unsigned int d = 0; d < dim; ++d)
      text << (d > 0 ? " x " : "") << '[' << lower[d] << ", " << upper[d]
           << ']';
    return text.str();
  }



  template class CellLocator<2>;
  template class CellLocator<3>;
} // namespace EBSMPM
