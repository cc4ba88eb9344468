// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_grid_watch_h
#define ebsmpm_base_grid_watch_h

#include <ebsmpm/base/config.h>

#include <deal.II/grid/tria.h>

#include <boost/signals2/connection.hpp>

#include <vector>

namespace EBSMPM
{
  /**
   * Remembers whether a grid has changed, or been distributed anew.
   *
   * @code
   * GridWatch watch(triangulation);
   * if (watch.has_changed())
   *   {
   *     // adapt to the grid
   *     watch.reset();
   *   }
   * @endcode
   *
   * What is new counts as changed. Each process speaks for itself.
   */
  class GridWatch
  {
  public:
    /** Constructor. The grid must live as long as this object. */
    template <int dim>
    explicit GridWatch(const Triangulation<dim> &triangulation)
    {
      // The first of these does not tell of a grid that is merely distributed
      // in a different way.
      const auto mark = [this]() { this->changed = true; };
      connections.emplace_back(triangulation.signals.any_change.connect(mark));
      connections.emplace_back(
        triangulation.signals.post_distributed_repartition.connect(mark));
      connections.emplace_back(
        triangulation.signals.post_distributed_load.connect(mark));
    }

    /** The grid knows where this object is. */
    GridWatch(const GridWatch &) = delete;

    /** Whether there was a change since the last reset(). */
    bool
    has_changed() const
    {
      return changed;
    }

    /** Wait for the next change. */
    void
    reset()
    {
      changed = false;
    }

  private:
    bool                                            changed = true;
    std::vector<boost::signals2::scoped_connection> connections;
  };
} // namespace EBSMPM

#endif
