// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// DenseKernels, for all instruction sets of the machine, against their formulas
// written as loops: for all numbers of functions that cells have, and for few
// and many points. Symmetric products are complete after the mirroring.

#include <ebsmpm/assembly/dense_kernels.h>

#include <cmath>
#include <vector>

#include "../tests.h"

#include "../instruction_sets.h"

/** Rows of numbers, behind which there is room for the padding. */
struct Rows
{
  Rows(const unsigned int n_rows,
       const unsigned int n_columns,
       const double       seed = 0.)
    : stride(padded(n_columns))
    , numbers(n_rows * stride, 0.)
  {
    if (seed != 0.)
      for (unsigned int i = 0; i < n_rows; ++i)
        for (unsigned int j = 0; j < n_columns; ++j)
          (*this)(i, j) = std::sin(seed + 1.3 * i + 0.7 * j);
  }

  double &
  operator()(const unsigned int i, const unsigned int j)
  {
    return numbers[i * stride + j];
  }

  double *
  data()
  {
    return numbers.data();
  }

  unsigned int        stride;
  std::vector<double> numbers;
};



/** The largest error so far; a NaN is one, and stays. */
class Error
{
public:
  void
  add(const double is, const double should_be)
  {
    const double difference = std::abs(is - should_be);
    if (!(difference <= error))
      error = difference;
  }

  const char *
  verdict() const
  {
    return error < 1e-12 ? "the same" : "FAILED";
  }

private:
  double error = 0.;
};



/** General products, written and added. */
void
test_products(const unsigned int n)
{
  Error product, rows;
  for (const unsigned int n_columns : {3U, 8U, 27U, 50U})
    for (const unsigned int n_inner : {1U, 6U, 21U})
      for_each_instruction_set([&]() {
        Rows A(n_inner, n, 1.), B(n_inner, n_columns, 2.), C(n, n_columns);
        for (const bool add : {false, true})
          {
            DenseKernels::transposed_product(n_inner,
                                             n,
                                             C.stride,
                                             A.data(),
                                             A.stride,
                                             B.data(),
                                             C.data(),
                                             add);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n_columns; ++j)
                {
                  double sum = 0.;
                  for (unsigned int k = 0; k < n_inner; ++k)
                    sum += A(k, i) * B(k, j);
                  product.add(C(i, j), (add ? 2. : 1.) * sum);
                }
          }

        Rows   few(3, n, 1.), many(n_columns, n, 2.);
        Rows   D(3, n_columns + 1);
        double outside = 0.;
        DenseKernels::row_products(n,
                                   3,
                                   few.data(),
                                   n_columns,
                                   many.data(),
                                   few.stride,
                                   D.data(),
                                   D.stride);
        for (unsigned int i = 0; i < 3; ++i)
          {
            for (unsigned int j = 0; j < n_columns; ++j)
              {
                double sum = 0.;
                for (unsigned int k = 0; k < n; ++k)
                  sum += few(i, k) * many(j, k);
                rows.add(D(i, j), sum);
              }
            outside += D(i, n_columns);
          }
        rows.add(outside, 0.);
      });
  deallog << n << " functions: products " << product.verdict() << ", of rows "
          << rows.verdict() << std::endl;
}



/** What the tangent of a cell is made of. */
template <int dim, int n_rows>
void
test_tangent(const unsigned int n)
{
  using Row = BlockRow<dim>;
  Error combination, tangent;
  for (const unsigned int n_points : {1U, 4U, 9U})
    for_each_instruction_set([&]() {
      const unsigned int ldc =
        (n_points / max_n_short_lanes + 1) * max_n_short_lanes;
      Rows X(n_rows * n_points, n, 3.);
      Rows cX(n_rows * n_points, Row::length(n));
      Rows K(n, Row::length(n));

      // c_{ijkl} = c_{klij}.
      const auto c = [](const unsigned int p,
                        const unsigned int i,
                        const unsigned int j,
                        const unsigned int k,
                        const unsigned int l) {
        return std::cos(p + 2. * (i * n_rows + j) + 0.3 * (k * n_rows + l)) +
               std::cos(p + 2. * (k * n_rows + l) + 0.3 * (i * n_rows + j));
      };
      std::vector<double> coefficients;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int k = i; k < dim; ++k)
          for (unsigned int j = 0; j < n_rows; ++j)
            for (unsigned int l = 0; l < n_rows; ++l)
              for (unsigned int p = 0; p < ldc; ++p)
                coefficients.push_back(c(p, i, j, k, l));

      DenseKernels::combine_rows<dim, n_rows>(
        n_points, n, coefficients.data(), ldc, X.data(), X.stride, cX.data());
      for (const bool add : {false, true})
        DenseKernels::symmetric_product<dim>(
          n_rows * n_points, n, X.data(), X.stride, cX.data(), K.data(), add);
      DenseKernels::complete_symmetric<dim>(n, K.data());

      for (unsigned int J = 0; J < n; ++J)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < dim; ++k)
            {
              const unsigned int  column = Row::place(n, J, i, k);
              std::vector<double> sums(n, 0.);
              for (unsigned int p = 0; p < n_points; ++p)
                for (unsigned int j = 0; j < n_rows; ++j)
                  {
                    double sum = 0.;
                    for (unsigned int l = 0; l < n_rows; ++l)
                      sum += c(p, i, j, k, l) * X(p * n_rows + l, J);
                    combination.add(cX(p * n_rows + j, column), sum);
                    for (unsigned int I = 0; I < n; ++I)
                      sums[I] += X(p * n_rows + j, I) * sum;
                  }
              for (unsigned int I = 0; I < n; ++I)
                tangent.add(K(I, column), 2. * sums[I]);
            }
    });
  deallog << dim << "d, " << n_rows << " rows, " << n
          << " functions: combination " << combination.verdict() << ", tangent "
          << tangent.verdict() << std::endl;
}



int
main()
{
  initlog();
  for (const unsigned int n : {2U, 4U, 8U, 9U, 16U, 27U, 64U})
    test_products(n);
  for (const unsigned int n : {4U, 9U, 16U})
    {
      test_tangent<2, 2>(n);
      test_tangent<2, 3>(n);
    }
  for (const unsigned int n : {8U, 27U, 64U})
    {
      test_tangent<3, 3>(n);
      test_tangent<3, 4>(n);
    }
}
