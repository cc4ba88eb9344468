// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_incomplete_cholesky_h
#define ebsmpm_lac_incomplete_cholesky_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/reusable_preconditioner.h>

#include <memory>

namespace EBSMPM
{
  /**
   * The incomplete Cholesky factorisation of a symmetric positive definite
   * matrix, without fill-in, of the part of the matrix that each process owns
   * (Ifpack's). LinearSolver is its user.
   *
   * It costs as much as a few products with the matrix, but does not see what
   * is far away: for matrices whose condition number is bounded, such as that
   * of the damage, which is about $(l/h)^2$ however many cells there are. The
   * object keeps a copy of the matrix.
   */
  class IncompleteCholesky : public ReusablePreconditioner
  {
  public:
    IncompleteCholesky();

    virtual ~IncompleteCholesky() override;

    /**
     * Factorise.
     */
    virtual void
    initialize(const LA::SparseMatrix &A) override;

    virtual void
    vmult(LA::Vector &dst, const LA::Vector &src) const override;

    virtual std::string
    name() const override;

  private:
    /**
     * The class of Trilinos, and the matrix it refers to.
     */
    struct Data;

    std::unique_ptr<Data> data;
  };
} // namespace EBSMPM

#endif
