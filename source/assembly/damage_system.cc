// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/bspline_kernel.h>

#include <ebsmpm/assembly/damage_system.h>
#include <ebsmpm/assembly/dense_kernels.h>
#include <ebsmpm/assembly/field_evaluation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace EBSMPM
{
  template <int dim>
  DamageSystem<dim>::DamageSystem(const double fracture_energy,
                                  const double length_scale)
    : Gc(fracture_energy)
    , l(length_scale)
  {}



  template <int dim>
  bool
  DamageSystem<dim>::reinit(const CellPoints<dim>           &points_,
                            const CellPoints<dim>           &boundary_points_,
                            const SplineSpace<dim>          &space,
                            const AffineConstraints<double> &constraints,
                            const std::vector<Pattern>      &patterns,
                            const std::vector<Pattern>      &boundary_patterns)
  {
    bool changed = (spline_space != &space || n_changes != space.n_changes());
    points       = &points_;
    boundary_points = &boundary_points_;
    spline_space    = &space;
    n_changes       = space.n_changes();

    if (changed)
      functions = make_partitioner(space, constraints, 1);
    changed |=
      material_groups.reinit(*points, patterns, space, constraints, *functions);
    changed |= boundary_groups.reinit(
      *boundary_points, boundary_patterns, space, constraints, *functions);
    if (Utilities::MPI::max(changed ? 1U : 0U, space.communicator()) == 0)
      return false;

    std::vector<SystemMatrix::List> lists;
    for (const auto *groups : {&material_groups, &boundary_groups})
      for (const auto &group : groups->groups())
        lists.push_back({groups->functions(group), group.n_functions});
    const bool is_new = system_matrix.reinit(*functions, 1, lists);

    const unsigned int n      = space.n_functions_per_cell();
    const unsigned int m      = std::max({n,
                                          material_groups.max_n_functions(),
                                          boundary_groups.max_n_functions()});
    const unsigned int stride = padded(n);
    X.assign((dim + 1) * std::max(material_groups.max_n_points(), 1U) * stride,
             0.);
    product.resize(n * stride);
    local_vector.resize(n);
    extension_product.initialize(n, m);
    return is_new;
  }



  template <int dim>
  LA::FieldVector
  DamageSystem<dim>::make_vector() const
  {
    return LA::FieldVector(functions);
  }



  template <int dim>
  void
  DamageSystem<dim>::initialize_vector(LA::FieldVector &vector) const
  {
    vector.reinit(functions);
  }



  template <int dim>
  void
  DamageSystem<dim>::assemble(const MaterialState<dim>  &state,
                              const BoundaryState<dim>  &boundary,
                              const std::vector<double> &boundary_driving,
                              LA::FieldVector           &right_hand_side)
  {
    const BSplineKernel<dim> kernel(spline_space->degree());
    const unsigned int       n        = kernel.n_functions();
    const unsigned int       stride   = padded(n);
    constexpr unsigned int   g_stride = BSplineKernel<dim>::max_n_functions + 1;
    std::array<double, g_stride>       B{};
    std::array<double, dim * g_stride> G{};

    right_hand_side.zero_out_ghost_values();
    right_hand_side = 0.;
    system_matrix.begin();

    unsigned int list = 0;
    for (const auto &group : material_groups.groups())
      {
        const Tensor<1, dim> inverse_h =
          spline_space->lattice().inverse_cell_extents(
            points->cells()[group.cell].level);

        std::fill(local_vector.begin(), local_vector.end(), 0.);
        double *x = X.data();
        for (unsigned int k = group.begin; k < group.end; ++k)
          {
            const unsigned int q = material_groups.point(k);
            kernel.values_and_gradients(
              points->unit_point(q), inverse_h, B.data(), G.data(), g_stride);

            const double          V = state.volume[q];
            const double          H = state.history[q];
            const Tensor<2, dim> &F = state.F[q];

            const double root_reaction  = std::sqrt(V * (2. * H + Gc / l));
            const double root_diffusion = std::sqrt(V * Gc * l);
            for (unsigned int i = 0; i < n; ++i)
              {
                x[i] = root_reaction * B[i];
                local_vector[i] += 2. * V * H * B[i];
              }
            x += stride;
            for (unsigned int d = 0; d < dim; ++d, x += stride)
              for (unsigned int i = 0; i < n; ++i)
                {
                  double sum = 0.;
                  for (unsigned int j = 0; j < dim; ++j)
                    sum += F[j][d] * G[j * g_stride + i];
                  x[i] = root_diffusion * sum;
                }
          }
        DenseKernels::symmetric_product<1>((dim + 1) *
                                             (group.end - group.begin),
                                           n,
                                           X.data(),
                                           stride,
                                           X.data(),
                                           product.data());
        distribute(material_groups,
                   group,
                   list++,
                   product.data(),
                   local_vector.data(),
                   right_hand_side);
      }

    if (!boundary_driving.empty())
      for (const auto &group : boundary_groups.groups())
        {
          std::fill(local_vector.begin(), local_vector.end(), 0.);
          std::fill(product.begin(), product.end(), 0.);
          for (unsigned int k = group.begin; k < group.end; ++k)
            {
              const unsigned int q = boundary_groups.point(k);
              kernel.values(boundary_points->unit_point(q), B.data());
              const double weight =
                -2. * boundary.area[q] * boundary_driving[q];
              for (unsigned int i = 0; i < n; ++i)
                {
                  local_vector[i] += weight * B[i];
                  for (unsigned int j = i; j < n; ++j)
                    product[i * stride + j] += weight * B[i] * B[j];
                }
            }
          distribute(boundary_groups,
                     group,
                     list++,
                     product.data(),
                     local_vector.data(),
                     right_hand_side);
        }

    right_hand_side.compress(VectorOperation::add);
    system_matrix.compress();
  }



  template <int dim>
  void
  DamageSystem<dim>::distribute(const PointGroups<dim>                 &groups,
                                const typename PointGroups<dim>::Group &group,
                                const unsigned int                      list,
                                double                                 *matrix,
                                const double                           *vector,
                                LA::FieldVector &right_hand_side)
  {
    const unsigned int  n = groups.n_functions_per_cell();
    const unsigned int  m = group.n_functions;
    const unsigned int *f = groups.functions(group);

    if (const double *E = groups.extension(group))
      {
        for (unsigned int i = 0; i < m; ++i)
          {
            double sum = 0.;
            for (unsigned int I = 0; I < n; ++I)
              sum += E[I * m + i] * vector[I];
            right_hand_side.local_element(f[i]) += sum;
          }
        DenseKernels::complete_symmetric<1>(n, matrix);
        system_matrix.add(list, extension_product.compute(E, m, matrix));
      }
    else
      {
        for (unsigned int i = 0; i < n; ++i)
          right_hand_side.local_element(f[i]) += vector[i];
        system_matrix.add(list, matrix);
      }
  }



  template <int dim>
  const LA::SparseMatrix &
  DamageSystem<dim>::matrix() const
  {
    return system_matrix.matrix();
  }



  template <int dim>
  void
  DamageSystem<dim>::evaluate(const LA::FieldVector &damage,
                              std::vector<double>   &at_points,
                              std::vector<double>   &at_boundary_points) const
  {
    damage.update_ghost_values();
    const auto evaluate_at = [&](const CellPoints<dim>  &cell_points,
                                 const PointGroups<dim> &groups,
                                 std::vector<double>    &values) {
      values.resize(cell_points.n_points());
      evaluate_field<1>(cell_points,
                        groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        damage,
                        [&](const unsigned int  q,
                            const Tensor<1, 1> &value,
                            const std::array<Tensor<1, dim>, 1> &) {
                          values[q] = value[0];
                        });
    };
    evaluate_at(*points, material_groups, at_points);
    evaluate_at(*boundary_points, boundary_groups, at_boundary_points);
  }



  template <int dim>
  double
  DamageSystem<dim>::crack_area(const MaterialState<dim> &state,
                                const LA::FieldVector    &damage) const
  {
    damage.update_ghost_values();
    double area = 0.;
    evaluate_field<1>(*points,
                      material_groups,
                      spline_space->lattice(),
                      spline_space->degree(),
                      damage,
                      [&](const unsigned int                   q,
                          const Tensor<1, 1>                  &d,
                          const std::array<Tensor<1, dim>, 1> &gradient) {
                        const Tensor<1, dim> reference_gradient =
                          transpose(state.F[q]) * gradient[0];
                        area += state.volume[q] *
                                (d[0] * d[0] +
                                 l * l * reference_gradient.norm_square()) /
                                (2. * l);
                      });
    return Utilities::MPI::sum(area, spline_space->communicator());
  }



  template <int dim>
  double
  DamageSystem<dim>::fracture_energy() const
  {
    return Gc;
  }



  template <int dim>
  double
  DamageSystem<dim>::length_scale() const
  {
    return l;
  }



  template <int dim>
  const SplineSpace<dim> &
  DamageSystem<dim>::space() const
  {
    return *spline_space;
  }



  template class DamageSystem<2>;
  template class DamageSystem<3>;
} // namespace EBSMPM
