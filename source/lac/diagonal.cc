// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/lac/diagonal.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace EBSMPM
{
  void
  copy_diagonal(const LA::SparseMatrix &A, LA::Vector &diagonal)
  {
    const Epetra_CrsMatrix &matrix = A.trilinos_matrix();
    AssertDimension(diagonal.locally_owned_size(),
                    static_cast<unsigned int>(matrix.NumMyRows()));
    for (int row = 0; row < matrix.NumMyRows(); ++row)
      {
        int     n_entries, *columns;
        double *values;
        matrix.ExtractMyRowView(row, n_entries, values, columns);
        const int *const entry = std::find(columns,
                                           columns + n_entries,
                                           matrix.LCID(matrix.GRID(row)));
        diagonal.begin()[row] =
          entry != columns + n_entries ? values[entry - columns] : 0.;
      }
  }
} // namespace EBSMPM
