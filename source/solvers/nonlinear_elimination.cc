// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/lac/local_factorization.h>

#include <ebsmpm/solvers/nonlinear_elimination.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace EBSMPM
{
  template <int dim>
  NonlinearElimination<dim>::NonlinearElimination(const AdditionalData &data)
    : data(data)
  {}



  template <int dim>
  std::vector<bool>
  NonlinearElimination<dim>::find_functions(
    const DisplacementSystem<dim> &system,
    const LA::FieldVector         &residual) const
  {
    // A function is marked in the first of its components.
    LA::FieldVector    marks   = system.make_vector();
    const double       limit   = data.large_residual * residual.linfty_norm();
    const unsigned int n_owned = marks.locally_owned_size() / dim;
    for (unsigned int i = 0; i < residual.locally_owned_size(); ++i)
      if (std::abs(residual.local_element(i)) > limit)
        marks.local_element(i / dim * dim) = 1.;
    marks.update_ghost_values();

    const PointGroups<dim> &groups = system.groups();
    for (unsigned int layer = 0; layer < data.n_layers; ++layer)
      {
        LA::FieldVector more = system.make_vector();
        for (const auto &group : groups.groups())
          {
            const auto is_marked = [&](const unsigned int i) {
              return marks.local_element(dim * i) > 0.;
            };
            if (groups.reads_any(group, is_marked))
              for (unsigned int i = 0; i < group.n_functions; ++i)
                more.local_element(dim * groups.functions(group)[i]) = 1.;
          }
        more.compress(VectorOperation::add);
        marks.zero_out_ghost_values();
        marks += more;
        marks.update_ghost_values();
      }

    std::vector<bool> result(n_owned +
                             marks.get_partitioner()->n_ghost_indices() / dim);
    for (unsigned int f = 0; f < result.size(); ++f)
      result[f] = (marks.local_element(dim * f) > 0.);
    return result;
  }



  template <int dim>
  unsigned int
  NonlinearElimination<dim>::improve(DisplacementSystem<dim>  &system,
                                     const MaterialState<dim> &state,
                                     const BoundaryState<dim> &boundary,
                                     LA::FieldVector          &increment) const
  {
    const MPI_Comm  comm     = system.space().communicator();
    LA::FieldVector residual = system.make_vector();
    system.assemble_residual(state, boundary, increment, residual);

    const std::vector<bool> functions = find_functions(system, residual);
    std::vector<int>        rows;
    for (unsigned int i = 0; i < residual.locally_owned_size(); ++i)
      if (functions[i / dim])
        rows.push_back(i);
    if (Utilities::MPI::max(rows.size(), comm) > data.max_rows)
      return 0;
    const auto norm = [&]() {
      double sum = 0.;
      for (const int row : rows)
        sum += std::pow(residual.local_element(row), 2);
      return std::sqrt(Utilities::MPI::sum(sum, comm));
    };

    const double       initial_norm = norm();
    LA::FieldVector    best         = increment;
    double             best_norm    = initial_norm;
    LocalFactorization inverse;
    unsigned int       iteration = 0;
    try
      {
        std::vector<double> update(rows.size());
        while (true)
          {
            system.assemble_tangent(
              state, boundary, increment, functions, residual);
            const double current_norm = norm();
            if (current_norm < best_norm)
              {
                best      = increment;
                best_norm = current_norm;
              }
            if (best_norm <= data.reduction * initial_norm ||
                iteration == data.max_iterations)
              break;

            ++iteration;
            for (unsigned int k = 0; k < rows.size(); ++k)
              update[k] = -residual.local_element(rows[k]);
            inverse.reinit(system.matrix(), rows);
            inverse.solve(update.data());
            increment.zero_out_ghost_values();
            for (unsigned int k = 0; k < rows.size(); ++k)
              increment.local_element(rows[k]) += update[k];
          }
      }
    catch (const ExcSolverFailure &)
      {
        // A point was turned inside out, which all processes know.
      }
    increment.zero_out_ghost_values();
    best.zero_out_ghost_values();
    increment = best;
    return iteration;
  }



  template class NonlinearElimination<2>;
  template class NonlinearElimination<3>;
} // namespace EBSMPM
