// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/function_directory.h>

#include <ebsmpm/assembly/field_snapshot.h>

#include <array>

namespace EBSMPM
{
  template <int dim>
  FieldSnapshot<dim>::FieldSnapshot(const SplineSpace<dim> &space,
                                    const LA::FieldVector  &original)
  {
    reinit(space, original);
  }



  template <int dim>
  void
  FieldSnapshot<dim>::reinit(const SplineSpace<dim> &space,
                             const LA::FieldVector  &original)
  {
    if (original.size() == 0)
      return;
    is_elsewhere  = false;
    had_here      = Coefficients();
    functions     = space.share_functions();
    n_independent = space.n_independent();
    field.reinit(original, true);
    field = original;
    field.update_ghost_values();
  }



  template <int dim>
  void
  FieldSnapshot<dim>::reinit(const Coefficients &coefficients)
  {
    is_elsewhere = true;
    had_here     = coefficients;
    functions.reset();
    n_independent = 0;
    field.reinit(0);
  }



  template <int dim>
  typename FieldSnapshot<dim>::Coefficients
  FieldSnapshot<dim>::coefficients() const
  {
    if (empty() || is_elsewhere)
      return had_here;

    // Of functions that this process owned: no other one did.
    const IndexSet     owned        = field.locally_owned_elements();
    const unsigned int n_components = field.size() / n_independent;
    Coefficients       result;
    for (const auto &entry : *functions)
      if (entry.second.index < n_independent &&
          owned.is_element(n_components * entry.second.index))
        {
          result.keys.push_back(entry.first);
          for (unsigned int a = 0; a < n_components; ++a)
            result.values.push_back(
              field(n_components * entry.second.index + a));
        }
    return result;
  }



  template <int dim>
  void
  FieldSnapshot<dim>::grid_has_moved()
  {
    if (!empty() && !is_elsewhere)
      reinit(coefficients());
  }



  template <int dim>
  bool
  FieldSnapshot<dim>::empty() const
  {
    return field.size() == 0 && !is_elsewhere;
  }



  template <int dim>
  template <int n_components>
  void
  FieldSnapshot<dim>::transfer(const SplineSpace<dim> &space,
                               LA::FieldVector        &target) const
  {
    if (empty())
      return;
    target.zero_out_ghost_values();
    if (is_elsewhere)
      {
        fetch<n_components>(space, target);
        return;
      }

    const auto &owned = space.locally_owned_independent();
    for (const auto &entry : space.functions())
      {
        if (!owned.is_element(entry.second.index))
          continue;
        const auto found = functions->find(entry.first);
        if (found == functions->end() || found->second.index >= n_independent)
          continue;
        for (unsigned int a = 0; a < n_components; ++a)
          target(n_components * entry.second.index + a) =
            field(n_components * found->second.index + a);
      }
  }



  template <int dim>
  template <int n_components>
  void
  FieldSnapshot<dim>::fetch(const SplineSpace<dim> &space,
                            LA::FieldVector        &target) const
  {
    AssertDimension(had_here.values.size(),
                    n_components * had_here.keys.size());

    // What each process knows, for those that own the functions now.
    struct Known
    {
      bool                             is_known = false;
      std::array<double, n_components> values{};
    };
    using Directory = FunctionDirectory<dim, Known>;
    typename Directory::Table table;
    for (unsigned int i = 0; i < had_here.keys.size(); ++i)
      {
        Known &known   = table[had_here.keys[i]];
        known.is_known = true;
        for (unsigned int a = 0; a < n_components; ++a)
          known.values[a] = had_here.values[n_components * i + a];
      }
    const auto &owned = space.locally_owned_independent();
    for (const auto &entry : space.functions())
      if (owned.is_element(entry.second.index))
        table.emplace(entry.first, Known());
    table = Directory(space.communicator())
              .reduce(table, [](const Known &a, const Known &b) {
                return a.is_known ? a : b;
              });
    for (const auto &entry : space.functions())
      if (owned.is_element(entry.second.index))
        for (unsigned int a = 0; a < n_components; ++a)
          target(n_components * entry.second.index + a) =
            table.at(entry.first).values[a];
  }



  template <int dim, int n_components>
  std::vector<double>
  cell_coefficients(
    const typename Triangulation<dim>::active_cell_iterator &cell,
    const SplineSpace<dim>                                  &space,
    const AffineConstraints<double>                         &constraints,
    const LA::FieldVector                                   &field)
  {
    const auto          index = space.lattice().cell_index(cell);
    const unsigned int  n     = space.n_functions_per_cell();
    std::vector<double> values(n_components * n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto *function =
          space.find(space.cell_function(index, cell->level(), i));
        // A function that only its twin is read of, or a cell without points.
        if (function == nullptr)
          return {};
        for (unsigned int a = 0; a < n_components; ++a)
          if (function->index < space.n_independent())
            values[n_components * i + a] =
              field(n_components * function->index + a);
          else
            for (const auto &term :
                 *constraints.get_constraint_entries(function->index))
              values[n_components * i + a] +=
                term.second * field(n_components * term.first + a);
      }
    return values;
  }



  template class FieldSnapshot<2>;
  template class FieldSnapshot<3>;

  template void
  FieldSnapshot<2>::transfer<1>(const SplineSpace<2> &,
                                LA::FieldVector &) const;
  template void
  FieldSnapshot<2>::transfer<2>(const SplineSpace<2> &,
                                LA::FieldVector &) const;
  template void
  FieldSnapshot<3>::transfer<1>(const SplineSpace<3> &,
                                LA::FieldVector &) const;
  template void
  FieldSnapshot<3>::transfer<3>(const SplineSpace<3> &,
                                LA::FieldVector &) const;

  template std::vector<double>
  cell_coefficients<2, 1>(
    const typename Triangulation<2>::active_cell_iterator &,
    const SplineSpace<2> &,
    const AffineConstraints<double> &,
    const LA::FieldVector &);
  template std::vector<double>
  cell_coefficients<3, 1>(
    const typename Triangulation<3>::active_cell_iterator &,
    const SplineSpace<3> &,
    const AffineConstraints<double> &,
    const LA::FieldVector &);
} // namespace EBSMPM
