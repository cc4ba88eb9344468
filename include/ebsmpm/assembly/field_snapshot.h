// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_field_snapshot_h
#define ebsmpm_assembly_field_snapshot_h

#include <ebsmpm/lac/types.h>

#include <ebsmpm/splines/spline_space.h>

#include <deal.II/base/types.h>

#include <deal.II/lac/affine_constraints.h>

#include <boost/serialization/vector.hpp>

#include <memory>
#include <vector>

namespace EBSMPM
{
  /**
   * A field together with the keys of its functions, so that it can be given to
   * a space in which these have other numbers.
   *
   * Nothing that matters is on the grid; but the last increment of displacement
   * is a good guess for the next, and the damage of the last pass one for the
   * next pass.
   *
   * @code
   * FieldSnapshot<dim> old(space, field);
   * space.reinit(...);
   * old.transfer<n_components>(space, field);
   * @endcode
   */
  template <int dim>
  class FieldSnapshot
  {
  public:
    /**
     * A part of a field that can travel: some independent functions, and their
     * coefficients, all components of a function one after the other.
     */
    struct Coefficients
    {
      std::vector<FunctionKey<dim>> keys;
      std::vector<double>           values;

      /** Write them to an archive, or read them. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &keys &values;
      }
    };

    /** Constructor of an empty snapshot. */
    FieldSnapshot() = default;

    /** Constructor, calls reinit(). */
    FieldSnapshot(const SplineSpace<dim> &space, const LA::FieldVector &field);

    /**
     * Not assignable: deal.II's vectors keep their own ghost entries when
     * something is assigned to them.
     */
    FieldSnapshot &
    operator=(const FieldSnapshot &) = delete;

    /**
     * Remember a field with its ghost entries, unless it is empty. Collective.
     */
    void
    reinit(const SplineSpace<dim> &space, const LA::FieldVector &field);

    /**
     * Remember the coefficients that all processes give together; each function
     * must come from one process, no matter from which. transfer() asks for
     * them and is collective, as after grid_has_moved().
     */
    void
    reinit(const Coefficients &coefficients);

    /**
     * Return the coefficients that this process can tell the others: those of
     * all processes together are the field.
     */
    Coefficients
    coefficients() const;

    /**
     * Say that the grid has been distributed anew, so that the functions of a
     * process are no longer those that it remembers: from now on, transfer()
     * asks the processes that had them, and is collective.
     */
    void
    grid_has_moved();

    /** Return whether there is nothing to transfer. */
    bool
    empty() const;

    /**
     * Give @p field, which is distributed for @p space and zero, the
     * coefficients that the snapshot knows. Functions that were dependent or
     * did not exist stay at zero.
     */
    template <int n_components>
    void
    transfer(const SplineSpace<dim> &space, LA::FieldVector &field) const;

  private:
    std::shared_ptr<const typename SplineSpace<dim>::FunctionTable> functions;

    types::global_dof_index n_independent = 0;
    LA::FieldVector         field;

    /** Whether there are, instead, coefficients of whoever had them. */
    bool         is_elsewhere = false;
    Coefficients had_here;

    /** The part of transfer() that asks other processes. */
    template <int n_components>
    void
    fetch(const SplineSpace<dim> &space, LA::FieldVector &field) const;
  };



  /**
   * Return the coefficients of a field that a cell sees, in part 0, with
   * constraints resolved: the components of a function one after the other, as
   * GridWriter wants them. Empty for a cell without points. The ghost entries
   * of @p field must be up to date.
   */
  template <int dim, int n_components>
  std::vector<double>
  cell_coefficients(
    const typename Triangulation<dim>::active_cell_iterator &cell,
    const SplineSpace<dim>                                  &space,
    const AffineConstraints<double>                         &constraints,
    const LA::FieldVector                                   &field);
} // namespace EBSMPM

#endif
