// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_compat_h
#define ebsmpm_base_compat_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/index_set.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/tria.h>

#include <deal.II/lac/affine_constraints.h>

/**
 * All differences between the versions of deal.II that we support, in one
 * place. The rest of the library calls these functions and knows of one
 * version only.
 */
namespace EBSMPM
{
  /**
   * Return the communicator of a triangulation. The function was renamed in
   * deal.II 9.7.
   */
  template <int dim, int spacedim>
  inline MPI_Comm
  get_mpi_communicator(const Triangulation<dim, spacedim> &triangulation)
  {
#if DEAL_II_VERSION_GTE(9, 7, 0)
    return triangulation.get_mpi_communicator();
#else
    return triangulation.get_communicator();
#endif
  }



  /**
   * Empty @p constraints and tell them which indices this process owns and
   * which it can have lines for. Since deal.II 9.6 the object wants to know
   * both.
   */
  inline void
  reinit_constraints(AffineConstraints<double> &constraints,
                     const IndexSet            &locally_owned,
                     const IndexSet            &locally_relevant)
  {
#if DEAL_II_VERSION_GTE(9, 6, 0)
    constraints.reinit(locally_owned, locally_relevant);
#else
    (void)locally_owned;
    constraints.reinit(locally_relevant);
#endif
  }



  /**
   * Distribute the cells of @p triangulation anew, such that each process gets
   * the same sum of the weights returned by @p weight for a cell. Collective.
   *
   * The signal that deal.II asks for the weights was renamed in version 9.5,
   * and the weight of the cell itself, to which the result was added before,
   * became part of the answer.
   */
  template <int dim, typename Weight>
  inline void
  repartition_by_weight(
    parallel::distributed::Triangulation<dim> &triangulation,
    const Weight                              &weight)
  {
#if DEAL_II_VERSION_GTE(9, 5, 0)
    auto                  &signal = triangulation.signals.weight;
    constexpr unsigned int base   = 1;
#else
    auto                  &signal = triangulation.signals.cell_weight;
    constexpr unsigned int base   = 0;
#endif
    // The last argument tells what becomes of the cell; its type was renamed
    // as well.
    const auto connection =
      signal.connect([&](const typename Triangulation<dim>::cell_iterator &cell,
                         const auto) -> unsigned int {
        // The basic weight of deal.II 9.4 is 1000: points must outweigh it.
        return base + (cell->is_active() ? 10000 * weight(cell) : 0);
      });
    triangulation.repartition();
    connection.disconnect();
  }

} // namespace EBSMPM

#endif
