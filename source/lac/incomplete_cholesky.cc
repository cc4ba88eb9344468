// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/lac/incomplete_cholesky.h>

#include <deal.II/lac/trilinos_precondition.h>

namespace EBSMPM
{
  struct IncompleteCholesky::Data
  {
    LA::SparseMatrix                 matrix;
    TrilinosWrappers::PreconditionIC factorization;
  };



  IncompleteCholesky::IncompleteCholesky() = default;



  IncompleteCholesky::~IncompleteCholesky() = default;



  void
  IncompleteCholesky::initialize(const LA::SparseMatrix &A)
  {
    data = std::make_unique<Data>();
    data->matrix.reinit(A);
    data->matrix.copy_from(A);
    data->factorization.initialize(data->matrix);
  }



  void
  IncompleteCholesky::vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    data->factorization.vmult(dst, src);
  }



  std::string
  IncompleteCholesky::name() const
  {
    return "incomplete Cholesky";
  }
} // namespace EBSMPM
