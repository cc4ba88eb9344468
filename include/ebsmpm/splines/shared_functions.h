// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_splines_shared_functions_h
#define ebsmpm_splines_shared_functions_h

#include <ebsmpm/base/grid_watch.h>

#include <ebsmpm/splines/cartesian_lattice.h>
#include <ebsmpm/splines/function_key.h>

#include <deal.II/grid/tria.h>

#include <unordered_set>

namespace EBSMPM
{
  /**
   * Tells which B-spline functions may also be seen by other processes: those
   * whose support is not made of cells of this process alone. About all others,
   * nobody needs to be asked.
   *
   * @code
   * SharedFunctions<dim> shared(triangulation, degree);
   * shared.update(lattice);
   * if (shared.contains(key))
   *   // ask others
   * @endcode
   *
   * Nothing is communicated.
   */
  template <int dim>
  class SharedFunctions
  {
  public:
    /** Constructor. The grid must live as long as this object. */
    SharedFunctions(const Triangulation<dim> &triangulation,
                    const unsigned int        degree);

    /**
     * Adapt to a grid that has changed, or been distributed anew; do nothing if
     * it has not.
     *
     * @param lattice that of the grid
     */
    void
    update(const CartesianLattice<dim> &lattice);

    /** Return whether other processes may see a function. */
    bool
    contains(const FunctionKey<dim> &key) const;

  private:
    const Triangulation<dim> &triangulation;
    const unsigned int        degree;

    GridWatch watch;

    /**
     * The others, in part 0: a twin has the support of its function.
     */
    std::unordered_set<FunctionKey<dim>, FunctionKeyHash<dim>> own;
  };
} // namespace EBSMPM

#endif
