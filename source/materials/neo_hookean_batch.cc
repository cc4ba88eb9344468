// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/neo_hookean.h>

#include <cmath>
#include <limits>

namespace EBSMPM
{
  namespace
  {
    /**
     * Return $J^{-1/3}$ in all lanes. Most material is nearly incompressible;
     * where it is not, the library function has to do.
     */
    template <typename L>
    EBSMPM_IN_EACH_TARGET typename L::type
    inverse_cube_root(const typename L::type J)
    {
      typename L::type y;

      bool near_one = true;
      for (unsigned int l = 0; l < L::n; ++l)
        near_one &= (J[l] > 0.5) & (J[l] < 2.);
      if (!near_one)
        {
          for (unsigned int l = 0; l < L::n; ++l)
            y[l] = 1. / std::cbrt(J[l]);
          return y;
        }

      // A parabola that is off by 1.4 % at most, and three steps in which the
      // error e of J y^3 becomes 14/27 e^3: less than 1e-5, then round-off.
      y = 1.5658 - J * (0.734 - 0.1766 * J);
      for (unsigned int step = 0; step < 3; ++step)
        {
          const typename L::type e = 1. - J * y * y * y;
          y *= 1. + e * (1. / 3. + e * (2. / 9.));
        }
      return y;
    }



    /**
     * Matrices of lanes.
     */
    template <typename L, int dim>
    struct Matrix
    {
      using Vector = typename L::type;

      Vector entries[dim][dim];

      EBSMPM_IN_EACH_TARGET Vector *
      operator[](const unsigned int i)
      {
        return entries[i];
      }

      EBSMPM_IN_EACH_TARGET const Vector *
      operator[](const unsigned int i) const
      {
        return entries[i];
      }

      /** This times the transpose of another one. */
      EBSMPM_IN_EACH_TARGET Matrix
      times_transpose(const Matrix &B) const
      {
        Matrix result;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              result[i][j] = entries[i][0] * B[j][0];
              for (unsigned int k = 1; k < dim; ++k)
                result[i][j] += entries[i][k] * B[j][k];
            }
        return result;
      }

      /** The cofactors: the determinant times the transposed inverse. */
      EBSMPM_IN_EACH_TARGET Matrix
      cofactors() const
      {
        Matrix      result;
        const auto &F = entries;
        if (dim == 1)
          result[0][0] = F[0][0] * 0. + 1.;
        else if (dim == 2)
          {
            result[0][0]             = F[dim - 1][dim - 1];
            result[0][dim - 1]       = -F[dim - 1][0];
            result[dim - 1][0]       = -F[0][dim - 1];
            result[dim - 1][dim - 1] = F[0][0];
          }
        else
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                const unsigned int a = (i + 1) % dim, b = (i + 2) % dim;
                const unsigned int c = (j + 1) % dim, d = (j + 2) % dim;
                result[i][j] = F[a][c] * F[b][d] - F[a][d] * F[b][c];
              }
        return result;
      }
    };



    /**
     * What the kernel computes from.
     */
    template <int dim>
    struct Task
    {
      MaterialBatch<dim> &batch;
      const double        K;
      const double        G;

      /** Whether there is a split of the energy. */
      const bool split;

      /** Whether the tangent is wanted. */
      const bool with_tangent;
    };



    /**
     * NeoHookean::respond() for a register full of points after the other.
     * Return a determinant that is not positive or not finite, or else
     * one.
     */
    struct Respond
    {
      template <unsigned int n_bytes, int dim>
      static EBSMPM_IN_EACH_TARGET double
      run(const Task<dim> *task)
      {
        using L      = ShortLanes<n_bytes>;
        using Vector = typename L::type;

        MaterialBatch<dim> &batch = task->batch;
        const Vector zero = {}, one = zero + 1., K_intact = zero + task->K;
        const Vector infinity = zero + std::numeric_limits<double>::infinity();
        Vector       worst    = one;
        for (unsigned int p = 0; p < batch.n_padded_points(); p += L::n)
          {
            Matrix<L, dim> F, F_n;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                {
                  F[i][j]   = L::load(batch.F(i, j) + p);
                  F_n[i][j] = L::load(batch.F_n(i, j) + p);
                }
            const Vector volume = L::load(batch.volume() + p);
            const Vector g      = L::load(batch.degradation() + p);
            const Vector branch = L::load(batch.branch() + p);

            Matrix<L, dim> H     = F.cofactors();
            Vector         J     = F[0][0] * H[0][0];
            Vector         trace = F[0][0] * F[0][0] + (3. - dim);
            for (unsigned int j = 1; j < dim; ++j)
              J += F[0][j] * H[0][j];
            for (unsigned int k = 1; k < dim * dim; ++k)
              trace += F[k / dim][k % dim] * F[k / dim][k % dim];
            worst = ((J > zero) & (J < infinity)) ? worst : J;

            const Vector inverse_J = 1. / J;
            for (unsigned int k = 0; k < dim * dim; ++k)
              H[k / dim][k % dim] *= inverse_J;

            // Does the volumetric part degrade?
            Vector K = task->K * g;
            if (task->split)
              K = ((branch == zero) ? (J >= one) : (branch > zero)) ? K :
                                                                      K_intact;

            const Vector root = inverse_cube_root<L>(J);
            const Vector p1   = volume * task->G * g * root * root;
            K *= volume;
            const Vector p2 = 0.5 * K * (J * J - 1.) - p1 * trace * (1. / 3.);

            // Pushed forward to the start of the step.
            const Matrix<L, dim> FF = F.times_transpose(F_n);
            const Matrix<L, dim> HF = H.times_transpose(F_n);
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                L::store(p1 * FF[i][j] + p2 * HF[i][j], batch.stress(i, j) + p);
            if (!task->with_tangent)
              continue;

            const Vector         c2 = (-2. / 3.) * p1;
            const Vector         c3 = K * J * J + (2. / 9.) * p1 * trace;
            const Matrix<L, dim> B  = F_n.times_transpose(F_n);
            for (unsigned int i = 0, pair = 0; i < dim; ++i)
              for (unsigned int k = i; k < dim; ++k, ++pair)
                for (unsigned int j = 0; j < dim; ++j)
                  {
                    const Vector of_F = c2 * HF[i][j];
                    const Vector of_H = c2 * FF[i][j] + c3 * HF[i][j];
                    const Vector of_T = p2 * HF[k][j];
                    for (unsigned int l = 0; l < dim; ++l)
                      {
                        Vector c =
                          of_F * FF[k][l] + of_H * HF[k][l] - of_T * HF[i][l];
                        if (i == k)
                          c += p1 * B[j][l];
                        L::store(c, batch.tangent(pair, j, l) + p);
                      }
                  }
          }
        for (unsigned int l = 1; l < L::n; ++l)
          if (worst[0] == 1.)
            worst[0] = worst[l];
        return worst[0];
      }
    };
  } // namespace



  template <int dim>
  void
  NeoHookean<dim>::respond(MaterialBatch<dim> &batch,
                           const bool          with_tangent) const
  {
    const Task<dim> task = {
      batch, this->K, this->G, this->split != EnergySplit::none, with_tangent};
    this->check_determinant(run_best<Respond>(&task));
  }



  template void
  NeoHookean<1>::respond(MaterialBatch<1> &, const bool) const;
  template void
  NeoHookean<2>::respond(MaterialBatch<2> &, const bool) const;
  template void
  NeoHookean<3>::respond(MaterialBatch<3> &, const bool) const;
} // namespace EBSMPM
