// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef tests_lac_spline_matrix_h
#define tests_lac_spline_matrix_h

// A matrix like those the library solves with, but made without the library:
// plane elasticity of a unit square with quadratic B-splines on n x n cells.
// Each row has 5 x 5 neighbours with two components.

#include <ebsmpm/lac/types.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace dealii;

class SplineMatrix
{
public:
  /**
   * Distribute the rows over the processes, of which the one of rank @p empty
   * gets none. If @p fixed, the left and the right edge do not move, otherwise
   * the matrix is singular.
   */
  SplineMatrix(const unsigned int n_cells,
               const bool         fixed = true,
               const unsigned int empty = numbers::invalid_unsigned_int)
    : n(n_cells)
    , h(1. / n_cells)
    , first(fixed ? 2 : 0)
    , n_x(n + 2 - 2 * first)
    , n_y(n + 2)
    , owned(2 * n_x * n_y)
    , cell_matrix(compute_cell_matrix())
  {
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n_parts = n_ranks - (empty < n_ranks ? 1 : 0);
    const unsigned int part    = rank - (empty < rank ? 1 : 0);
    if (rank != empty)
      owned.add_range(2 * (part * n_x / n_parts) * n_y,
                      2 * ((part + 1) * n_x / n_parts) * n_y);

    // Trilinos' own sparsity pattern does not like processes without rows.
    DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
    loop([&](const auto row, const auto &columns, const auto &, int, int) {
      pattern.add_entries(row, columns.begin(), columns.end());
    });
    matrix.reinit(owned, pattern, MPI_COMM_WORLD);
  }

  /**
   * Compute the matrix, with a stiffness that depends on the position.
   */
  void
  assemble(const std::function<double(double, double)> &stiffness)
  {
    matrix = 0.;
    loop(
      [&](const auto row, const auto &columns, auto &values, int cx, int cy) {
        const double factor = stiffness(h * (cx + 0.5), h * (cy + 0.5));
        for (double &value : values)
          value *= factor;
        matrix.add(row, columns, values);
      });
    matrix.compress(VectorOperation::add);
  }

  /**
   * Return a vector that is distributed like the rows.
   */
  EBSMPM::LA::Vector
  vector() const
  {
    return EBSMPM::LA::Vector(owned, MPI_COMM_WORLD);
  }

  /**
   * Return a vector, the same for all distributions, to be used as solution.
   */
  EBSMPM::LA::Vector
  solution() const
  {
    EBSMPM::LA::Vector v = vector();
    for (const int i : owned)
      v(i) = std::sin(1. + 0.37 * (i % 2) + 3. * i / owned.size()) +
             (i % 7 == 0 ? 0.1 : 0.);
    v.compress(VectorOperation::insert);
    return v;
  }

  /**
   * Return the displacements and the rotation of a rigid body.
   */
  std::vector<EBSMPM::LA::Vector>
  near_null_space() const
  {
    std::vector<EBSMPM::LA::Vector> modes(3, vector());
    for (const int i : owned)
      {
        const double x = h * (i / 2 / n_y), y = h * (i / 2 % n_y);
        modes[i % 2](i) = 1.;
        modes[2](i)     = (i % 2 == 0 ? -y : x);
      }
    for (auto &mode : modes)
      mode.compress(VectorOperation::insert);
    return modes;
  }

  EBSMPM::LA::SparseMatrix matrix;

private:
  /**
   * Compute the matrix of one cell, with unit stiffness.
   */
  static FullMatrix<double>
  compute_cell_matrix()
  {
    const double mu = 1., lambda = 1.5;

    FullMatrix<double> K(18, 18);
    const QGauss<2>    quadrature(3);
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        double value[2][3], derivative[2][3];
        for (unsigned int d = 0; d < 2; ++d)
          {
            const double t   = quadrature.point(q)[d];
            value[d][0]      = 0.5 * (1. - t) * (1. - t);
            value[d][1]      = 0.5 + t - t * t;
            value[d][2]      = 0.5 * t * t;
            derivative[d][0] = t - 1.;
            derivative[d][1] = 1. - 2. * t;
            derivative[d][2] = t;
          }
        // The size of the cell cancels in two dimensions.
        double gradient[9][2];
        for (unsigned int i = 0; i < 9; ++i)
          {
            gradient[i][0] = derivative[0][i % 3] * value[1][i / 3];
            gradient[i][1] = value[0][i % 3] * derivative[1][i / 3];
          }
        for (unsigned int i = 0; i < 9; ++i)
          for (unsigned int j = 0; j < 9; ++j)
            for (unsigned int a = 0; a < 2; ++a)
              for (unsigned int b = 0; b < 2; ++b)
                {
                  const double *gi = gradient[i], *gj = gradient[j];
                  K(2 * i + a, 2 * j + b) +=
                    (lambda * gi[a] * gj[b] + mu * gi[b] * gj[a] +
                     (a == b ? mu * (gi[0] * gj[0] + gi[1] * gj[1]) : 0.)) *
                    quadrature.weight(q);
                }
      }
    return K;
  }

  /**
   * Call a function with row, columns, values and cell of all contributions to
   * own rows.
   */
  template <typename Function>
  void
  loop(const Function &function) const
  {
    std::vector<types::global_dof_index> columns;
    std::vector<double>                  values;
    for (int cx = 0; cx < n; ++cx)
      for (int cy = 0; cy < n; ++cy)
        for (unsigned int i = 0; i < 18; ++i)
          if (is_free(cx, i) && owned.is_element(index(cx, cy, i)))
            {
              columns.clear();
              values.clear();
              for (unsigned int j = 0; j < 18; ++j)
                if (is_free(cx, j))
                  {
                    columns.push_back(index(cx, cy, j));
                    values.push_back(cell_matrix(i, j));
                  }
              function(index(cx, cy, i), columns, values, cx, cy);
            }
  }

  bool
  is_free(const int cx, const unsigned int i) const
  {
    const int x = cx + i / 2 % 3 - first;
    return 0 <= x && x < n_x;
  }

  types::global_dof_index
  index(const int cx, const int cy, const unsigned int i) const
  {
    return 2 * ((cx + i / 2 % 3 - first) * n_y + cy + i / 6) + i % 2;
  }

  const int                n;
  const double             h;
  const int                first, n_x, n_y;
  IndexSet                 owned;
  const FullMatrix<double> cell_matrix;
};

#endif
