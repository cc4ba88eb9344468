// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/compat.h>

#include <ebsmpm/splines/spline_space.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace EBSMPM
{
  namespace internal
  {
    namespace SplineSpaceImplementation
    {
      /**
       * Return the first index of this process in a range that is distributed
       * rank by rank, and the size of the whole range.
       */
      std::pair<types::global_dof_index, types::global_dof_index>
      rank_by_rank(const types::global_dof_index n_local,
                   const MPI_Comm               &communicator)
      {
        types::global_dof_index first = 0;
        const int               ierr  = MPI_Exscan(&n_local,
                                    &first,
                                    1,
                                    DEAL_II_DOF_INDEX_MPI_TYPE,
                                    MPI_SUM,
                                    communicator);
        AssertThrowMPI(ierr);
        return {first, Utilities::MPI::sum(n_local, communicator)};
      }
    } // namespace SplineSpaceImplementation
  }   // namespace internal



  template <int dim>
  SplineSpace<dim>::SplineSpace(const Triangulation<dim> &triangulation,
                                const unsigned int        degree)
    : mpi_communicator(get_mpi_communicator(triangulation))
    , cell_lattice(triangulation)
    , p(degree)
    , shared_functions(triangulation, degree)
    , table(std::make_shared<const FunctionTable>())
    , directory(mpi_communicator)
  {
    Assert(degree >= 1 && degree <= 3, ExcIndexRange(degree, 1, 4));
  }



  template <int dim>
  bool
  SplineSpace<dim>::reinit(const SupportTable &supports,
                           const double        threshold,
                           const double        hysteresis)
  {
    std::vector<Renewal> renewals;
    FunctionTable        new_table =
      classify(supports, threshold, hysteresis, renewals);

    // Most often, nothing has changed since the last time but fractions.
    const auto change = static_cast<Change>(
      Utilities::MPI::max(static_cast<int>(compare(renewals)),
                          mpi_communicator));
    if (change == Change::functions)
      number(new_table);
    else
      for (const Renewal &renewal : renewals)
        renewal.now->index = renewal.before->index;

    if (change != Change::fractions)
      {
        ++change_counter;
        tell_others(new_table);
      }
    table = std::make_shared<const FunctionTable>(std::move(new_table));
    return change != Change::fractions;
  }



  template <int dim>
  typename SplineSpace<dim>::FunctionTable
  SplineSpace<dim>::classify(const SupportTable   &supports,
                             const double          threshold,
                             const double          hysteresis,
                             std::vector<Renewal> &renewals)
  {
    const unsigned int my_rank =
      Utilities::MPI::this_mpi_process(mpi_communicator);
    shared_functions.update(cell_lattice);

    // Who was standard before? What nobody here has seen comes later.
    const bool remember        = (hysteresis > 0. && change_counter > 0);
    const auto former_category = [&](const Function *function) {
      return remember && function != nullptr &&
                 function->category == FunctionClass::standard ?
               FunctionClass::standard :
               FunctionClass::deficient;
    };

    renewals.clear();
    renewals.reserve(supports.size());
    std::vector<Key> unknown;
    FunctionTable    result, shared;
    result.reserve(supports.size());
    for (const auto &entry : supports)
      {
        const Function *before = find(entry.first);
        if (before == nullptr)
          unknown.push_back(entry.first);

        Function function;
        function.owner    = my_rank;
        function.fraction = entry.second.fraction;
        function.side     = entry.second.side;
        function.category = former_category(before);
        if (shared_functions.contains(entry.first))
          shared.emplace(entry.first, function);
        else
          renewals.push_back(
            {&result.emplace(entry.first, function).first->second, before});
      }
    if (remember)
      for (const auto &entry : directory.query(unknown))
        for (FunctionTable *part : {&result, &shared})
          {
            const auto found = part->find(entry.first);
            if (found != part->end())
              found->second.category = former_category(&entry.second);
          }

    // Add up the shares. The owner is the lowest rank that sees the function.
    shared = directory.reduce(shared, [](Function a, const Function &b) {
      a.fraction += b.fraction;
      a.owner  = std::min(a.owner, b.owner);
      a.shared = true;
      if (b.category == FunctionClass::standard)
        a.category = b.category;
      return a;
    });
    for (const auto &entry : shared)
      renewals.push_back(
        {&result.insert(entry).first->second, find(entry.first)});

    // The totals are the same, bit by bit, on all processes that see a
    // function, and hence so are the classes. The relative margin keeps
    // fractions apart that differ by roundoff only.
    for (auto &entry : result)
      {
        Function    &function = entry.second;
        const double limit    = (function.category == FunctionClass::standard ?
                                   (1. - hysteresis) * threshold :
                                   threshold) *
                             (1. + 1e-9);
        function.category = entry.first.part != 0 ? FunctionClass::twin :
                            function.fraction > limit ?
                                                    FunctionClass::standard :
                                                    FunctionClass::deficient;
      }
    return result;
  }



  template <int dim>
  typename SplineSpace<dim>::Change
  SplineSpace<dim>::compare(const std::vector<Renewal> &renewals) const
  {
    if (change_counter == 0 || renewals.size() != table->size())
      return Change::functions;
    Change result = Change::fractions;
    for (const Renewal &renewal : renewals)
      {
        const Function *before = renewal.before;
        const Function &now    = *renewal.now;
        if (before == nullptr || before->category != now.category ||
            before->owner != now.owner || before->shared != now.shared)
          return Change::functions;
        if (before->side != now.side)
          result = Change::sides;
      }
    return result;
  }



  template <int dim>
  void
  SplineSpace<dim>::number(FunctionTable &functions)
  {
    using namespace internal::SplineSpaceImplementation;
    const unsigned int my_rank =
      Utilities::MPI::this_mpi_process(mpi_communicator);

    // Number what we own, in the order of the keys.
    std::vector<Key> mine[2];
    for (const auto &entry : functions)
      if (entry.second.owner == my_rank)
        mine[entry.second.category == FunctionClass::standard ? 0 : 1]
          .push_back(entry.first);
    for (auto &keys : mine)
      std::sort(keys.begin(), keys.end());

    const auto independent  = rank_by_rank(mine[0].size(), mpi_communicator);
    const auto dependent    = rank_by_rank(mine[1].size(), mpi_communicator);
    n_independent_functions = independent.second;
    n_active_functions      = independent.second + dependent.second;
    const types::global_dof_index first[2] = {independent.first,
                                              n_independent_functions +
                                                dependent.first};

    types::global_dof_index n_my_twins = 0;
    for (unsigned int c = 0; c < 2; ++c)
      for (types::global_dof_index i = 0; i < mine[c].size(); ++i)
        {
          Function &function = functions.at(mine[c][i]);
          function.index     = first[c] + i;
          n_my_twins += (function.category == FunctionClass::twin);
        }
    n_twin_functions = Utilities::MPI::sum(n_my_twins, mpi_communicator);

    owned_independent = IndexSet(n_independent_functions);
    owned_independent.add_range(first[0], first[0] + mine[0].size());
    owned = IndexSet(n_active_functions);
    owned.add_range(first[0], first[0] + mine[0].size());
    owned.add_range(first[1], first[1] + mine[1].size());
    owned_independent.compress();
    owned.compress();
  }



  template <int dim>
  void
  SplineSpace<dim>::tell_others(FunctionTable &functions)
  {
    const unsigned int my_rank =
      Utilities::MPI::this_mpi_process(mpi_communicator);

    std::vector<typename FunctionDirectory<dim, Function>::Entry> mine;
    std::vector<Key>                                              theirs;
    for (const auto &entry : functions)
      if (entry.second.owner == my_rank)
        mine.push_back({entry.first, entry.second});
      else
        theirs.push_back(entry.first);
    directory.clear();
    directory.publish(mine);
    for (const auto &entry : directory.query(theirs))
      functions[entry.first].index = entry.second.index;

    std::vector<types::global_dof_index> indices;
    indices.reserve(functions.size());
    for (const auto &entry : functions)
      indices.push_back(entry.second.index);
    std::sort(indices.begin(), indices.end());
    relevant = IndexSet(n_active_functions);
    relevant.add_indices(indices.begin(), indices.end());
    relevant.compress();
  }



  template <int dim>
  std::vector<typename SplineSpace<dim>::Key>
  SplineSpace<dim>::standard_functions() const
  {
    std::vector<Key> keys;
    keys.reserve(owned_independent.n_elements());
    for (const auto &entry : *table)
      if (owned_independent.is_element(entry.second.index))
        keys.push_back(entry.first);
    std::sort(keys.begin(), keys.end());
    return keys;
  }



  template <int dim>
  void
  SplineSpace<dim>::recall(const std::vector<Key> &standard_functions)
  {
    table                   = std::make_shared<const FunctionTable>();
    n_active_functions      = 0;
    n_independent_functions = 0;
    n_twin_functions        = 0;
    owned_independent       = IndexSet();
    owned                   = IndexSet();
    relevant                = IndexSet();

    // As if somebody else had seen them all.
    std::vector<typename FunctionDirectory<dim, Function>::Entry> entries;
    entries.reserve(standard_functions.size());
    for (const Key &key : standard_functions)
      entries.push_back({key, Function()});
    directory.clear();
    directory.publish(entries);
    ++change_counter;
  }



  template <int dim>
  const typename SplineSpace<dim>::Function *
  SplineSpace<dim>::find(const Key &key) const
  {
    const auto found = table->find(key);
    return found == table->end() ? nullptr : &found->second;
  }



  template <int dim>
  const typename SplineSpace<dim>::FunctionTable &
  SplineSpace<dim>::functions() const
  {
    return *table;
  }



  template <int dim>
  std::shared_ptr<const typename SplineSpace<dim>::FunctionTable>
  SplineSpace<dim>::share_functions() const
  {
    return table;
  }



  template <int dim>
  unsigned int
  SplineSpace<dim>::n_changes() const
  {
    return change_counter;
  }



  template <int dim>
  typename SplineSpace<dim>::FunctionTable
  SplineSpace<dim>::query(const std::vector<Key> &keys) const
  {
    return directory.query(keys);
  }



  template <int dim>
  typename SplineSpace<dim>::Key
  SplineSpace<dim>::cell_function(
    const typename CartesianLattice<dim>::Index &cell_index,
    const unsigned int                           level,
    const unsigned int                           i) const
  {
    AssertIndexRange(i, n_functions_per_cell());
    return cell_lattice.cell_function(cell_index, level, p, i);
  }



  template <int dim>
  unsigned int
  SplineSpace<dim>::degree() const
  {
    return p;
  }



  template <int dim>
  unsigned int
  SplineSpace<dim>::n_functions_per_cell() const
  {
    return Utilities::pow(p + 1, dim);
  }



  template <int dim>
  types::global_dof_index
  SplineSpace<dim>::n_functions() const
  {
    return n_active_functions;
  }



  template <int dim>
  types::global_dof_index
  SplineSpace<dim>::n_independent() const
  {
    return n_independent_functions;
  }



  template <int dim>
  types::global_dof_index
  SplineSpace<dim>::n_deficient() const
  {
    return n_active_functions - n_independent_functions - n_twin_functions;
  }



  template <int dim>
  types::global_dof_index
  SplineSpace<dim>::n_twins() const
  {
    return n_twin_functions;
  }



  template <int dim>
  const IndexSet &
  SplineSpace<dim>::locally_owned_independent() const
  {
    return owned_independent;
  }



  template <int dim>
  const IndexSet &
  SplineSpace<dim>::locally_owned() const
  {
    return owned;
  }



  template <int dim>
  const IndexSet &
  SplineSpace<dim>::locally_relevant() const
  {
    return relevant;
  }



  template <int dim>
  const CartesianLattice<dim> &
  SplineSpace<dim>::lattice() const
  {
    return cell_lattice;
  }



  template <int dim>
  const MPI_Comm &
  SplineSpace<dim>::communicator() const
  {
    return mpi_communicator;
  }



  template class SplineSpace<1>;
  template class SplineSpace<2>;
  template class SplineSpace<3>;
} // namespace EBSMPM
