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

#include <ebsmpm/materials/point_batch.h>

namespace EBSMPM
{
  /**
   * What a material is asked, and what it answers, about several points of a
   * body at once.
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
   */
  template <int dim>
  class MaterialBatch : public PointBatch<dim>
  {
  public:
    using PointBatch<dim>::n_pairs;

    /** Constructor. */
    MaterialBatch()
      : PointBatch<dim>(n_rows)
    {}

    /** The array of $S_{ij}$. */
    double *
    stress(const unsigned int i, const unsigned int j)
    {
      return this->row(first_stress + i * dim + j);
    }

    /** The array of $c_{ijkl}$ for pair number @p pair of $i\le k$. */
    double *
    tangent(const unsigned int pair, const unsigned int j, const unsigned int l)
    {
      return this->row(first_tangent + (pair * dim + j) * dim + l);
    }

  private:
    static constexpr unsigned int first_stress  = PointBatch<dim>::n_given_rows;
    static constexpr unsigned int first_tangent = first_stress + dim * dim;
    static constexpr unsigned int n_rows = first_tangent + n_pairs * dim * dim;
  };
} // namespace EBSMPM

#endif
