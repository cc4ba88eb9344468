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



    /** What a kernel computes from. */
    template <typename Batch>
    struct Task
    {
      Batch       &batch;
      const double K;
      const double G;

      /** Whether there is a split of the energy. */
      const bool split;

      /** Whether the last derivatives are wanted. */
      const bool with_derivatives;
    };



    /**
     * What the answers consist of, for a register full of points: F and H,
     * pushed forward to the start of the step, and the coefficients (see
     * NeoHookean), multiplied by the weight.
     */
    template <typename L, int dim>
    struct Point
    {
      using Vector = typename L::type;

      /**
       * Compute it for the points from number @p p on. Return the determinants
       * where they are not positive or not finite, and one elsewhere.
       */
      template <typename Batch>
      EBSMPM_IN_EACH_TARGET Vector
      reinit(const Task<Batch> &task, const unsigned int p)
      {
        const Batch &batch = task.batch;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              F[i][j]   = L::load(batch.F(i, j) + p);
              F_n[i][j] = L::load(batch.F_n(i, j) + p);
            }
        const Vector zero = {}, one = zero + 1.;
        const Vector infinity = zero + std::numeric_limits<double>::infinity();
        const Vector weight   = L::load(batch.weight() + p);
        const Vector g        = L::load(batch.degradation() + p);
        const Vector branch   = L::load(batch.branch() + p);

        H     = F.cofactors();
        J     = F[0][0] * H[0][0];
        trace = F[0][0] * F[0][0] + (3. - dim);
        for (unsigned int j = 1; j < dim; ++j)
          J += F[0][j] * H[0][j];
        for (unsigned int k = 1; k < dim * dim; ++k)
          trace += F[k / dim][k % dim] * F[k / dim][k % dim];

        const Vector inverse_J = 1. / J;
        for (unsigned int k = 0; k < dim * dim; ++k)
          H[k / dim][k % dim] *= inverse_J;

        // Does the volumetric part degrade?
        const Vector K_intact = zero + task.K;
        K                     = task.K * g;
        if (task.split)
          K = ((branch == zero) ? (J >= one) : (branch > zero)) ? K : K_intact;
        K *= weight;

        const Vector root = inverse_cube_root<L>(J);
        p1                = weight * task.G * g * root * root;
        p2                = 0.5 * K * (J * J - 1.) - p1 * trace * (1. / 3.);
        c2                = (-2. / 3.) * p1;
        c3                = K * J * J + (2. / 9.) * p1 * trace;

        FF = F.times_transpose(F_n);
        HF = H.times_transpose(F_n);
        return ((J > zero) & (J < infinity)) ? one : J;
      }

      Matrix<L, dim> F, F_n, H, FF, HF;
      Vector         J, trace, K, p1, p2, c2, c3;
    };



    /** What MaterialBatch asks, from number @p p on. */
    template <typename L, int dim>
    EBSMPM_IN_EACH_TARGET void
    answer(const Point<L, dim> &point,
           const unsigned int   p,
           const bool           with_derivatives,
           MaterialBatch<dim>  &batch)
    {
      using Vector = typename L::type;

      const Matrix<L, dim> &FF = point.FF, &HF = point.HF;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          L::store(point.p1 * FF[i][j] + point.p2 * HF[i][j],
                   batch.stress(i, j) + p);
      if (!with_derivatives)
        return;

      const Matrix<L, dim> B = point.F_n.times_transpose(point.F_n);
      for (unsigned int i = 0, pair = 0; i < dim; ++i)
        for (unsigned int k = i; k < dim; ++k, ++pair)
          for (unsigned int j = 0; j < dim; ++j)
            {
              const Vector of_F = point.c2 * HF[i][j];
              const Vector of_H = point.c2 * FF[i][j] + point.c3 * HF[i][j];
              const Vector of_T = point.p2 * HF[k][j];
              for (unsigned int l = 0; l < dim; ++l)
                {
                  Vector c =
                    of_F * FF[k][l] + of_H * HF[k][l] - of_T * HF[i][l];
                  if (i == k)
                    c += point.p1 * B[j][l];
                  L::store(c, batch.tangent(pair, j, l) + p);
                }
            }
    }



    /**
     * What TractionBatch asks. In the direction $\mathbf w\otimes\mathbf N$,
     * the derivative of $\mathbf H$ is the dyad of $-\mathbf H\mathbf N$ and
     * $\mathbf H^T\mathbf w$.
     */
    template <typename L, int dim>
    EBSMPM_IN_EACH_TARGET void
    answer(const Point<L, dim> &point,
           const unsigned int   p,
           const bool           with_derivatives,
           TractionBatch<dim>  &batch)
    {
      using Vector      = typename L::type;
      const Vector zero = {};

      // What F, H and F_n make of the normal.
      Vector f[dim] = {}, h[dim] = {}, m[dim] = {};
      for (unsigned int j = 0; j < dim; ++j)
        {
          const Vector N = L::load(batch.normal(j) + p);
          for (unsigned int i = 0; i < dim; ++i)
            {
              f[i] += point.F[i][j] * N;
              h[i] += point.H[i][j] * N;
              m[i] += point.F_n[i][j] * N;
            }
        }

      const Matrix<L, dim> &FF = point.FF, &HF = point.HF;
      const Vector p1 = point.p1, p2 = point.p2, c2 = point.c2, c3 = point.c3;
      for (unsigned int i = 0; i < dim; ++i)
        {
          L::store(p1 * f[i] + p2 * h[i], batch.traction(i) + p);
          const Vector of_F = c2 * h[i];
          const Vector of_H = c2 * f[i] + c3 * h[i];
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int l = 0; l < dim; ++l)
              {
                Vector T =
                  of_F * FF[k][l] + of_H * HF[k][l] - p2 * h[k] * HF[i][l];
                if (i == k)
                  T += p1 * m[l];
                L::store(T, batch.derivative(i, k, l) + p);
              }
        }
      if (!with_derivatives)
        return;

      // Derivatives have the prefix d_; that of HF is -h v.
      Vector w[dim], v[dim] = {}, d_log_J = zero, d_trace = zero;
      for (unsigned int i = 0; i < dim; ++i)
        {
          w[i] = L::load(batch.w(i) + p);
          d_log_J += w[i] * h[i];
          d_trace += 2. * w[i] * f[i];
          for (unsigned int l = 0; l < dim; ++l)
            v[l] += w[i] * HF[i][l];
        }
      const Vector d_p1       = (-2. / 3.) * p1 * d_log_J;
      const Vector d_p1_trace = d_p1 * point.trace + p1 * d_trace;
      const Vector of_J       = point.K * point.J * point.J * d_log_J;
      const Vector d_p2       = of_J - (1. / 3.) * d_p1_trace;
      const Vector d_c2       = (-2. / 3.) * d_p1;
      const Vector d_c3       = 2. * of_J + (2. / 9.) * d_p1_trace;

      const Matrix<L, dim> B = point.F_n.times_transpose(point.F_n);
      for (unsigned int i = 0, pair = 0; i < dim; ++i)
        for (unsigned int k = i; k < dim; ++k, ++pair)
          for (unsigned int j = 0; j < dim; ++j)
            {
              const Vector d_H  = -h[i] * v[j];
              const Vector of_F = d_c2 * HF[i][j] + c2 * d_H;
              const Vector of_H =
                d_c2 * FF[i][j] + c2 * w[i] * m[j] + d_c3 * HF[i][j] + c3 * d_H;
              const Vector of_m = c2 * HF[i][j] * w[k];
              const Vector of_v =
                p2 * h[i] * HF[k][j] - (c2 * FF[i][j] + c3 * HF[i][j]) * h[k];
              const Vector of_T = p2 * h[k] * v[j] - d_p2 * HF[k][j];
              for (unsigned int l = 0; l < dim; ++l)
                {
                  Vector c = of_F * FF[k][l] + of_H * HF[k][l] + of_m * m[l] +
                             of_v * v[l] + of_T * HF[i][l];
                  if (i == k)
                    c += d_p1 * B[j][l];
                  L::store(c, batch.second_derivative(pair, j, l) + p);
                }
            }
    }



    /**
     * NeoHookean::respond() for a register full of points after the other.
     * Return a determinant that is not positive or not finite, or else one.
     */
    struct Respond
    {
      template <unsigned int n_bytes, template <int> class Batch, int dim>
      static EBSMPM_IN_EACH_TARGET double
      run(const Task<Batch<dim>> *task)
      {
        using L      = ShortLanes<n_bytes>;
        using Vector = typename L::type;

        const Vector zero = {}, one = zero + 1.;
        Vector       worst = one;
        for (unsigned int p = 0; p < task->batch.n_padded_points(); p += L::n)
          {
            Point<L, dim> point;
            const Vector  here = point.reinit(*task, p);
            worst              = (worst == one) ? here : worst;
            answer(point, p, task->with_derivatives, task->batch);
          }
        for (unsigned int l = 0; l < L::n; ++l)
          if (!(worst[l] == 1.))
            return worst[l];
        return 1.;
      }
    };
  } // namespace



  template <int dim>
  void
  NeoHookean<dim>::respond(MaterialBatch<dim> &batch,
                           const bool          with_tangent) const
  {
    const Task<MaterialBatch<dim>> task = {
      batch, this->K, this->G, this->split != EnergySplit::none, with_tangent};
    this->check_determinant(run_best<Respond>(&task));
  }



  template <int dim>
  void
  NeoHookean<dim>::respond(TractionBatch<dim> &batch,
                           const bool          with_second) const
  {
    const Task<TractionBatch<dim>> task = {
      batch, this->K, this->G, this->split != EnergySplit::none, with_second};
    this->check_determinant(run_best<Respond>(&task));
  }



  template void
  NeoHookean<1>::respond(MaterialBatch<1> &, const bool) const;
  template void
  NeoHookean<2>::respond(MaterialBatch<2> &, const bool) const;
  template void
  NeoHookean<3>::respond(MaterialBatch<3> &, const bool) const;
  template void
  NeoHookean<1>::respond(TractionBatch<1> &, const bool) const;
  template void
  NeoHookean<2>::respond(TractionBatch<2> &, const bool) const;
  template void
  NeoHookean<3>::respond(TractionBatch<3> &, const bool) const;
} // namespace EBSMPM
