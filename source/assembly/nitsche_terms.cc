// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/lanes.h>

#include <ebsmpm/assembly/nitsche_terms.h>
#include <ebsmpm/assembly/point_values.h>

namespace EBSMPM
{
  template <int dim>
  NitscheTerms<dim>::NitscheTerms(const Material<dim> &material,
                                  const Degradation   &degradation,
                                  const double         penalty)
    : material(material)
    , degradation(degradation)
    , beta(penalty)
  {}



  template <int dim>
  void
  NitscheTerms<dim>::initialize(const unsigned int n_functions,
                                const unsigned int max_n_points)
  {
    batch.initialize(max_n_points);
    products.initialize(n_functions, max_n_points);
    projections.assign(dim * dim * batch.row_length(), 0.);
    duals.resize((dim + 1) * dim * batch.row_length());
    coefficients.resize(batch.n_pairs * (dim + 1) * (dim + 1) *
                        batch.row_length());
  }



  template <int dim>
  struct NitscheTerms<dim>::Combine
  {
    /**
     * The numbers of the residual, and those of the tangent if wanted. Most
     * often, components are prescribed, and the projections are diagonal.
     */
    template <unsigned int n_bytes>
    static EBSMPM_IN_EACH_TARGET void
    run(NitscheTerms<dim> *terms, const AssemblyTask task)
    {
      if (terms->is_diagonal)
        run<n_bytes, true>(terms, task);
      else
        run<n_bytes, false>(terms, task);
    }

    /** Component @p i of a projected vector, from row i of the projection. */
    template <bool is_diagonal, typename Vector>
    static EBSMPM_IN_EACH_TARGET Vector
    project(const unsigned int i, const Vector *Pi_i, const Vector *v)
    {
      Vector sum = Pi_i[i] * v[i];
      if (!is_diagonal)
        for (unsigned int m = 0; m < dim; ++m)
          if (m != i)
            sum += Pi_i[m] * v[m];
      return sum;
    }

    template <unsigned int n_bytes, bool is_diagonal>
    static EBSMPM_IN_EACH_TARGET void
    run(NitscheTerms<dim> *terms, const AssemblyTask task)
    {
      using L      = ShortLanes<n_bytes>;
      using Vector = typename L::type;

      TractionBatch<dim> &batch = terms->batch;
      for (unsigned int p = 0; p < batch.n_padded_points(); p += L::n)
        {
          const Vector penalty = terms->beta * L::load(batch.weight() + p);
          Vector       Pi[dim][dim], w[dim], t[dim];
          for (unsigned int i = 0; i < dim; ++i)
            {
              w[i] = L::load(batch.w(i) + p);
              t[i] = L::load(batch.traction(i) + p);
              for (unsigned int m = 0; m < dim; ++m)
                Pi[i][m] = L::load(terms->projection(i, m) + p);
            }
          for (unsigned int i = 0; i < dim; ++i)
            L::store(penalty * w[i] - project<is_diagonal>(i, Pi[i], t),
                     terms->dual(0, i) + p);
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int l = 0; l < dim; ++l)
              {
                Vector sum = {};
                for (unsigned int i = 0; i < dim; ++i)
                  sum -= w[i] * L::load(batch.derivative(i, j, l) + p);
                L::store(sum, terms->dual(1 + l, j) + p);
              }
          if (task == AssemblyTask::residual)
            continue;

          const Vector zero = {};
          for (unsigned int i = 0, pair = 0; i < dim; ++i)
            for (unsigned int k = i; k < dim; ++k, ++pair)
              {
                L::store(penalty * Pi[i][k],
                         terms->coefficient(pair, 0, 0) + p);
                for (unsigned int j = 0; j < dim; ++j)
                  {
                    Vector T_k[dim], T_i[dim];
                    for (unsigned int m = 0; m < dim; ++m)
                      {
                        T_k[m] = L::load(batch.derivative(m, k, j) + p);
                        T_i[m] = L::load(batch.derivative(m, i, j) + p);
                      }
                    L::store(-project<is_diagonal>(i, Pi[i], T_k),
                             terms->coefficient(pair, 0, 1 + j) + p);
                    L::store(-project<is_diagonal>(k, Pi[k], T_i),
                             terms->coefficient(pair, 1 + j, 0) + p);
                    for (unsigned int l = 0; l < dim; ++l)
                      L::store(task == AssemblyTask::tangent ?
                                 -L::load(batch.second_derivative(pair, j, l) +
                                          p) :
                                 zero,
                               terms->coefficient(pair, 1 + j, 1 + l) + p);
                  }
              }
        }
    }
  };



  template <int dim>
  void
  NitscheTerms<dim>::compute(const AssemblyTask               task,
                             const BoundaryState<dim>        &boundary,
                             const std::vector<EnergyBranch> &branches,
                             LocalSystem<dim>                &local)
  {
    const unsigned int n_points = local.n_points();
    evaluate(boundary, branches, local);
    material.respond(batch, task == AssemblyTask::tangent);
    run_best<Combine>(this, task);

    for (unsigned int p = 0; p < n_points; ++p)
      for (unsigned int i = 0; i < dim; ++i)
        {
          const unsigned int q = local.point(p);
          products.dual(p, 0, i) =
            dual(0, i)[p] - boundary.area[q] * boundary.traction[q][i];
          for (unsigned int j = 0; j < dim; ++j)
            products.dual(p, 1 + j, i) = dual(1 + j, i)[p];
        }
    products.add_residual(n_points, local);
    if (task != AssemblyTask::residual)
      products.add_tangent(n_points,
                           coefficients.data(),
                           batch.row_length(),
                           local);
  }



  template <int dim>
  void
  NitscheTerms<dim>::evaluate(const BoundaryState<dim>        &boundary,
                              const std::vector<EnergyBranch> &branches,
                              const LocalSystem<dim>          &local)
  {
    const unsigned int n_points = local.n_points();
    products.evaluate(n_points, local);

    batch.reinit(n_points);
    is_diagonal = true;
    for (unsigned int p = 0; p < n_points; ++p)
      {
        const unsigned int q = local.point(p);
        Tensor<1, dim>     value;
        for (unsigned int a = 0; a < dim; ++a)
          {
            value[a] = products.increment(p, 0, a);
            for (unsigned int b = 0; b < dim; ++b)
              {
                const double Pi_ab  = boundary.projection[q][a][b];
                projection(a, b)[p] = Pi_ab;
                is_diagonal         = is_diagonal && (a == b || Pi_ab == 0.);
              }
          }
        batch.set(p,
                  deformation<dim>(products.gradient(p), boundary.F[q]),
                  boundary.F[q],
                  boundary.area[q],
                  degradation.value(boundary.damage[q]),
                  branch_of(branches, q));
        batch.set_vectors(p, boundary.normal[q], mismatch(boundary, q, value));
      }
  }



  template class NitscheTerms<2>;
  template class NitscheTerms<3>;
} // namespace EBSMPM
