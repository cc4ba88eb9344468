// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of Simulation that distributes the grid among the processes.

#include <ebsmpm/base/compat.h>

#include <ebsmpm/solvers/simulation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace EBSMPM
{
  template <int dim>
  double
  Simulation<dim>::imbalance() const
  {
    const double largest =
      Utilities::MPI::max(static_cast<double>(points.n_locally_owned()),
                          communicator);
    return largest * Utilities::MPI::n_mpi_processes(communicator) /
           points.n_global();
  }



  template <int dim>
  void
  Simulation<dim>::distribute_by_points()
  {
    points.prepare_for_repartitioning();
    boundary_points.prepare_for_repartitioning();
    const auto &handler = points.handler();
    repartition_by_weight(
      triangulation,
      [&](const typename Triangulation<dim>::cell_iterator &cell) {
        return handler.n_particles_in_cell(
          typename Triangulation<dim>::active_cell_iterator(cell));
      });
    points.finish_repartitioning();
    boundary_points.finish_repartitioning();
  }



  template <int dim>
  void
  Simulation<dim>::balance(const unsigned int n_step)
  {
    // If the cells are too large for a better distribution, do not try again
    // before it has become noticeably worse.
    constexpr double worse  = 1.05;
    const double     before = imbalance();
    if (!parameters.grid.balance ||
        before <= std::max(parameters.grid.imbalance, worse * last_imbalance))
      return;

    TimerOutput::Scope scope(timer, "balance");
    step->repartition([this]() { distribute_by_points(); });
    last_imbalance = imbalance();

    std::ostringstream text;
    text << "step " << std::setw(5) << n_step
         << "  grid distributed anew, imbalance " << before << " -> "
         << last_imbalance << '\n';
    print(text.str());
  }



  template double
  Simulation<2>::imbalance() const;
  template double
  Simulation<3>::imbalance() const;

  template void
  Simulation<2>::distribute_by_points();
  template void
  Simulation<3>::distribute_by_points();

  template void
  Simulation<2>::balance(const unsigned int);
  template void
  Simulation<3>::balance(const unsigned int);
} // namespace EBSMPM
