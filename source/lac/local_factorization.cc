// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/lac/klu_factorization.h>
#include <ebsmpm/lac/local_factorization.h>
#include <ebsmpm/lac/mumps_factorization.h>

#include <deal.II/base/index_set.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace EBSMPM
{
  namespace
  {
    // Up to this size, what MUMPS does before it begins takes longer than KLU.
    constexpr unsigned int largest_for_klu = 1000;
  } // namespace



  LocalFactorization::LocalFactorization() = default;



  LocalFactorization::~LocalFactorization() = default;



  unsigned int
  LocalFactorization::largest_size()
  {
    return MumpsFactorization::is_available() ? 10000 : largest_for_klu;
  }



  void
  LocalFactorization::reinit(const LA::SparseMatrix &A,
                             const std::vector<int> &rows)
  {
    factorization.reset();
    n = rows.size();
    if (n == 0)
      return;

    // Where a column of the matrix is among the rows.
    const Epetra_CrsMatrix &matrix = A.trilinos_matrix();
    constexpr int           none   = -1;
    std::vector<int>        position(matrix.NumMyCols(), none);
    for (unsigned int k = 0; k < n; ++k)
      position[matrix.LCID(matrix.GRID(rows[k]))] = k;
    const auto for_each_entry = [&](const auto &visit) {
      for (unsigned int k = 0; k < n; ++k)
        {
          int     n_entries, *columns;
          double *values;
          matrix.ExtractMyRowView(rows[k], n_entries, values, columns);
          for (int j = 0; j < n_entries; ++j)
            if (position[columns[j]] != none)
              visit(k, position[columns[j]], values[j]);
        }
    };

    DynamicSparsityPattern pattern(n, n);
    for_each_entry([&](const unsigned int k, const int l, const double) {
      pattern.add(k, l);
    });
    const IndexSet   all = complete_index_set(n);
    LA::SparseMatrix square;
    square.reinit(all, pattern, MPI_COMM_SELF);
    for_each_entry([&](const unsigned int k, const int l, const double value) {
      square.set(k, l, value);
    });
    square.compress(VectorOperation::insert);
    src.reinit(all, MPI_COMM_SELF);
    dst.reinit(src);

    if (n > largest_for_klu && MumpsFactorization::is_available())
      factorization = std::make_unique<MumpsFactorization>();
    else
      factorization = std::make_unique<KluFactorization>();
    try
      {
        factorization->initialize(square);
      }
    catch (const ExcSolverFailure &)
      {
        factorization.reset();
      }
  }



  void
  LocalFactorization::solve(double *values) const
  {
    if (!factorization)
      {
        std::fill_n(values, n, 0.);
        return;
      }
    std::copy_n(values, n, src.begin());
    factorization->vmult(dst, src);
    std::copy_n(dst.begin(), n, values);
  }
} // namespace EBSMPM
