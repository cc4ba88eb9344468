// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_lac_amg_hierarchy_h
#define ebsmpm_lac_amg_hierarchy_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/reusable_preconditioner.h>

#include <memory>
#include <vector>

namespace EBSMPM
{
  /**
   * One V-cycle of Trilinos' smoothed aggregation multigrid ML. LinearSolver is
   * its user.
   *
   * The unknowns of a function must be numbered one after the other, see
   * set_block_size(); such a block is aggregated as a whole. The coarse spaces
   * are built to contain the near null space, the vectors that the matrix
   * without boundary conditions maps to zero: constants by default, and with
   * set_near_null_space() also rotations, which elasticity needs for a number
   * of iterations that does not grow with the number of unknowns.
   *
   * The smoother is symmetric, hence so is the cycle for a symmetric matrix,
   * and positive definite for a positive definite one. The object keeps a copy
   * of the matrix. Setup costs about as much as a dozen cycles. Processes
   * without rows are fine.
   */
  class AmgHierarchy : public ReusablePreconditioner
  {
  public:
    AmgHierarchy();

    virtual ~AmgHierarchy() override;

    /**
     * Set the number of unknowns per function. Takes effect at the next
     * initialize().
     */
    virtual void
    set_block_size(const unsigned int size) override;

    /**
     * Set the vectors of the near null space, which are copied. An empty list
     * stands for one constant per component. Takes effect at the next
     * initialize().
     */
    void
    set_near_null_space(const std::vector<LA::Vector> &vectors);

    virtual void
    initialize(const LA::SparseMatrix &A) override;

    virtual void
    vmult(LA::Vector &dst, const LA::Vector &src) const override;

    virtual std::string
    name() const override;

  private:
    /**
     * The classes of ML.
     */
    struct Data;

    std::unique_ptr<Data>   data;
    unsigned int            block_size = 1;
    std::vector<LA::Vector> near_null_space;
  };
} // namespace EBSMPM

#endif
