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
  NitscheTerms<dim>::compute(const AssemblyTask               task,
                             const BoundaryState<dim>        &boundary,
                             const std::vector<EnergyBranch> &branches,
                             LocalSystem<dim>                &local) const
  {
    if (task != AssemblyTask::residual)
      local.clear_tangent();

    const unsigned int n = local.n_functions();
    PointData          point;
    for (unsigned int k = 0; k < local.n_points(); ++k)
      {
        evaluate(boundary, branches, local, k, point);

        Tensor<2, dim> wT;
        for (unsigned int i = 0; i < dim; ++i)
          if (boundary.constrained[local.point(k)][i])
            {
              const Tensor<2, dim> T = traction_derivative(point, i);
              wT += point.w[i] * T;
              add_component(task, i, T, point, local);
            }

        for (unsigned int I = 0; I < n; ++I)
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int l = 0; l < dim; ++l)
              local.residual[I][j] -= point.A0 * wT[j][l] * point.G[l * n + I];

        const Tensor<1, dim> &traction = boundary.traction[local.point(k)];
        for (unsigned int I = 0; I < n; ++I)
          local.residual[I] -= point.A0 * point.B[I] * traction;

        if (task == AssemblyTask::tangent && point.w.norm_square() > 0.)
          add_derivative_of_tangent(point, local);
      }
  }



  template <int dim>
  void
  NitscheTerms<dim>::evaluate(const BoundaryState<dim>        &boundary,
                              const std::vector<EnergyBranch> &branches,
                              const LocalSystem<dim>          &local,
                              const unsigned int               k,
                              PointData                       &point) const
  {
    const unsigned int q = local.point(k);
    local.values_and_gradients(k, point.B.data(), point.G.data());

    point.F_n = boundary.F[q];
    point.F   = deformation<dim>(local.gradient(point.G.data()), point.F_n);
    point.N   = boundary.normal[q];
    point.w   = mismatch(boundary, q, local.value(point.B.data()));
    point.A0  = boundary.area[q];
    point.g   = degradation.value(boundary.damage[q]);
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
  NitscheTerms<dim>::add_component(const AssemblyTask    task,
                                   const unsigned int    i,
                                   const Tensor<2, dim> &T,
                                   const PointData      &point,
                                   LocalSystem<dim>     &local) const
  {
    const unsigned int n  = local.n_functions();
    const double       A0 = point.A0;
    const auto        &B  = point.B;
    for (unsigned int I = 0; I < n; ++I)
      local.residual[I][i] +=
        A0 * B[I] * (beta * point.w[i] - point.traction[i]);

    if (task == AssemblyTask::residual)
      return;

    // t[k][J], a row per component.
    std::array<std::array<double, BSplineKernel<dim>::max_n_functions>, dim> t;
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int J = 0; J < n; ++J)
        {
          t[k][J] = 0.;
          for (unsigned int l = 0; l < dim; ++l)
            t[k][J] += T[k][l] * point.G[l * n + J];
        }

    for (unsigned int I = 0; I < n; ++I)
      {
        const double penalty = A0 * beta * B[I];
        const double weight  = A0 * B[I];
        double      *row     = local.tangent_block(i, i) + I * n;
        for (unsigned int J = 0; J < n; ++J)
          row[J] += penalty * B[J];
        for (unsigned int k = 0; k < dim; ++k)
          {
            row            = local.tangent_block(i, k) + I * n;
            double *column = local.tangent_block(k, i) + I;
            for (unsigned int J = 0; J < n; ++J)
              row[J] -= weight * t[k][J];
            for (unsigned int J = 0; J < n; ++J)
              column[J * n] -= weight * t[k][J];
          }
      }
  }



  template <int dim>
  void
  NitscheTerms<dim>::add_derivative_of_tangent(const PointData  &point,
                                               LocalSystem<dim> &local) const
  {
    const unsigned int              n = local.n_functions();
    std::array<const double *, dim> rows;
    for (unsigned int l = 0; l < dim; ++l)
      rows[l] = point.G.data() + l * n;
    const Tensor<4, dim> dA =
      material.tangent_derivative(point.F,
                                  point.g,
                                  outer_product(point.w, point.N));
    for (unsigned int j = 0; j < dim; ++j)
      for (unsigned int k = 0; k < dim; ++k)
        {
          Tensor<2, dim> c;
          for (unsigned int b = 0; b < dim; ++b)
            for (unsigned int d = 0; d < dim; ++d)
              c[b][d] = point.A0 * dA[j][b][k][d];
          c = point.F_n * c * transpose(point.F_n);

          double *row = local.tangent_block(j, k);
          for (unsigned int I = 0; I < n; ++I, row += n)
            {
              Tensor<2, dim> Gc = c;
              for (unsigned int m = 0; m < dim; ++m)
                Gc[m] *= rows[m][I];
              for (unsigned int J = 0; J < n; ++J)
                {
                  double entry = row[J];
                  for (unsigned int m = 0; m < dim; ++m)
                    for (unsigned int l = 0; l < dim; ++l)
                      entry -= Gc[m][l] * rows[l][J];
                  row[J] = entry;
                }
            }
        }
  }



  template class NitscheTerms<2>;
  template class NitscheTerms<3>;
} // namespace EBSMPM
