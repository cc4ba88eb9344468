// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/lac/local_correction.h>

#include <deal.II/base/mpi.h>

#include <Epetra_Map.h>

namespace EBSMPM
{
  void
  LocalCorrection::clear()
  {
    rows.clear();
    rows_of_matrix.reset();
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

    const Epetra_CrsMatrix &matrix = A.trilinos_matrix();
    std::vector<int>        global_rows;
    for (const int row : rows)
      global_rows.push_back(matrix.GRID(row));
    const Epetra_Map map(-1, n, global_rows.data(), 0, matrix.RowMap().Comm());
    rows_of_matrix = std::make_unique<Epetra_CrsMatrix>(Copy,
                                                        map,
                                                        matrix.ColMap(),
                                                        matrix.MaxNumEntries());
    for (unsigned int k = 0; k < n; ++k)
      {
        int     n_entries, *columns;
        double *values;
        matrix.ExtractMyRowView(rows[k], n_entries, values, columns);
        rows_of_matrix->InsertMyValues(k, n_entries, values, columns);
      }
    rows_of_matrix->FillComplete(matrix.DomainMap(), map);
    part = std::make_unique<Epetra_Vector>(map);
    remainder.reinit(A.locally_owned_range_indices(), A.get_mpi_communicator());
    product.reinit(remainder);
    inverse.reinit(A, rows);
  }



  void
  LocalCorrection::begin(const LA::Vector &src) const
  {
    const double *const values = src.begin();
    for (unsigned int k = 0; k < rows.size(); ++k)
      (*part)[k] = values[rows[k]];
    inverse.solve(part->Values());

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
    inverse.solve(part->Values());
    add();
  }
} // namespace EBSMPM
