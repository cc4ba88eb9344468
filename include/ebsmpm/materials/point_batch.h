// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_point_batch_h
#define ebsmpm_materials_point_batch_h

#include <ebsmpm/base/lanes.h>

#include <ebsmpm/materials/energy_split.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace EBSMPM
{
  /**
   * What a material is told about several points at once: one array over the
   * points for each component, so that several points can be computed side by
   * side. The classes derived from it add what the material is to answer, see
   * MaterialBatch and TractionBatch.
   *
   * Memory is allocated by initialize() only. The arrays are padded with points
   * without a weight, so that their length is a multiple of #max_n_short_lanes.
   */
  template <int dim>
  class PointBatch
  {
  public:
    /** Number of pairs $i\le k$ of components. */
    static constexpr unsigned int n_pairs = dim * (dim + 1) / 2;

    /** Allocate memory for at most @p max_n_points points. */
    void
    initialize(const unsigned int max_n_points)
    {
      stride = padded(max_n_points);
      data.assign(n_rows * stride, 0.);
      n = 0;
    }

    /** Begin with @p n_points points, and fill the padding. */
    void
    reinit(const unsigned int n_points)
    {
      n = n_points;
      for (unsigned int p = n; p < n_padded_points(); ++p)
        set(p,
            unit_symmetric_tensor<dim>(),
            unit_symmetric_tensor<dim>(),
            0.,
            1.,
            EnergyBranch::by_state);
    }

    /**
     * Give a point its data.
     *
     * @param p number of the point
     * @param F, @p F_n deformation gradient now and at the start of the step
     * @param weight the factor of all answers: a reference volume $V_0$, or an
     *   area $A_0$
     * @param g the value of the degradation function
     * @param branch where the point is held, if anywhere
     */
    void
    set(const unsigned int    p,
        const Tensor<2, dim> &F,
        const Tensor<2, dim> &F_n,
        const double          weight,
        const double          g,
        const EnergyBranch    branch)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            row(i * dim + j)[p]             = F[i][j];
            row(dim * dim + i * dim + j)[p] = F_n[i][j];
          }
      row(2 * dim * dim)[p]     = weight;
      row(2 * dim * dim + 1)[p] = g;
      row(2 * dim * dim + 2)[p] = branch == EnergyBranch::expanded   ? 1. :
                                  branch == EnergyBranch::compressed ? -1. :
                                                                       0.;
    }

    /** Number of points, without or with the padding. */
    unsigned int
    n_points() const
    {
      return n;
    }
    unsigned int
    n_padded_points() const
    {
      return padded(n);
    }

    /** The arrays of what is given. */
    const double *
    F(const unsigned int i, const unsigned int j) const
    {
      return row(i * dim + j);
    }
    const double *
    F_n(const unsigned int i, const unsigned int j) const
    {
      return row(dim * dim + i * dim + j);
    }
    const double *
    weight() const
    {
      return row(2 * dim * dim);
    }
    const double *
    degradation() const
    {
      return row(2 * dim * dim + 1);
    }

    /**
     * The branch that points are held on: positive for EnergyBranch::expanded,
     * negative for EnergyBranch::compressed, zero for the state's own.
     */
    const double *
    branch() const
    {
      return row(2 * dim * dim + 2);
    }

    /** Distance between an array and the next. */
    unsigned int
    row_length() const
    {
      return stride;
    }

  protected:
    /** Number of arrays of what is given; those of derived classes follow. */
    static constexpr unsigned int n_given_rows = 2 * dim * dim + 3;

    /** Constructor, with the number of all arrays. */
    explicit PointBatch(const unsigned int n_rows)
      : n_rows(n_rows)
    {}

    /** An array. */
    double *
    row(const unsigned int r)
    {
      return data.data() + r * stride;
    }
    const double *
    row(const unsigned int r) const
    {
      return data.data() + r * stride;
    }

  private:
    /** The length of an array for so many points. */
    static constexpr unsigned int
    padded(const unsigned int n_points)
    {
      return (n_points + max_n_short_lanes - 1) / max_n_short_lanes *
             max_n_short_lanes;
    }

    unsigned int        n_rows;
    unsigned int        stride = 0;
    unsigned int        n      = 0;
    std::vector<double> data;
  };
} // namespace EBSMPM

#endif
