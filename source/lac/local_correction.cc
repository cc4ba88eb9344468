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
#include <ebsmpm/lac/local_correction.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_Map.h>

#include <algorithm>

namespace EBSMPM
{
  LocalCorrection::LocalCorrection() = default;



  LocalCorrection::~LocalCorrection() = default;



  void
  LocalCorrection::clear()
  {
    rows.clear();
    rows_of_matrix.reset();
    factorization.reset();
  }



  void
  LocalCorrection::reinit(const LA::SparseMatrix &A,
                          const std::vector<int> &new_rows)
  {
    clear();
    const unsigned int n = new_rows.size();
    if (dealii::Utilities::MPI::max(n, A.get_mpi_communicator()) == 0)
      return;
    rows = new_rows;

    // The rows, and where a column of the matrix is among them.
    const Epetra_CrsMatrix &matrix = A.trilinos_matrix();
    constexpr int           none   = -1;
    std::vector<int>        position(matrix.NumMyCols(), none);
    std::vector<int>        global_rows;
    for (unsigned int k = 0; k < n; ++k)
      {
        global_rows.push_back(matrix.GRID(rows[k]));
        position[matrix.LCID(global_rows.back())] = k;
      }
    const Epetra_Map map(-1, n, global_rows.data(), 0, matrix.RowMap().Comm());
    rows_of_matrix = std::make_unique<Epetra_CrsMatrix>(Copy,
                                                        map,
                                                        matrix.ColMap(),
                                                        matrix.MaxNumEntries());
    DynamicSparsityPattern pattern(n, n);
    const auto             for_each_row = [&](const auto &visit) {
      for (unsigned int k = 0; k < n; ++k)
        {
          int     n_entries, *columns;
          double *values;
          matrix.ExtractMyRowView(rows[k], n_entries, values, columns);
          visit(k, n_entries, columns, values);
        }
    };
    for_each_row([&](const unsigned int k,
                     const int          n_entries,
                     int               *columns,
                     double            *values) {
      rows_of_matrix->InsertMyValues(k, n_entries, values, columns);
      for (int j = 0; j < n_entries; ++j)
        if (position[columns[j]] != none)
          pattern.add(k, position[columns[j]]);
    });
    rows_of_matrix->FillComplete(matrix.DomainMap(), map);
    part = std::make_unique<Epetra_Vector>(map);
    remainder.reinit(A.locally_owned_range_indices(), A.get_mpi_communicator());
    product.reinit(remainder);
    if (n == 0)
      return;

    const IndexSet   all = complete_index_set(n);
    LA::SparseMatrix square;
    square.reinit(all, pattern, MPI_COMM_SELF);
    for_each_row([&](const unsigned int k,
                     const int          n_entries,
                     const int         *columns,
                     const double      *values) {
      for (int j = 0; j < n_entries; ++j)
        if (position[columns[j]] != none)
          square.set(k, position[columns[j]], values[j]);
    });
    square.compress(VectorOperation::insert);
    part_src.reinit(all, MPI_COMM_SELF);
    part_dst.reinit(part_src);

    // A failure here is nobody else's, and does no harm.
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
  LocalCorrection::solve() const
  {
    if (!factorization)
      {
        part->PutScalar(0.);
        return;
      }
    std::copy_n(part->Values(), rows.size(), part_src.begin());
    factorization->vmult(part_dst, part_src);
    std::copy_n(part_dst.begin(), rows.size(), part->Values());
  }



  void
  LocalCorrection::begin(const LA::Vector &src) const
  {
    const double *const values = src.begin();
    for (unsigned int k = 0; k < rows.size(); ++k)
      (*part)[k] = values[rows[k]];
    solve();

    // The rows are also the columns.
    rows_of_matrix->Multiply(true, *part, product.trilinos_vector());
    remainder = src;
    remainder -= product;
  }



  void
  LocalCorrection::finish(LA::Vector &dst, const LA::Vector &src) const
  {
    double *const to  = dst.begin();
    const auto    add = [&]() {
      for (unsigned int k = 0; k < rows.size(); ++k)
        to[rows[k]] += (*part)[k];
    };
    add();
    const double *const values = src.begin();
    rows_of_matrix->Multiply(false, dst.trilinos_vector(), *part);
    for (unsigned int k = 0; k < rows.size(); ++k)
      (*part)[k] = values[rows[k]] - (*part)[k];
    solve();
    add();
  }
} // namespace EBSMPM
