// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

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
    max_points = max_n_points;
    product.initialize(n_functions, max_n_points);
    coefficients.resize(MaterialBatch<dim>::n_pairs * (dim + 1) * (dim + 1) *
                        max_n_points);
  }



  template <int dim>
  void
  NitscheTerms<dim>::compute(const AssemblyTask               task,
                             const BoundaryState<dim>        &boundary,
                             const std::vector<EnergyBranch> &branches,
                             LocalSystem<dim>                &local)
  {
    PointData point;
    for (unsigned int k = 0; k < local.n_points(); ++k)
      {
        const auto &constrained = boundary.constrained[local.point(k)];
        evaluate(boundary, branches, local, k, point);
        std::array<Tensor<2, dim>, dim> T;
        for (unsigned int i = 0; i < dim; ++i)
          if (constrained[i])
            T[i] = traction_derivative(point, i);

        add_residual(point, constrained, T, local);
        const Tensor<1, dim> traction = boundary.traction[local.point(k)];
        for (unsigned int I = 0; I < local.n_functions(); ++I)
          local.residual[I] -= point.A0 * point.B[I] * traction;
        if (task != AssemblyTask::residual)
          set_coefficients(task, k, point, constrained, T);
      }
    if (task != AssemblyTask::residual)
      product.compute(local.n_points(), coefficients.data(), max_points, local);
  }



  template <int dim>
  void
  NitscheTerms<dim>::evaluate(const BoundaryState<dim>        &boundary,
                              const std::vector<EnergyBranch> &branches,
                              const LocalSystem<dim>          &local,
                              const unsigned int               k,
                              PointData                       &point)
  {
    local.values_and_gradients(k,
                               product.row(k, 0),
                               product.row(k, 1),
                               product.stride());
    point.B = product.row(k, 0);
    for (unsigned int d = 0; d < dim; ++d)
      point.G[d] = product.row(k, 1 + d);

    const unsigned int q = local.point(k);
    point.F_n            = boundary.F[q];
    point.F =
      deformation<dim>(local.gradient(point.G[0], product.stride()), point.F_n);
    point.N  = boundary.normal[q];
    point.w  = mismatch(boundary, q, local.value(point.B));
    point.A0 = boundary.area[q];
    point.g  = degradation.value(boundary.damage[q]);
    material.response(point.F, point.g, point.response, branch_of(branches, q));
    point.traction = point.response.P * point.N;
  }



  template <int dim>
  Tensor<2, dim>
  NitscheTerms<dim>::traction_derivative(const PointData   &point,
                                         const unsigned int i)
  {
    Tensor<2, dim> NA;
    for (unsigned int b = 0; b < dim; ++b)
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int d = 0; d < dim; ++d)
          NA[k][d] += point.N[b] * point.response.A[i][b][k][d];
    return NA * transpose(point.F_n);
  }



  template <int dim>
  void
  NitscheTerms<dim>::add_residual(const PointData             &point,
                                  const std::array<bool, dim> &constrained,
                                  const std::array<Tensor<2, dim>, dim> &T,
                                  LocalSystem<dim> &local) const
  {
    Tensor<1, dim> of_value;
    Tensor<2, dim> of_gradient;
    for (unsigned int i = 0; i < dim; ++i)
      if (constrained[i])
        {
          of_value[i] = point.A0 * (beta * point.w[i] - point.traction[i]);
          of_gradient -= point.A0 * point.w[i] * T[i];
        }
    for (unsigned int I = 0; I < local.n_functions(); ++I)
      {
        local.residual[I] += of_value * point.B[I];
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int l = 0; l < dim; ++l)
            local.residual[I][j] += of_gradient[j][l] * point.G[l][I];
      }
  }



  template <int dim>
  double &
  NitscheTerms<dim>::coefficient(const unsigned int pair,
                                 const unsigned int j,
                                 const unsigned int l,
                                 const unsigned int point)
  {
    return coefficients[((pair * (dim + 1) + j) * (dim + 1) + l) * max_points +
                        point];
  }



  template <int dim>
  void
  NitscheTerms<dim>::set_coefficients(const AssemblyTask           task,
                                      const unsigned int           p,
                                      const PointData             &point,
                                      const std::array<bool, dim> &constrained,
                                      const std::array<Tensor<2, dim>, dim> &T)
  {
    Tensor<4, dim> dA;
    if (task == AssemblyTask::tangent && point.w.norm_square() > 0.)
      dA = material.tangent_derivative(point.F,
                                       point.g,
                                       outer_product(point.w, point.N));

    for (unsigned int i = 0, pair = 0; i < dim; ++i)
      for (unsigned int k = i; k < dim; ++k, ++pair)
        {
          Tensor<2, dim> c;
          for (unsigned int b = 0; b < dim; ++b)
            for (unsigned int d = 0; d < dim; ++d)
              c[b][d] = point.A0 * dA[i][b][k][d];
          c = point.F_n * c * transpose(point.F_n);

          coefficient(pair, 0, 0, p) =
            (i == k && constrained[i]) ? point.A0 * beta : 0.;
          for (unsigned int j = 0; j < dim; ++j)
            {
              coefficient(pair, 0, 1 + j, p) =
                constrained[i] ? -point.A0 * T[i][k][j] : 0.;
              coefficient(pair, 1 + j, 0, p) =
                constrained[k] ? -point.A0 * T[k][i][j] : 0.;
              for (unsigned int l = 0; l < dim; ++l)
                coefficient(pair, 1 + j, 1 + l, p) = -c[j][l];
            }
        }
  }



  template class NitscheTerms<2>;
  template class NitscheTerms<3>;
} // namespace EBSMPM
