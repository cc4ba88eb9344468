// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/elastic_terms.h>
#include <ebsmpm/assembly/point_values.h>

namespace EBSMPM
{
  template <int dim>
  ElasticTerms<dim>::ElasticTerms(const Material<dim> &material,
                                  const Degradation   &degradation)
    : material(material)
    , degradation(degradation)
  {}



  template <int dim>
  void
  ElasticTerms<dim>::initialize(const unsigned int n_functions,
                                const unsigned int max_n_points)
  {
    batch.initialize(max_n_points);
    products.initialize(n_functions, max_n_points);
  }



  template <int dim>
  void
  ElasticTerms<dim>::compute(const AssemblyTask               task,
                             const MaterialState<dim>        &state,
                             const std::vector<EnergyBranch> &branches,
                             LocalSystem<dim>                &local)
  {
    const bool with_tangent = (task != AssemblyTask::residual);
    deform(state, branches, local);
    material.respond(batch, with_tangent);
    add_residual(local);
    if (with_tangent)
      products.add_tangent(local.n_points(),
                           batch.tangent(0, 0, 0),
                           batch.row_length(),
                           local);
  }



  template <int dim>
  void
  ElasticTerms<dim>::deform(const MaterialState<dim>        &state,
                            const std::vector<EnergyBranch> &branches,
                            const LocalSystem<dim>          &local)
  {
    const unsigned int n_points = local.n_points();
    products.evaluate(n_points, local);

    batch.reinit(n_points);
    for (unsigned int p = 0; p < n_points; ++p)
      {
        const unsigned int q = local.point(p);
        batch.set(p,
                  deformation<dim>(products.gradient(p), state.F[q]),
                  state.F[q],
                  state.volume[q],
                  degradation.value(state.damage[q]),
                  branch_of(branches, q));
      }
  }



  template <int dim>
  void
  ElasticTerms<dim>::add_residual(LocalSystem<dim> &local)
  {
    const unsigned int n_points = local.n_points();
    for (unsigned int p = 0; p < n_points; ++p)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int i = 0; i < dim; ++i)
          products.dual(p, j, i) = batch.stress(i, j)[p];
    products.add_residual(n_points, local);
  }



  template class ElasticTerms<2>;
  template class ElasticTerms<3>;
} // namespace EBSMPM
