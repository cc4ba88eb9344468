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

#include <Amesos_Klu.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>

#include <algorithm>

namespace EBSMPM
{
  namespace
  {
    void
    check(const int error)
    {
      AssertThrow(error == 0,
                  ExcSolverFailure(
                    "The matrix is singular: KLU found a vanishing pivot."));
    }
  } // namespace



  struct KluFactorization::Data
  {
    explicit Data(const Epetra_CrsMatrix &A)
      : matrix(A)
      , problem(&matrix, nullptr, nullptr)
      , klu(problem)
    {
      check(klu.SymbolicFactorization());
    }

    /**
     * Copy the values of a matrix. Return false if its entries are, or may be,
     * in other places.
     */
    bool
    read(const Epetra_CrsMatrix &A)
    {
      // All processes agree, because a matrix has one pattern on all of them.
      if (A.Graph().DataPtr() != matrix.Graph().DataPtr())
        return false;
      for (int i = 0; i < A.NumMyRows(); ++i)
        {
          int     n_entries;
          double *from, *to;
          A.ExtractMyRowView(i, n_entries, from);
          matrix.ExtractMyRowView(i, n_entries, to);
          std::copy(from, from + n_entries, to);
        }
      return true;
    }

    Epetra_CrsMatrix     matrix;
    Epetra_LinearProblem problem;
    Amesos_Klu           klu;
  };



  KluFactorization::KluFactorization() = default;



  KluFactorization::~KluFactorization() = default;



  void
  KluFactorization::initialize(const LA::SparseMatrix &A)
  {
    const Epetra_CrsMatrix &matrix = A.trilinos_matrix();
    if (!data || !data->read(matrix))
      {
        data.reset(); // releases its memory first
        data = std::make_unique<Data>(matrix);
      }
    check(data->klu.NumericFactorization());
  }



  void
  KluFactorization::vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    // Amesos does not change the right hand side.
    data->problem.SetLHS(&dst.trilinos_vector());
    data->problem.SetRHS(
      const_cast<Epetra_MultiVector *>(&src.trilinos_vector()));
    check(data->klu.Solve());
  }



  std::string
  KluFactorization::name() const
  {
    return "KLU";
  }
} // namespace EBSMPM
