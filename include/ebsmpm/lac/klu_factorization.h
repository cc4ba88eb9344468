// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_klu_factorization_h
#define ebsmpm_lac_klu_factorization_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/reusable_preconditioner.h>

#include <memory>

namespace EBSMPM
{
  /**
   * The factorisation $LU$ of a matrix by KLU, which every Trilinos brings
   * along, through Amesos. LinearSolver is its user.
   *
   * KLU works on the first process alone, without BLAS, and is several times
   * slower than MumpsFactorization already on one. It cannot tell whether the
   * matrix is indefinite, and notices a singular one only by a pivot that is
   * exactly zero.
   *
   * The symbolic factorisation is kept as long as the matrices share one
   * sparsity pattern. The object keeps a copy of the matrix.
   */
  class KluFactorization : public ReusablePreconditioner
  {
  public:
    KluFactorization();

    virtual ~KluFactorization() override;

    /**
     * Factorise. A vanishing pivot raises ExcSolverFailure.
     */
    virtual void
    initialize(const LA::SparseMatrix &A) override;

    virtual void
    vmult(LA::Vector &dst, const LA::Vector &src) const override;

    virtual std::string
    name() const override;

  private:
    /**
     * The classes of Amesos.
     */
    struct Data;

    std::unique_ptr<Data> data;
  };
} // namespace EBSMPM

#endif
