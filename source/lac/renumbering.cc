// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/lac/renumbering.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>

namespace EBSMPM
{
  Renumbering::Renumbering(const IndexSet &rows, const MPI_Comm &communicator)
    : original_rows(rows)
    , original_src(rows, communicator)
    , original_dst(rows, communicator)
    , rows(rows)
  {
    original_numbers.reserve(rows.n_elements());
    for (const auto row : rows)
      original_numbers.push_back(row);
  }



  void
  Renumbering::renumber(const IndexSet &                            new_rows,
                        const std::vector<types::global_dof_index> &old_numbers)
  {
    AssertDimension(old_numbers.size(), new_rows.n_elements());
    const MPI_Comm communicator = original_src.get_mpi_communicator();

    // Ask the former owners for the original numbers. They go through a vector
    // of doubles, in which whole numbers are exact.
    LA::Vector original(rows, communicator);
    for (unsigned int i = 0; i < original_numbers.size(); ++i)
      original.begin()[i] =
        original_numbers[i] == numbers::invalid_dof_index ?
          -1. :
          static_cast<double>(original_numbers[i]);
    std::vector<types::global_dof_index> wanted;
    for (const auto number : old_numbers)
      if (number != numbers::invalid_dof_index && !rows.is_element(number))
        wanted.push_back(number);
    std::sort(wanted.begin(), wanted.end());
    IndexSet relevant = rows;
    relevant.add_indices(wanted.begin(), wanted.end());
    LA::Vector known(rows, relevant, communicator);
    known = original;

    rows = new_rows;
    original_numbers.assign(old_numbers.size(), numbers::invalid_dof_index);
    new_unknowns.clear();
    DynamicSparsityPattern sparsity(rows.size(), original_rows.size(), rows);
    for (unsigned int i = 0; i < old_numbers.size(); ++i)
      {
        double number = -1.;
        if (old_numbers[i] != numbers::invalid_dof_index)
          number = known(old_numbers[i]);
        if (number >= 0.)
          {
            original_numbers[i] = static_cast<types::global_dof_index>(number);
            sparsity.add(rows.nth_index_in_set(i), original_numbers[i]);
          }
        else
          new_unknowns.push_back(i);
      }
    inverse_diagonal.assign(new_unknowns.size(), 0.);

    transposed_permutation.reinit(
      rows, original_rows, sparsity, communicator, false);
    for (unsigned int i = 0; i < original_numbers.size(); ++i)
      if (original_numbers[i] != numbers::invalid_dof_index)
        transposed_permutation.set(rows.nth_index_in_set(i),
                                   original_numbers[i],
                                   1.);
    transposed_permutation.compress(VectorOperation::insert);
  }



  void
  Renumbering::set_diagonal(const LA::SparseMatrix &A)
  {
    Assert(A.locally_owned_range_indices() == rows, ExcInternalError());
    for (unsigned int k = 0; k < new_unknowns.size(); ++k)
      {
        const auto   row      = rows.nth_index_in_set(new_unknowns[k]);
        const double diagonal = std::abs(A.diag_element(row));
        inverse_diagonal[k]   = diagonal > 0. ? 1. / diagonal : 0.;
      }
  }



  void
  Renumbering::vmult(const ReusablePreconditioner &M,
                     LA::Vector &                  dst,
                     const LA::Vector &            src) const
  {
    transposed_permutation.Tvmult(original_src, src);
    M.vmult(original_dst, original_src);
    transposed_permutation.vmult(dst, original_dst);

    double *const       to   = dst.begin();
    const double *const from = src.begin();
    for (unsigned int k = 0; k < new_unknowns.size(); ++k)
      to[new_unknowns[k]] = inverse_diagonal[k] * from[new_unknowns[k]];
  }
} // namespace EBSMPM
