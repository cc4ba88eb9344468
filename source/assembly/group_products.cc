// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/dense_kernels.h>
#include <ebsmpm/assembly/group_products.h>

#include <algorithm>

namespace EBSMPM
{
  template <int dim, int n_rows>
  void
  GroupProducts<dim, n_rows>::initialize(const unsigned int n_functions,
                                         const unsigned int max_n_points)
  {
    const unsigned int n_points = std::max(max_n_points, 1U);
    const unsigned int c_stride = BlockRow<dim>::length(n_functions);
    n                           = n_functions;
    x_stride                    = padded(n);
    X.resize_fast(n_rows * n_points * x_stride);
    X.fill(0.);
    cX.resize_fast(n_rows * n_points * c_stride);
    cX.fill(0.);

    increments_stride = n_rows * n_points;
    increments.resize(dim * increments_stride);
    duals.resize(n_rows * n_points * dim);
  }



  template <int dim, int n_rows>
  void
  GroupProducts<dim, n_rows>::evaluate(const unsigned int      n_points,
                                       const LocalSystem<dim> &local)
  {
    AssertDimension(local.row_stride(), x_stride);
    local.template functionals<n_rows>(X.data(), x_stride);
    DenseKernels::row_products(n,
                               dim,
                               local.coefficients(),
                               n_rows * n_points,
                               X.data(),
                               x_stride,
                               increments.data(),
                               increments_stride);
  }



  template <int dim, int n_rows>
  void
  GroupProducts<dim, n_rows>::add_residual(const unsigned int n_points,
                                           LocalSystem<dim>  &local)
  {
    DenseKernels::transposed_product(n_rows * n_points,
                                     dim,
                                     x_stride,
                                     duals.data(),
                                     dim,
                                     X.data(),
                                     local.residual(),
                                     /*add=*/true);
  }



  template <int dim, int n_rows>
  void
  GroupProducts<dim, n_rows>::add_tangent(const unsigned int n_points,
                                          const double      *c,
                                          const unsigned int ldc,
                                          LocalSystem<dim>  &local)
  {
    DenseKernels::combine_rows<dim, n_rows>(
      n_points, n, c, ldc, X.data(), x_stride, cX.data());
    DenseKernels::symmetric_product<dim>(n_rows * n_points,
                                         n,
                                         X.data(),
                                         x_stride,
                                         cX.data(),
                                         local.tangent(),
                                         local.begin_tangent());
  }



  template class GroupProducts<2, 2>;
  template class GroupProducts<2, 3>;
  template class GroupProducts<3, 3>;
  template class GroupProducts<3, 4>;
} // namespace EBSMPM
