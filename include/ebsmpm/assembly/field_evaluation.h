// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_field_evaluation_h
#define ebsmpm_assembly_field_evaluation_h

#include <ebsmpm/lac/types.h>

#include <ebsmpm/splines/bspline_kernel.h>

#include <ebsmpm/assembly/point_groups.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace EBSMPM
{
  /**
   * Gather the coefficients that a group of points reads, $c_i=\sum_j E_{ij}
   * x_j$.
   *
   * @param groups and @p group: who reads
   * @param field a vector with up-to-date ghost entries
   * @param coefficients on output, an array of <tt>n_components</tt>
   *   coefficients per function of the cell
   */
  template <int n_components, int dim>
  inline void
  gather_coefficients(const PointGroups<dim>                 &groups,
                      const typename PointGroups<dim>::Group &group,
                      const LA::FieldVector                  &field,
                      Tensor<1, n_components>                *coefficients)
  {
    const unsigned int  n         = groups.n_functions_per_cell();
    const unsigned int *functions = groups.functions(group);
    const auto          unknowns  = [&](const unsigned int j) {
      Tensor<1, n_components> result;
      for (unsigned int a = 0; a < n_components; ++a)
        result[a] = field.local_element(n_components * functions[j] + a);
      return result;
    };

    if (const double *E = groups.extension(group))
      for (unsigned int i = 0; i < n; ++i)
        {
          coefficients[i] = Tensor<1, n_components>();
          for (unsigned int j = 0; j < group.n_functions; ++j, ++E)
            if (*E != 0.)
              coefficients[i] += *E * unknowns(j);
        }
    else
      for (unsigned int i = 0; i < n; ++i)
        coefficients[i] = unknowns(i);
  }



  /**
   * Evaluate a field and its gradient at all points and hand them to a function
   * <tt>visit(q, value, gradient)</tt>, where @p q is the number of the point
   * in CellPoints, @p value a <tt>Tensor<1,n_components></tt>, and row $a$ of
   * <tt>gradient</tt>, a <tt>std::array<Tensor<1,dim>,n_components></tt>, the
   * gradient of component $a$.
   *
   * @param degree of the splines
   * @param field a vector with up-to-date ghost entries
   */
  template <int n_components, int dim, typename Visitor>
  void
  evaluate_field(const CellPoints<dim>       &points,
                 const PointGroups<dim>      &groups,
                 const CartesianLattice<dim> &lattice,
                 const unsigned int           degree,
                 const LA::FieldVector       &field,
                 const Visitor               &visit)
  {
    const BSplineKernel<dim> kernel(degree);
    const unsigned int       n = kernel.n_functions();
    std::array<Tensor<1, n_components>, BSplineKernel<dim>::max_n_functions>
                               coefficients;
    constexpr unsigned int     stride = BSplineKernel<dim>::max_n_functions + 1;
    std::array<double, stride> B;
    std::array<double, dim * stride> dB;

    for (const auto &group : groups.groups())
      {
        gather_coefficients<n_components>(groups,
                                          group,
                                          field,
                                          coefficients.data());
        const Tensor<1, dim> inverse_h =
          lattice.inverse_cell_extents(points.cells()[group.cell].level);

        for (unsigned int k = group.begin; k < group.end; ++k)
          {
            const unsigned int q = groups.point(k);
            kernel.values_and_gradients(
              points.unit_point(q), inverse_h, B.data(), dB.data(), stride);

            Tensor<1, n_components>                  value;
            std::array<Tensor<1, dim>, n_components> gradient;
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int a = 0; a < n_components; ++a)
                {
                  value[a] += coefficients[i][a] * B[i];
                  for (unsigned int d = 0; d < dim; ++d)
                    gradient[a][d] += coefficients[i][a] * dB[d * stride + i];
                }
            visit(q, value, gradient);
          }
      }
  }
} // namespace EBSMPM

#endif
