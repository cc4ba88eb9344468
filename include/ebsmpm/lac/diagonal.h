// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_diagonal_h
#define ebsmpm_lac_diagonal_h

#include <ebsmpm/lac/types.h>

namespace EBSMPM
{
  /**
   * Copy the diagonal of a matrix. Epetra_CrsMatrix has such a function, too,
   * but it looks up the global number of each entry of each row; this one looks
   * up one local number per row.
   *
   * @param A any square matrix
   * @param diagonal has the same distribution as the rows of @p A. Entries that
   *   are not in the sparsity pattern are zero.
   */
  void
  copy_diagonal(const LA::SparseMatrix &A, LA::Vector &diagonal);
} // namespace EBSMPM

#endif
