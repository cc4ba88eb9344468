// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_mumps_factorization_h
#define ebsmpm_lac_mumps_factorization_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/reusable_preconditioner.h>

#include <memory>

namespace EBSMPM
{
  /**
   * The factorisation $LDL^T$ of a symmetric matrix by MUMPS, distributed over
   * all processes. LinearSolver is its user.
   *
   * MUMPS is called directly, because Amesos treats every matrix as
   * unsymmetric. The symmetric factorisation needs half of the time and memory,
   * and by Sylvester's law of inertia the signs of its pivots tell whether the
   * matrix is indefinite.
   *
   * If the library of MUMPS for single precision is there, the factors are in
   * single precision, which halves time and memory: LinearSolver iterates with
   * them, and reaches the same accuracy with the same number of iterations as
   * long as the condition number is below some 1e6. Where a pivot is small or
   * negative, the factorisation is done again in double precision, so that
   * is_indefinite() and the refusal of singular matrices can be relied on.
   *
   * The ordering and the symbolic factorisation are kept as long as the places
   * of the entries stay the same. Only the upper triangle of the matrix is
   * read. Matrix, right hand side and solution stay distributed; processes
   * without rows are fine. The object must be destroyed before MPI is
   * finalized.
   */
  class MumpsFactorization : public ReusablePreconditioner
  {
  public:
    MumpsFactorization();

    virtual ~MumpsFactorization() override;

    /**
     * Return whether the library was compiled with MUMPS. If not, initialize()
     * raises an exception.
     */
    static bool
    is_available();

    /**
     * The symbolic factorisation works with blocks instead of unknowns then.
     */
    virtual void
    set_block_size(const unsigned int size) override;

    /**
     * Factorise. A pivot that vanishes up to round-off raises ExcSolverFailure.
     */
    virtual void
    initialize(const LA::SparseMatrix &A) override;

    virtual void
    vmult(LA::Vector &dst, const LA::Vector &src) const override;

    virtual bool
    is_indefinite() const override;

    /**
     * From the number of operations and that of the entries of the factors.
     */
    virtual unsigned int
    cost() const override;

    virtual std::string
    name() const override;

  private:
    /**
     * MUMPS' own structure and the arrays it points to.
     */
    struct Data;

    std::unique_ptr<Data> data;
    unsigned int          block_size = 1;
  };
} // namespace EBSMPM

#endif
