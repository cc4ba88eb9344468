// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_tests_particles_points_h
#define ebsmpm_tests_particles_points_h

// What the tests of point sets have in common.

#include <ebsmpm/particles/point_set.h>

#include <cstdint>


/**
 * Print a checksum of numbers, positions and cells of all points, modulo
 * 10,000, and whether the rules hold: numbers without gaps and in ascending
 * order in each cell, reference positions that belong to the positions.
 */
template <int dim, typename View>
void
check_points(const PointSet<dim, View> &points)
{
  const auto mix = [](std::uint64_t hash, const double x) {
    return (hash ^ static_cast<std::uint64_t>(
                     static_cast<std::int64_t>(std::round(x * 9.876e6)))) *
           1099511628211ull;
  };

  std::uint64_t checksum = 0, sum_of_ids = 0, largest_id = 0;
  unsigned int  n_disordered = 0, n_displaced = 0;
  for (const auto &cell : points.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        types::particle_index last = 0;
        for (auto &particle : points.handler().particles_in_cell(cell))
          {
            const types::particle_index id   = particle.get_id();
            std::uint64_t               hash = mix(14695981039346656037ull, id);
            for (unsigned int d = 0; d < dim; ++d)
              {
                hash = mix(hash, particle.get_location()[d]);
                hash = mix(hash, cell->center()[d]);
              }
            checksum += hash >> 20;
            sum_of_ids += id;
            largest_id = std::max<std::uint64_t>(largest_id, id);
            n_disordered += (id < last);
            last = id;

            Point<dim> x;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double xi = particle.get_reference_location()[d];
                x[d] =
                  cell->vertex(0)[d] +
                  xi * (cell->vertex((1 << dim) - 1)[d] - cell->vertex(0)[d]);
                if (xi < -1e-7 || xi > 1 + 1e-7)
                  x[d] += 1e10;
              }
            n_displaced += (x.distance(particle.get_location()) > 1e-12);
          }
      }

  const std::uint64_t n = points.n_global();
  const bool          dense =
    (n == 0 ||
     (Utilities::MPI::max(largest_id, MPI_COMM_WORLD) == n - 1 &&
      Utilities::MPI::sum(sum_of_ids, MPI_COMM_WORLD) == n * (n - 1) / 2));
  deallog << "   checksum "
          << Utilities::MPI::sum(checksum, MPI_COMM_WORLD) % 10000
          << (dense ? "" : ", numbers with gaps") << ", out of order "
          << Utilities::MPI::sum(n_disordered, MPI_COMM_WORLD)
          << ", wrong reference position "
          << Utilities::MPI::sum(n_displaced, MPI_COMM_WORLD) << std::endl;
}

#endif
