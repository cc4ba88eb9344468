// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_group_products_h
#define ebsmpm_assembly_group_products_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/assembly/local_system.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace EBSMPM
{
  /**
   * What a group of points contributes, as products of matrices.
   *
   * Let $\mathbf X$ have a row per point and functional $X_{pj}$ of the
   * functions: the gradient in direction $j$, or also the value; and a column
   * per function. Of the increment with the coefficients $\mathbf c_I$, the
   * functionals are $\mathbf X\mathbf c$. With what the points make of them,
   * $\mathbf s$ and its derivative $\mathbf c$, residual and tangent are
   * @f[
   *   r_{Ii} = \sum_p\sum_j X_{pj}(B_I)\; s_{ij}(p)
   *          = \bigl[\mathbf X^T\mathbf s\bigr]_{Ii}, \qquad
   *   K_{Ii,Jk} = \sum_p\sum_{jl} X_{pj}(B_I)\; c_{ijkl}(p)\; X_{pl}(B_J)
   *            = \bigl[\mathbf X^T (\mathbf c\,\mathbf X)\bigr]_{Ii,Jk}.
   * @f]
   * As $\mathbf K$ is symmetric, only blocks $I\le J$ are computed.
   *
   * @code
   * GroupProducts<dim, dim> products;        // gradients only
   * products.initialize(n_functions, max_n_points);
   * products.evaluate(n_points, local);
   * for (unsigned int p = 0; p < n_points; ++p)
   *   products.dual(p, j, i) = ...;            // from products.increment()
   * products.add_residual(n_points, local);
   * products.add_tangent(n_points, c, ldc, local);
   * @endcode
   *
   * Memory is allocated by initialize() only.
   *
   * @tparam n_rows number of functionals
   */
  template <int dim, int n_rows>
  class GroupProducts
  {
  public:
    /**
     * Allocate memory for groups of at most @p max_n_points points that see
     * @p n_functions functions.
     */
    void
    initialize(const unsigned int n_functions, const unsigned int max_n_points);

    /** Evaluate the functionals, and those of the increment of @p local. */
    void
    evaluate(const unsigned int n_points, const LocalSystem<dim> &local);

    /** Functional $(p,j)$ of component @p a, after evaluate(). */
    double
    increment(const unsigned int p,
              const unsigned int j,
              const unsigned int a) const
    {
      return increments[a * increments_stride + p * n_rows + j];
    }

    /**
     * The gradients of all components, the last functionals of point @p p,
     * after evaluate().
     */
    std::array<Tensor<1, dim>, dim>
    gradient(const unsigned int p) const
    {
      std::array<Tensor<1, dim>, dim> result;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          result[a][d] = increment(p, n_rows - dim + d, a);
      return result;
    }

    /** The number $s_{ij}(p)$, to be filled. */
    double &
    dual(const unsigned int p, const unsigned int j, const unsigned int i)
    {
      return duals[(p * n_rows + j) * dim + i];
    }

    /** Add to the residual of @p local. */
    void
    add_residual(const unsigned int n_points, LocalSystem<dim> &local);

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
    add_tangent(const unsigned int n_points,
                const double      *c,
                const unsigned int ldc,
                LocalSystem<dim>  &local);

  private:
    unsigned int n        = 0;
    unsigned int x_stride = 0;

    AlignedVector<double> X;
    AlignedVector<double> cX;

    /** The functionals of the increment, a row per component. */
    std::vector<double> increments;
    unsigned int        increments_stride = 0;

    /** The numbers $s_{ij}(p)$. */
    std::vector<double> duals;
  };
} // namespace EBSMPM

#endif
