// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_types_h
#define ebsmpm_lac_types_h

#include <ebsmpm/base/config.h>

#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

namespace EBSMPM
{
  /**
   * The linear algebra classes of the library. Everything else uses these names
   * only, so that another package, such as Trilinos' Tpetra, is a change of
   * this file and of LinearSolver.
   */
  namespace LA
  {
    /**
     * A vector distributed by rows, with or without ghost entries.
     */
    using Vector = TrilinosWrappers::MPI::Vector;

    /**
     * The coefficients of a field, with ghost entries that can be read and
     * written: what the assembly works on. Entry by entry the same as Vector.
     */
    using FieldVector = LinearAlgebra::distributed::Vector<double>;

    /**
     * A matrix distributed by rows.
     */
    using SparseMatrix = TrilinosWrappers::SparseMatrix;

    /**
     * The places of the entries of a SparseMatrix.
     */
    using SparsityPattern = TrilinosWrappers::SparsityPattern;
  } // namespace LA
} // namespace EBSMPM

#endif
