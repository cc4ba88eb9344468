// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/particles/cell_points.h>

#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <algorithm>

namespace EBSMPM
{
  template <int dim>
  void
  CellPoints<dim>::reinit(Particles::ParticleHandler<dim> &handler,
                          const CartesianLattice<dim>     &lattice)
  {
    cell_list.clear();
    unit_points.clear();
    particles.clear();
    unit_points.reserve(handler.n_locally_owned_particles());
    particles.reserve(handler.n_locally_owned_particles());

    // The handler does not hand out its triangulation, but its particles do.
    if (handler.begin() == handler.end())
      return;
    const Triangulation<dim> &triangulation =
      handler.begin()->get_surrounding_cell()->get_triangulation();

    for (const auto &cell : triangulation.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const auto in_cell = handler.particles_in_cell(cell);
        if (in_cell.begin() == in_cell.end())
          continue;

        const unsigned int begin = particles.size();
        for (auto particle = in_cell.begin(); particle != in_cell.end();
             ++particle)
          particles.push_back(particle);
        std::sort(particles.begin() + begin,
                  particles.end(),
                  [](const auto &a, const auto &b) {
                    return a->get_id() < b->get_id();
                  });
        for (unsigned int q = begin; q < particles.size(); ++q)
          unit_points.push_back(particles[q]->get_reference_location());

        cell_list.push_back({cell,
                             lattice.cell_index(cell),
                             static_cast<unsigned int>(cell->level()),
                             begin,
                             static_cast<unsigned int>(particles.size())});
      }
  }



  template class CellPoints<2>;
  template class CellPoints<3>;
} // namespace EBSMPM
