// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/compat.h>
#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/boundary_point.h>
#include <ebsmpm/particles/material_point.h>
#include <ebsmpm/particles/point_set.h>

#include <deal.II/distributed/tria.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

namespace EBSMPM
{
  namespace
  {
    // The position of a leaf along the space-filling curve of p4est: the tree,
    // which is what a distributed triangulation uses for the id of the coarse
    // cell, and the way down from its root. The children of a cell come in the
    // same order in deal.II and p4est.
    using CurveKey =
      std::pair<types::coarse_cell_id, std::vector<std::uint8_t>>;



    CurveKey
    curve_key(const CellId &id)
    {
      const ArrayView<const std::uint8_t> children = id.get_child_indices();
      return {id.get_coarse_cell_id(),
              std::vector<std::uint8_t>(children.begin(), children.end())};
    }



    // Let two particles change places.
    template <typename Particle>
    void
    swap_particles(Particle &a, Particle &b)
    {
      const auto location = a.get_location();
      a.set_location(b.get_location());
      b.set_location(location);

      const auto reference_location = a.get_reference_location();
      a.set_reference_location(b.get_reference_location());
      b.set_reference_location(reference_location);

      const auto id = a.get_id();
      a.set_id(b.get_id());
      b.set_id(id);

      const ArrayView<double> properties = a.get_properties();
      std::swap_ranges(properties.begin(),
                       properties.end(),
                       b.get_properties().begin());
    }
  } // namespace



  template <int dim, typename View>
  PointSet<dim, View>::PointSet(const Triangulation<dim> &triangulation,
                                const Mapping<dim>       &mapping)
    : tria(triangulation)
    , cell_locator(triangulation, mapping)
    , particle_handler(triangulation, mapping, View::n_properties)
  {
    Assert((Utilities::MPI::n_mpi_processes(get_mpi_communicator(tria)) == 1 ||
            dynamic_cast<const parallel::distributed::Triangulation<dim> *>(
              &tria) != nullptr),
           ExcMessage("On several processes, points need a "
                      "parallel::distributed::Triangulation."));
  }



  template <int dim, typename View>
  std::vector<types::particle_index>
  PointSet<dim, View>::number_along_curve(
    const std::vector<NewPoint> &points,
    std::vector<unsigned int>   &order) const
  {
    // Sort by cell, leaving the points of each cell in the given order...
    order.resize(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&points](const unsigned int i, const unsigned int j) {
                       return points[i].cell->active_cell_index() <
                              points[j].cell->active_cell_index();
                     });

    // ...then sort the cells along the curve.
    struct CellPoints
    {
      CurveKey     key;
      unsigned int begin, end;
    };
    std::vector<CellPoints> cells;
    for (unsigned int i = 0; i < order.size(); ++i)
      {
        const cell_iterator &cell = points[order[i]].cell;
        Assert(cell->is_locally_owned(),
               ExcMessage("Points must be inserted by the process that owns "
                          "their cell."));
        if (i == 0 || cell != points[order[i - 1]].cell)
          cells.push_back({curve_key(cell->id()), i, i});
        cells.back().end = i + 1;
      }
    std::sort(cells.begin(),
              cells.end(),
              [](const CellPoints &a, const CellPoints &b) {
                return a.key < b.key;
              });

    std::vector<unsigned int> new_order;
    new_order.reserve(order.size());
    for (const CellPoints &cell : cells)
      new_order.insert(new_order.end(),
                       order.begin() + cell.begin,
                       order.begin() + cell.end);
    order = new_order;

    // p4est gives each process one piece of the curve, in the order of the
    // ranks.
    const std::uint64_t n_local = points.size();
    std::uint64_t       offset  = 0;
    const MPI_Comm      comm    = get_mpi_communicator(tria);
    const std::uint64_t n_total = Utilities::MPI::sum(n_local, comm);
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        const int ierr =
          MPI_Exscan(&n_local, &offset, 1, MPI_UINT64_T, MPI_SUM, comm);
        AssertThrowMPI(ierr);
        if (Utilities::MPI::this_mpi_process(comm) == 0)
          offset = 0;
      }
    if (n_global() > 0)
      offset += particle_handler.get_next_free_particle_index();
    AssertThrow(n_total + n_global() <
                  std::numeric_limits<types::particle_index>::max(),
                ExcInput("There are more points than the numbers of this build "
                         "of deal.II can count; configure deal.II with "
                         "64-bit indices."));

    std::vector<types::particle_index> ids(points.size());
    for (unsigned int i = 0; i < order.size(); ++i)
      ids[order[i]] = offset + i;
    return ids;
  }



  template <int dim, typename View>
  void
  PointSet<dim, View>::sort_within_cell(const cell_iterator &cell)
  {
    scratch.clear();
    const auto particles = particle_handler.particles_in_cell(cell);
    for (auto particle = particles.begin(); particle != particles.end();
         ++particle)
      scratch.push_back(particle);

    // Selection sort: few particles, of which still fewer are out of place.
    for (unsigned int i = 0; i + 1 < scratch.size(); ++i)
      {
        unsigned int smallest = i;
        for (unsigned int j = i + 1; j < scratch.size(); ++j)
          if (scratch[j]->get_id() < scratch[smallest]->get_id())
            smallest = j;
        if (smallest != i)
          swap_particles(*scratch[i], *scratch[smallest]);
      }
  }



  template <int dim, typename View>
  void
  PointSet<dim, View>::sort()
  {
    cell_locator.update();
    const cell_iterator nowhere(tria.end());

    // Where to look for the cell of a point.
    const auto target = [this](const Point<dim>        &location,
                               const ArrayView<double> &properties) {
      return search_position(location, View(properties).search_direction());
    };

    // Find the points that have left their cells.
    struct Mover
    {
      particle_iterator particle;
      cell_iterator     origin;
      cell_iterator     destination;
    };
    std::vector<Mover> movers;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto particles = particle_handler.particles_in_cell(cell);
          if (particles.begin() == particles.end())
            continue;
          const auto box = cell_locator.box(cell);
          for (auto particle = particles.begin(); particle != particles.end();
               ++particle)
            {
              const Point<dim> &location = particle->get_location();
              if (box.contains(target(location, particle->get_properties())))
                particle->set_reference_location(box.to_unit(location));
              else
                movers.push_back({particle, cell, nowhere});
            }
        }

    // Decide where they go: to an own cell, or to another process; in the
    // latter case ask all that come into question. A message is a sequence of
    // location, number and properties for each point.
    constexpr unsigned int n_data = dim + 1 + View::n_properties;

    std::map<unsigned int, std::vector<double>>       messages;
    std::map<unsigned int, std::vector<unsigned int>> senders;
    std::uint64_t                                     n_leaving = 0;

    const auto pack = [](particle_iterator    particle,
                         std::vector<double> &data) {
      for (unsigned int d = 0; d < dim; ++d)
        data.push_back(particle->get_location()[d]);
      data.push_back(particle->get_id());
      const ArrayView<double> properties = particle->get_properties();
      data.insert(data.end(), properties.begin(), properties.end());
    };

    for (unsigned int i = 0; i < movers.size(); ++i)
      {
        particle_iterator particle = movers[i].particle;
        const Point<dim>  p =
          target(particle->get_location(), particle->get_properties());

        cell_iterator cell = cell_locator.find_from(movers[i].origin, p);
        if (cell == nowhere)
          cell = cell_locator.find_owned(p);

        if (cell != nowhere && cell->is_locally_owned())
          {
            movers[i].destination = cell;
            continue;
          }

        ++n_leaving;
        const std::vector<unsigned int> ranks =
          (cell != nowhere ?
             std::vector<unsigned int>(1, cell->subdomain_id()) :
             cell_locator.candidate_ranks(p));
        for (const unsigned int rank : ranks)
          {
            pack(particle, messages[rank]);
            senders[rank].push_back(i);
          }
      }

    const MPI_Comm      comm      = get_mpi_communicator(tria);
    const std::uint64_t counts[2] = {movers.size(), n_leaving};
    std::uint64_t       global_counts[2];
    Utilities::MPI::sum(counts, comm, global_counts);
    if (global_counts[0] == 0)
      return;

    // Take those points that are in own cells.
    struct Arrival
    {
      ArrayView<double> data;
      cell_iterator     cell;
    };
    std::map<unsigned int, std::vector<double>>       received;
    std::map<unsigned int, std::vector<unsigned int>> replies;
    std::vector<Arrival>                              arrivals;
    if (global_counts[1] > 0)
      {
        received = Utilities::MPI::some_to_some(comm, messages);
        for (auto &message : received)
          for (std::size_t i = 0; i < message.second.size(); i += n_data)
            {
              double *const data = message.second.data() + i;
              Point<dim>    location;
              for (unsigned int d = 0; d < dim; ++d)
                location[d] = data[d];
              const cell_iterator cell = cell_locator.find_owned(
                target(location,
                       ArrayView<double>(data + dim + 1, View::n_properties)));
              replies[message.first].push_back(cell != nowhere);
              if (cell != nowhere)
                arrivals.push_back({ArrayView<double>(data, n_data), cell});
            }

        // If nobody has taken a point, nothing must have changed.
        const std::uint64_t n_taken =
          Utilities::MPI::sum(static_cast<std::uint64_t>(arrivals.size()),
                              comm);
        if (n_taken != global_counts[1])
          {
            const auto answers = Utilities::MPI::some_to_some(comm, replies);
            std::vector<bool> placed(movers.size());
            for (unsigned int i = 0; i < movers.size(); ++i)
              placed[i] = (movers[i].destination != nowhere);
            for (const auto &answer : answers)
              for (unsigned int i = 0; i < answer.second.size(); ++i)
                if (answer.second[i] != 0)
                  placed[senders[answer.first][i]] = true;

            // Larger than all numbers of points. Not the largest unsigned one,
            // which some versions of Open MPI take for negative.
            std::uint64_t id = std::numeric_limits<std::int64_t>::max();
            Point<dim>    location;
            for (unsigned int i = 0; i < movers.size(); ++i)
              if (!placed[i] && movers[i].particle->get_id() < id)
                {
                  id       = movers[i].particle->get_id();
                  location = movers[i].particle->get_location();
                }
            const std::uint64_t first_id = Utilities::MPI::min(id, comm);
            if (id != first_id)
              location = Point<dim>();
            const Tensor<1, dim> where =
              Utilities::MPI::sum(static_cast<Tensor<1, dim>>(location), comm);

            std::ostringstream position;
            for (unsigned int d = 0; d < dim; ++d)
              position << (d > 0 ? ", " : "") << where[d];
            AssertThrow(false,
                        ExcPointOutsideGrid(position.str(),
                                            cell_locator.describe_grid()));
          }
      }

    // Now move them. Removing a particle moves the last one of its cell to its
    // place, so we keep the contents of those that stay on this process, and
    // begin with the last.
    std::vector<double>        own_data;
    std::vector<cell_iterator> changed_cells;
    for (const Mover &mover : movers)
      {
        changed_cells.push_back(mover.origin);
        if (mover.destination != nowhere)
          pack(mover.particle, own_data);
      }
    for (auto mover = movers.rbegin(); mover != movers.rend(); ++mover)
      particle_handler.remove_particle(mover->particle);

    const auto insert = [&](const double *data, const cell_iterator &cell) {
      Point<dim> location;
      for (unsigned int d = 0; d < dim; ++d)
        location[d] = data[d];
      particle_handler.insert_particle(
        location,
        cell_locator.box(cell).to_unit(location),
        static_cast<types::particle_index>(data[dim]),
        cell,
        ArrayView<const double>(data + dim + 1, View::n_properties));
      changed_cells.push_back(cell);
    };
    const double *data = own_data.data();
    for (const Mover &mover : movers)
      if (mover.destination != nowhere)
        {
          insert(data, mover.destination);
          data += n_data;
        }
    for (const Arrival &arrival : arrivals)
      insert(arrival.data.data(), arrival.cell);

    std::sort(changed_cells.begin(),
              changed_cells.end(),
              [](const cell_iterator &a, const cell_iterator &b) {
                return a->active_cell_index() < b->active_cell_index();
              });
    changed_cells.erase(std::unique(changed_cells.begin(), changed_cells.end()),
                        changed_cells.end());
    for (const cell_iterator &cell : changed_cells)
      sort_within_cell(cell);

    particle_handler.update_cached_numbers();
  }



  template <int dim, typename View>
  void
  PointSet<dim, View>::prepare_for_repartitioning()
  {
    particle_handler.prepare_for_coarsening_and_refinement();
  }



  template <int dim, typename View>
  void
  PointSet<dim, View>::finish_repartitioning()
  {
    particle_handler.unpack_after_coarsening_and_refinement();
    restore_order();
  }



  template <int dim, typename View>
  void
  PointSet<dim, View>::prepare_for_serialization()
  {
    particle_handler.prepare_for_serialization();
  }



  template <int dim, typename View>
  void
  PointSet<dim, View>::deserialize()
  {
    particle_handler.deserialize();
    restore_order();
  }



  template <int dim, typename View>
  void
  PointSet<dim, View>::restore_order()
  {
    sort();
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        sort_within_cell(cell);
    particle_handler.update_cached_numbers();
  }



  template <int dim, typename View>
  void
  PointSet<dim, View>::copy_from(const PointSet<dim, View> &other)
  {
    AssertThrow(&tria == &other.tria,
                ExcMessage("The two sets live on different grids."));
    particle_handler.copy_from(other.particle_handler);
  }



  template class PointSet<2, MaterialPoint<2>>;
  template class PointSet<3, MaterialPoint<3>>;
  template class PointSet<2, BoundaryPoint<2>>;
  template class PointSet<3, BoundaryPoint<3>>;
} // namespace EBSMPM
