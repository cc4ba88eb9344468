// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_traction_batch_h
#define ebsmpm_materials_traction_batch_h

#include <ebsmpm/materials/point_batch.h>

namespace EBSMPM
{
  /**
   * What a material is asked, and what it answers, about the traction at
   * several points of a boundary at once.
   *
   * With the normal $\mathbf N$ and a vector $\mathbf w$, the answers are the
   * traction, its derivative with respect to the gradient of the increment, and
   * the second derivative of $\mathbf w\cdot\mathbf P\mathbf N$, as Nitsche's
   * method needs them on the configuration at the start of the step (method,
   * section 3; NitscheTerms),
   * @f[
   *   t_i = A_0\,P_{iB} N_B, \qquad
   *   T^i_{kl} = A_0\,N_B\,A_{iBkD}\,F^n_{lD}, \qquad
   *   c_{ijkl} = A_0\,F^n_{jB}\,\mathrm dA_{iBkD}\,F^n_{lD},
   * @f]
   * where $\mathrm d\mathbf A$ is the derivative of the tangent in the
   * direction
   * $\mathbf w\otimes\mathbf N$; the latter for $i\le k$ only, since
   * $c_{ijkl}=c_{klij}$.
   *
   * @code
   * TractionBatch<dim> batch;
   * batch.initialize(max_n_points);
   * batch.reinit(n_points);
   * for (unsigned int p = 0; p < n_points; ++p)
   *   {
   *     batch.set(p, F, F_n, area, g, EnergyBranch::by_state);
   *     batch.set_vectors(p, N, w);
   *   }
   * material.respond(batch, true);
   * @endcode
   */
  template <int dim>
  class TractionBatch : public PointBatch<dim>
  {
  public:
    using PointBatch<dim>::n_pairs;

    /** Constructor. */
    TractionBatch()
      : PointBatch<dim>(n_rows)
    {}

    /** Give a point its normal @p N and the vector @p w. */
    void
    set_vectors(const unsigned int    p,
                const Tensor<1, dim> &N,
                const Tensor<1, dim> &w)
    {
      for (unsigned int i = 0; i < dim; ++i)
        {
          this->row(first_normal + i)[p] = N[i];
          this->row(first_w + i)[p]      = w[i];
        }
    }

    /** The arrays of what set_vectors() has been given. */
    const double *
    normal(const unsigned int i) const
    {
      return this->row(first_normal + i);
    }
    const double *
    w(const unsigned int i) const
    {
      return this->row(first_w + i);
    }

    /** The array of $t_i$. */
    double *
    traction(const unsigned int i)
    {
      return this->row(first_traction + i);
    }

    /** The array of $T^i_{kl}$. */
    double *
    derivative(const unsigned int i, const unsigned int k, const unsigned int l)
    {
      return this->row(first_derivative + (i * dim + k) * dim + l);
    }

    /** The array of $c_{ijkl}$ for pair number @p pair of $i\le k$. */
    double *
    second_derivative(const unsigned int pair,
                      const unsigned int j,
                      const unsigned int l)
    {
      return this->row(first_second + (pair * dim + j) * dim + l);
    }

  private:
    static constexpr unsigned int first_normal = PointBatch<dim>::n_given_rows;
    static constexpr unsigned int first_w      = first_normal + dim;
    static constexpr unsigned int first_traction   = first_w + dim;
    static constexpr unsigned int first_derivative = first_traction + dim;
    static constexpr unsigned int first_second =
      first_derivative + dim * dim * dim;
    static constexpr unsigned int n_rows = first_second + n_pairs * dim * dim;
  };
} // namespace EBSMPM

#endif
