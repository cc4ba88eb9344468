// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/shared_functions.h>

#include <deal.II/base/utilities.h>

#include <unordered_map>

namespace EBSMPM
{
  template <int dim>
  SharedFunctions<dim>::SharedFunctions(const Triangulation<dim> &triangulation,
                                        const unsigned int        degree)
    : triangulation(triangulation)
    , degree(degree)
    , watch(triangulation)
  {}



  template <int dim>
  void
  SharedFunctions<dim>::update(const CartesianLattice<dim> &lattice)
  {
    if (!watch.has_changed())
      return;
    watch.reset();

    // How many cells of its support are ours?
    const unsigned int n_cells =
      dealii::Utilities::fixed_power<dim>(degree + 1);
    std::unordered_map<FunctionKey<dim>, unsigned int, FunctionKeyHash<dim>>
      n_owned;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto index = lattice.cell_index(cell);
          for (unsigned int i = 0; i < n_cells; ++i)
            ++n_owned[lattice.cell_function(index, cell->level(), degree, i)];
        }

    own.clear();
    for (const auto &entry : n_owned)
      if (entry.second == n_cells)
        own.insert(entry.first);
  }



  template <int dim>
  bool
  SharedFunctions<dim>::contains(const FunctionKey<dim> &key) const
  {
    return own.count(key.with_part(0)) == 0;
  }



  template class SharedFunctions<1>;
  template class SharedFunctions<2>;
  template class SharedFunctions<3>;
} // namespace EBSMPM
