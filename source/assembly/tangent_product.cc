// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/dense_kernels.h>
#include <ebsmpm/assembly/tangent_product.h>

#include <algorithm>

namespace EBSMPM
{
  template <int dim, int n_rows>
  void
  TangentProduct<dim, n_rows>::initialize(const unsigned int n_functions,
                                          const unsigned int max_n_points)
  {
    const unsigned int n_points = std::max(max_n_points, 1U);
    const unsigned int c_stride = DenseKernels::padded(dim * dim * n_functions);
    n                           = n_functions;
    x_stride                    = DenseKernels::padded(n);
    X.resize_fast(n_rows * n_points * x_stride);
    X.fill(0.);
    cX.resize_fast(n_rows * n_points * c_stride + DenseKernels::padding);
    cX.fill(0.);
  }



  template <int dim, int n_rows>
  void
  TangentProduct<dim, n_rows>::compute(const unsigned int n_points,
                                       const double      *c,
                                       const unsigned int ldc,
                                       LocalSystem<dim>  &local)
  {
    DenseKernels::combine_rows<dim, n_rows>(n_points,
                                            n,
                                            c,
                                            ldc,
                                            X.data(),
                                            x_stride,
                                            cX.data(),
                                            local.tangent_stride());
    DenseKernels::transposed_product(n_rows * n_points,
                                     n,
                                     local.tangent_stride(),
                                     X.data(),
                                     x_stride,
                                     cX.data(),
                                     local.tangent(),
                                     local.begin_tangent(),
                                     dim * dim);
  }



  template class TangentProduct<2, 2>;
  template class TangentProduct<2, 3>;
  template class TangentProduct<3, 3>;
  template class TangentProduct<3, 4>;
} // namespace EBSMPM
