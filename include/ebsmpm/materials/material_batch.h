// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_material_batch_h
#define ebsmpm_materials_material_batch_h

#include <ebsmpm/base/lanes.h>

#include <ebsmpm/materials/energy_split.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <vector>

namespace EBSMPM
{
  /**
   * What a material is asked, and what it answers, about several points at
   * once: one array over the points for each component, so that several points
   * can be computed side by side.
   *
   * The answers are not stress and tangent themselves, but what they become in
   * the weak form on the configuration at the start of the step (method,
   * section 1),
   * @f[
   *   S_{ij} = V_0\,P_{iB} F^n_{jB}, \qquad
   *   c_{ijkl} = V_0\,F^n_{jB}\,A_{iBkD}\,F^n_{lD} ,
   * @f]
   * the latter for $i\le k$ only, since $c_{ijkl}=c_{klij}$.
   *
   * @code
   * MaterialBatch<dim> batch;
   * batch.initialize(max_n_points);
   * batch.reinit(n_points);
   * for (unsigned int p = 0; p < n_points; ++p)
   *   batch.set(p, F, F_n, volume, g, EnergyBranch::by_state);
   * material.respond(batch, true);
   * @endcode
   *
   * Memory is allocated by initialize() only. The arrays are padded with points
   * without volume, so that their length is a multiple of #max_n_short_lanes.
   */
  template <int dim>
  class MaterialBatch
  {
  public:
    /** Number of pairs $i\le k$. */
    static constexpr unsigned int n_pairs = dim * (dim + 1) / 2;

    /** Allocate memory for at most @p max_n_points points. */
    void
    initialize(const unsigned int max_n_points)
    {
      stride = (max_n_points + max_n_short_lanes - 1) / max_n_short_lanes *
               max_n_short_lanes;
      data.assign(n_rows * stride, 0.);
      n_filled = 0;
      n        = 0;
    }

    /** Begin with @p n_points points. */
    void
    reinit(const unsigned int n_points)
    {
      n = n_points;
      n_filled =
        (n + max_n_short_lanes - 1) / max_n_short_lanes * max_n_short_lanes;
      for (unsigned int p = n; p < n_filled; ++p)
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
     * @param volume reference volume $V_0$
     * @param g the value of the degradation function
     * @param branch where the point is held, if anywhere
     */
    void
    set(const unsigned int    p,
        const Tensor<2, dim> &F,
        const Tensor<2, dim> &F_n,
        const double          volume,
        const double          g,
        const EnergyBranch    branch)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            row(i * dim + j)[p]             = F[i][j];
            row(dim * dim + i * dim + j)[p] = F_n[i][j];
          }
      row(2 * dim * dim)[p]     = volume;
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
      return n_filled;
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
    volume() const
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

    /** The array of $S_{ij}$. */
    double *
    stress(const unsigned int i, const unsigned int j)
    {
      return row(2 * dim * dim + 3 + i * dim + j);
    }

    /** The array of $c_{ijkl}$ for pair number @p pair of $i\le k$. */
    double *
    tangent(const unsigned int pair, const unsigned int j, const unsigned int l)
    {
      return row(3 * dim * dim + 3 + (pair * dim + j) * dim + l);
    }

    /** Distance between the arrays tangent(pair,j,l) and the next. */
    unsigned int
    row_length() const
    {
      return stride;
    }

  private:
    static constexpr unsigned int n_rows =
      3 * dim * dim + 3 + n_pairs * dim * dim;

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

    unsigned int        stride   = 0;
    unsigned int        n        = 0;
    unsigned int        n_filled = 0;
    std::vector<double> data;
  };
} // namespace EBSMPM

#endif
