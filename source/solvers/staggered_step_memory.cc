// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of StaggeredStep that hands over to another grid, or to another run.

#include <ebsmpm/solvers/staggered_step.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace EBSMPM
{
  namespace
  {
    template <typename T>
    void
    append_to(std::vector<T> &list, const std::vector<T> &more)
    {
      list.insert(list.end(), more.begin(), more.end());
    }
  } // namespace



  template <int dim>
  void
  StaggeredStep<dim>::Memory::append(const Memory &other)
  {
    append_to(standard_u, other.standard_u);
    append_to(standard_d, other.standard_d);
    append_to(damage.keys, other.damage.keys);
    append_to(damage.values, other.damage.values);
    append_to(last_increment.keys, other.last_increment.keys);
    append_to(last_increment.values, other.last_increment.values);
    largest_force  = std::max(largest_force, other.largest_force);
    first_residual = std::max(first_residual, other.first_residual);
  }



  template <int dim>
  typename StaggeredStep<dim>::Memory
  StaggeredStep<dim>::memory() const
  {
    Memory memory;
    memory.standard_u     = u_space.standard_functions();
    memory.standard_d     = d_space.standard_functions();
    memory.damage         = FieldSnapshot<dim>(d_space, d_field).coefficients();
    memory.last_increment = last_increment.coefficients();
    memory.largest_force  = largest_force;
    memory.first_residual = first_residual;
    return memory;
  }



  template <int dim>
  void
  StaggeredStep<dim>::recall(const Memory &memory)
  {
    // A process that has nothing to tell may not know these.
    const MPI_Comm &communicator = d_space.communicator();
    largest_force  = Utilities::MPI::max(memory.largest_force, communicator);
    first_residual = Utilities::MPI::max(memory.first_residual, communicator);

    u_solver.clear();
    d_solver.clear();
    partition.clear();
    u_space.recall(memory.standard_u);
    d_space.recall(memory.standard_d);
    u_increment.reinit(0);
    last_increment.reinit(memory.last_increment);
    FieldSnapshot<dim> old_damage;
    old_damage.reinit(memory.damage);
    begin(old_damage);
  }



  template <int dim>
  void
  StaggeredStep<dim>::repartition(const std::function<void()> &move)
  {
    FieldSnapshot<dim> old_damage(d_space, d_field);
    old_damage.grid_has_moved();
    last_increment.grid_has_moved();

    // Nothing of the old distribution is to be looked at again.
    u_increment.reinit(0);
    move();
    begin(old_damage);
  }



  template void
  StaggeredStep<2>::Memory::append(const Memory &);
  template void
  StaggeredStep<3>::Memory::append(const Memory &);

  template typename StaggeredStep<2>::Memory
  StaggeredStep<2>::memory() const;
  template typename StaggeredStep<3>::Memory
  StaggeredStep<3>::memory() const;
  template void
  StaggeredStep<2>::recall(const Memory &);
  template void
  StaggeredStep<3>::recall(const Memory &);
  template void
  StaggeredStep<2>::repartition(const std::function<void()> &);
  template void
  StaggeredStep<3>::repartition(const std::function<void()> &);
} // namespace EBSMPM
