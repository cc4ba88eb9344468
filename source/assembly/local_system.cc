// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/lanes.h>

#include <ebsmpm/assembly/dense_kernels.h>
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
    short_stride         = padded(n);
    coefficient_rows.resize_fast(dim * short_stride);
    coefficient_rows.fill(0.);
    residual_rows.resize_fast(dim * short_stride);
    tangent_rows.resize(n * BlockRow<dim>::length(n));
    extension_product.initialize(n, m);
  }



  template <int dim>
  void
  LocalSystem<dim>::reinit(const CellPoints<dim>                  &points_,
                           const PointGroups<dim>                 &groups_,
                           const typename PointGroups<dim>::Group &group_)
  {
    go_on(points_, groups_, group_);
    inverse_h =
      space->lattice().inverse_cell_extents(points->cells()[group->cell].level);
    residual_rows.fill(0.);
    tangent_begun = false;
  }



  template <int dim>
  void
  LocalSystem<dim>::go_on(const CellPoints<dim>                  &points_,
                          const PointGroups<dim>                 &groups_,
                          const typename PointGroups<dim>::Group &group_)
  {
    points = &points_;
    groups = &groups_;
    group  = &group_;
  }



  template <int dim>
  void
  LocalSystem<dim>::gather(const LA::FieldVector &increment)
  {
    std::array<Tensor<1, dim>, BSplineKernel<dim>::max_n_functions>
      coefficients;
    gather_coefficients<dim>(*groups, *group, increment, coefficients.data());
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int a = 0; a < dim; ++a)
        coefficient_rows[a * short_stride + i] = coefficients[i][a];
  }



  template <int dim>
  template <int n_rows>
  struct LocalSystem<dim>::Functionals
  {
    template <unsigned int n_bytes>
    static EBSMPM_IN_EACH_TARGET void
    run(const LocalSystem<dim> *local, double *X, const unsigned int stride)
    {
      for (unsigned int k = 0; k < local->n_points(); ++k, X += n_rows * stride)
        local->kernel.template values_and_gradients<n_bytes>(
          local->points->unit_point(local->point(k)),
          local->inverse_h,
          n_rows > dim ? X : nullptr,
          n_rows > dim ? X + stride : X,
          stride);
    }
  };



  template <int dim>
  template <int n_rows>
  void
  LocalSystem<dim>::functionals(double *X, const unsigned int stride) const
  {
    run_best<Functionals<n_rows>>(this, X, stride);
  }



  template <int dim>
  void
  LocalSystem<dim>::distribute_residual(LA::FieldVector &vector) const
  {
    const unsigned int  m = group->n_functions;
    const unsigned int *f = groups->functions(*group);
    const double       *E = groups->extension(*group);

    const auto add = [&](const unsigned int function,
                         const double       factor,
                         const unsigned int i) {
      for (unsigned int a = 0; a < dim; ++a)
        vector.local_element(dim * function + a) +=
          factor * residual_rows[a * short_stride + i];
    };
    if (E == nullptr)
      for (unsigned int i = 0; i < n; ++i)
        add(f[i], 1., i);
    else
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < m; ++j, ++E)
          if (*E != 0.)
            add(f[j], *E, i);
  }



  template <int dim>
  void
  LocalSystem<dim>::distribute_tangent(const unsigned int list,
                                       SystemMatrix      &matrix)
  {
    if (const double *E = groups->extension(*group))
      {
        DenseKernels::complete_symmetric<dim>(n, tangent());
        matrix.add(list,
                   extension_product.compute(E, group->n_functions, tangent()));
      }
    else
      matrix.add(list, tangent());
  }



  template class LocalSystem<2>;
  template class LocalSystem<3>;

  template void
  LocalSystem<2>::functionals<2>(double *, const unsigned int) const;
  template void
  LocalSystem<2>::functionals<3>(double *, const unsigned int) const;
  template void
  LocalSystem<3>::functionals<3>(double *, const unsigned int) const;
  template void
  LocalSystem<3>::functionals<4>(double *, const unsigned int) const;
} // namespace EBSMPM
