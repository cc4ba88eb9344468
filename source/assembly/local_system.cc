// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/field_evaluation.h>
#include <ebsmpm/assembly/local_system.h>

#include <algorithm>

namespace EBSMPM
{
  template <int dim>
  void
  LocalSystem<dim>::initialize(const SplineSpace<dim> &space_,
                               const unsigned int      max_n_functions)
  {
    space  = &space_;
    kernel = BSplineKernel<dim>(space_.degree());
    n      = kernel.n_functions();

    // The unknowns of a group without constraints are the coefficients.
    const unsigned int m = std::max(n, max_n_functions);
    coefficients.resize(n);
    residual.resize(n);
    tangent.resize(dim * dim * n * n);
    half.resize(n * m);
    matrix_of_unknowns.resize(dim * dim * m * m);
  }



  template <int dim>
  void
  LocalSystem<dim>::reinit(const CellPoints<dim>                  &points_,
                           const PointGroups<dim>                 &groups_,
                           const typename PointGroups<dim>::Group &group_)
  {
    points = &points_;
    groups = &groups_;
    group  = &group_;

    inverse_h =
      space->lattice().cell_extents(points->cells()[group->cell].level);
    for (unsigned int d = 0; d < dim; ++d)
      inverse_h[d] = 1. / inverse_h[d];
    std::fill(residual.begin(), residual.end(), Tensor<1, dim>());
  }



  template <int dim>
  void
  LocalSystem<dim>::gather(const LA::FieldVector &increment)
  {
    gather_coefficients<dim>(*groups, *group, increment, coefficients.data());
  }



  template <int dim>
  void
  LocalSystem<dim>::clear_tangent()
  {
    std::fill(tangent.begin(), tangent.end(), 0.);
  }



  template <int dim>
  void
  LocalSystem<dim>::distribute_residual(LA::FieldVector &vector) const
  {
    const unsigned int  m = group->n_functions;
    const unsigned int *f = groups->functions(*group);
    const double       *E = groups->extension(*group);

    for (unsigned int j = 0; j < m; ++j)
      {
        Tensor<1, dim> sum;
        if (E == nullptr)
          sum = residual[j];
        else
          for (unsigned int i = 0; i < n; ++i)
            sum += E[i * m + j] * residual[i];
        for (unsigned int a = 0; a < dim; ++a)
          vector.local_element(dim * f[j] + a) += sum[a];
      }
  }



  template <int dim>
  void
  LocalSystem<dim>::distribute_tangent(const unsigned int list,
                                       SystemMatrix      &matrix)
  {
    const unsigned int m = group->n_functions;
    const double      *E = groups->extension(*group);

    // E^T K E for each pair of components, interleaved on the way out.
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
        {
          const double *K = tangent_block(a, b);
          if (E == nullptr)
            for (unsigned int I = 0; I < n; ++I)
              for (unsigned int J = 0; J < n; ++J)
                matrix_of_unknowns[(dim * I + a) * dim * n + dim * J + b] =
                  K[I * n + J];
          else
            {
              multiply_extension(K, E, m);
              for (unsigned int i = 0; i < m; ++i)
                for (unsigned int j = 0; j < m; ++j)
                  {
                    double sum = 0.;
                    for (unsigned int I = 0; I < n; ++I)
                      sum += E[I * m + i] * half[I * m + j];
                    matrix_of_unknowns[(dim * i + a) * dim * m + dim * j + b] =
                      sum;
                  }
            }
        }
    matrix.add(list, matrix_of_unknowns.data());
  }



  template <int dim>
  void
  LocalSystem<dim>::multiply_extension(const double      *K,
                                       const double      *E,
                                       const unsigned int m)
  {
    std::fill_n(half.begin(), n * m, 0.);
    for (unsigned int I = 0; I < n; ++I)
      for (unsigned int J = 0; J < n; ++J)
        for (unsigned int j = 0; j < m; ++j)
          half[I * m + j] += K[I * n + J] * E[J * m + j];
  }



  template class LocalSystem<2>;
  template class LocalSystem<3>;
} // namespace EBSMPM
