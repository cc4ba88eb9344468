// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_reusable_preconditioner_h
#define ebsmpm_lac_reusable_preconditioner_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/types.h>

#include <string>

namespace EBSMPM
{
  /**
   * A factorisation of a matrix, or an approximation of its inverse, that
   * outlives the matrix it was computed from: the part of LinearSolver that
   * differs from method to method. MumpsFactorization, KluFactorization and
   * AmgHierarchy implement it.
   *
   * An object takes from the matrix what it needs; none keeps a reference to
   * it. Each is free to remember what depends on the sparsity pattern only, and
   * must notice by itself when that has changed.
   *
   * A failure raises ExcSolverFailure on all processes.
   */
  class ReusablePreconditioner
  {
  public:
    virtual ~ReusablePreconditioner() = default;

    /**
     * Say that so many unknowns that follow each other belong together, such as
     * the components of a vector. A method that has no use for that does not
     * listen.
     */
    virtual void
    set_block_size(const unsigned int size);

    /**
     * Compute from the matrix @p A. Collective.
     */
    virtual void
    initialize(const LA::SparseMatrix &A) = 0;

    /**
     * Apply to a vector, both of which are distributed like the rows of the
     * matrix. Collective.
     */
    virtual void
    vmult(LA::Vector &dst, const LA::Vector &src) const = 0;

    /**
     * Return whether initialize() has found negative eigenvalues. A method that
     * cannot tell says no.
     */
    virtual bool
    is_indefinite() const;

    /**
     * Return how many iterations take as long as initialize(), about; zero if
     * the method cannot tell. It depends on the matrix, not on measured times.
     */
    virtual unsigned int
    cost() const;

    /**
     * Return the name of the method, for messages.
     */
    virtual std::string
    name() const = 0;
  };



  // ------------------------- inline functions -------------------------

  inline void
  ReusablePreconditioner::set_block_size(const unsigned int)
  {}



  inline bool
  ReusablePreconditioner::is_indefinite() const
  {
    return false;
  }



  inline unsigned int
  ReusablePreconditioner::cost() const
  {
    return 0;
  }
} // namespace EBSMPM

#endif
