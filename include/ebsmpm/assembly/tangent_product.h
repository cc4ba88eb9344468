// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_tangent_product_h
#define ebsmpm_assembly_tangent_product_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/assembly/local_system.h>

#include <deal.II/base/aligned_vector.h>

namespace EBSMPM
{
  /**
   * The tangent of a group of points as a single product of matrices.
   *
   * What the points contribute is a sum over them and over some functionals
   * $X_{pj}$ of the functions: the gradient in direction $j$, or also the
   * value,
   * @f[
   *   K_{Ii,Jk} = \sum_p\sum_{jl} X_{pj}(B_I)\; c_{ijkl}(p)\; X_{pl}(B_J)
   *            = \bigl[\mathbf X^T (\mathbf c\,\mathbf X)\bigr]_{Ii,Jk},
   * @f]
   * where $\mathbf X$ has a row per point and functional and a column per
   * function. As $\mathbf K$ is symmetric, only blocks $I\le J$ are computed.
   *
   * @code
   * TangentProduct<dim, dim> product;        // gradients only
   * product.initialize(n_functions, max_n_points);
   * for (unsigned int p = 0; p < n_points; ++p)
   *   local.values_and_gradients(p, B, product.row(p, 0), product.stride());
   * product.compute(n_points, c, ldc, local);
   * @endcode
   *
   * Memory is allocated by initialize() only.
   *
   * @tparam n_rows number of functionals
   */
  template <int dim, int n_rows>
  class TangentProduct
  {
  public:
    /**
     * Allocate memory for groups of at most @p max_n_points points that see
     * @p n_functions functions.
     */
    void
    initialize(const unsigned int n_functions, const unsigned int max_n_points);

    /** Row $(p,j)$ of $\mathbf X$, to be filled; its padding must stay zero. */
    double *
    row(const unsigned int p, const unsigned int j)
    {
      return X.data() + (p * n_rows + j) * x_stride;
    }

    /** Distance between two rows of $\mathbf X$. */
    unsigned int
    stride() const
    {
      return x_stride;
    }

    /**
     * Add to the tangent of @p local.
     *
     * @param n_points number of points
     * @param c <tt>c[((b*n_rows+j)*n_rows+l)*ldc+p]</tt> is $c_{ijkl}(p)$ for
     *   pair number @p b of $i\le k$
     * @param ldc distance of these arrays
     * @param local the group
     */
    void
    compute(const unsigned int n_points,
            const double      *c,
            const unsigned int ldc,
            LocalSystem<dim>  &local);

  private:
    unsigned int n        = 0;
    unsigned int x_stride = 0;

    AlignedVector<double> X;
    AlignedVector<double> cX;
  };
} // namespace EBSMPM

#endif
