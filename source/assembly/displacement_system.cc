// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/dense_kernels.h>
#include <ebsmpm/assembly/displacement_system.h>
#include <ebsmpm/assembly/field_evaluation.h>
#include <ebsmpm/base/exceptions.h>
#include <ebsmpm/splines/bspline_kernel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>

namespace EBSMPM
{
  namespace internal
  {
    namespace DisplacementSystemImplementation
    {
      /** $(\mathbf I+\nabla_n\Delta\mathbf u)\mathbf F_n$. */
      template <int dim>
      inline Tensor<2, dim>
      deformation(const std::array<Tensor<1, dim>, dim> &gradient,
                  const Tensor<2, dim> &                 F_n)
      {
        Tensor<2, dim> F = F_n;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int k = 0; k < dim; ++k)
              F[i][k] += gradient[i][j] * F_n[j][k];
        return F;
      }



      /** The branch that a point is held on, if any is. */
      inline EnergyBranch
      branch_of(const std::vector<EnergyBranch> &branches, const unsigned int q)
      {
        return branches.empty() ? EnergyBranch::by_state : branches[q];
      }



      /** The unmet part of the Dirichlet condition, in prescribed components. */
      template <int dim>
      inline Tensor<1, dim>
      mismatch(const BoundaryState<dim> &boundary,
               const unsigned int        q,
               const Tensor<1, dim> &    increment)
      {
        Tensor<1, dim> w;
        for (unsigned int i = 0; i < dim; ++i)
          if (boundary.constrained[q][i])
            w[i] = boundary.displacement[q][i] + increment[i] -
                   boundary.prescribed[q][i];
        return w;
      }
    } // namespace DisplacementSystemImplementation
  }   // namespace internal

  using namespace internal::DisplacementSystemImplementation;



  template <int dim>
  DisplacementSystem<dim>::DisplacementSystem(const Material<dim> &material,
                                              const Degradation &  degradation,
                                              const double         penalty)
    : material(material)
    , degradation(degradation)
    , beta(penalty)
  {}



  template <int dim>
  bool
  DisplacementSystem<dim>::reinit(
    const CellPoints<dim> &          points_,
    const CellPoints<dim> &          boundary_points_,
    const SplineSpace<dim> &         space,
    const AffineConstraints<double> &constraints,
    const std::vector<Pattern> &     patterns,
    const std::vector<Pattern> &     boundary_patterns)
  {
    points          = &points_;
    boundary_points = &boundary_points_;
    spline_space    = &space;
    release_branches();

    functions = make_partitioner(space, constraints, 1);
    unknowns  = make_partitioner(space, constraints, dim);
    material_groups.reinit(*points, patterns, space, constraints, *functions);
    boundary_groups.reinit(
      *boundary_points, boundary_patterns, space, constraints, *functions);

    std::vector<SystemMatrix::List> lists;
    for (const auto *groups : {&material_groups, &boundary_groups})
      for (const auto &group : groups->groups())
        lists.push_back({groups->functions(group), group.n_functions});
    const bool is_new = tangent.reinit(*functions, dim, lists);

    const unsigned int n = space.n_functions_per_cell();
    const unsigned int m =
      std::max({n,
                material_groups.max_n_functions(),
                boundary_groups.max_n_functions()});
    const unsigned int n_pairs = dim * (dim + 1) / 2;
    const unsigned int n_points =
      std::max(material_groups.max_n_points(), 1U);
    scratch.coefficients.resize(n);
    scratch.B.resize(n);
    scratch.G.resize(dim * n_points * n);
    scratch.CG.assign(dim * n_points * DenseKernels::padded(n_pairs * n), 0.);
    scratch.product.resize(n * DenseKernels::padded(n_pairs * n));
    scratch.residual.resize(m);
    scratch.matrix.resize(dim * dim * m * m);
    scratch.pair.resize(dim * dim * n * n);
    scratch.half.resize(n * m);
    return is_new;
  }



  template <int dim>
  LA::FieldVector
  DisplacementSystem<dim>::make_vector() const
  {
    return LA::FieldVector(unknowns);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::initialize_vector(LA::FieldVector &vector) const
  {
    vector.reinit(unknowns);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::hold_branches(const MaterialState<dim> &state,
                                         const BoundaryState<dim> &boundary,
                                         const LA::FieldVector &   increment)
  {
    increment.update_ghost_values();
    const auto hold = [&](const CellPoints<dim> &            cell_points,
                          const PointGroups<dim> &           groups,
                          const std::vector<Tensor<2, dim>> &F_n,
                          std::vector<EnergyBranch> &        result) {
      result.resize(cell_points.n_points());
      evaluate_field<dim>(cell_points,
                          groups,
                          spline_space->lattice(),
                          spline_space->degree(),
                          increment,
                          [&](const unsigned int q,
                              const Tensor<1, dim> &,
                              const std::array<Tensor<1, dim>, dim> &gradient) {
                            result[q] = material.branch(
                              deformation<dim>(gradient, F_n[q]));
                          });
    };
    hold(*points, material_groups, state.F, branches);
    hold(*boundary_points, boundary_groups, boundary.F, boundary_branches);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::release_branches()
  {
    branches.clear();
    boundary_branches.clear();
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble_residual(const MaterialState<dim> &state,
                                             const BoundaryState<dim> &boundary,
                                             const LA::FieldVector &increment,
                                             LA::FieldVector &residual) const
  {
    assemble(Task::residual, state, boundary, increment, residual, nullptr);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble_tangent(const MaterialState<dim> &state,
                                            const BoundaryState<dim> &boundary,
                                            const LA::FieldVector &   increment,
                                            LA::FieldVector &         residual)
  {
    tangent.set_zero();
    assemble(Task::tangent, state, boundary, increment, residual, &tangent);
    tangent.compress();
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble_predictor(
    const MaterialState<dim> &state,
    const BoundaryState<dim> &boundary,
    const LA::FieldVector &   increment,
    LA::FieldVector &         residual)
  {
    tangent.set_zero();
    assemble(Task::predictor, state, boundary, increment, residual, &tangent);
    tangent.compress();
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble(const Task                task,
                                    const MaterialState<dim> &state,
                                    const BoundaryState<dim> &boundary,
                                    const LA::FieldVector &   increment,
                                    LA::FieldVector &         residual,
                                    SystemMatrix *            matrix) const
  {
    increment.update_ghost_values();
    residual = 0.;

    // A state that is impossible at a point of one process (turned inside out,
    // say) is an error on all of them.
    std::string failure;
    try
      {
        unsigned int list = 0;
        for (const auto &group : material_groups.groups())
          {
            gather_coefficients<dim>(material_groups,
                                     group,
                                     increment,
                                     scratch.coefficients.data());
            material_group(task, group, state);
            distribute(task, material_groups, group, list++, residual, matrix);
          }
        for (const auto &group : boundary_groups.groups())
          {
            gather_coefficients<dim>(boundary_groups,
                                     group,
                                     increment,
                                     scratch.coefficients.data());
            boundary_group(task, group, boundary);
            distribute(task, boundary_groups, group, list++, residual, matrix);
          }
      }
    catch (const ExcSolverFailure &exception)
      {
        std::ostringstream message;
        exception.print_info(message);
        failure = message.str();
      }
    const bool failed_anywhere =
      Utilities::MPI::max(failure.empty() ? 0U : 1U,
                          spline_space->communicator()) > 0;
    if (failed_anywhere)
      {
        if (matrix != nullptr)
          matrix->compress();
        residual.compress(VectorOperation::add);
        AssertThrow(false,
                    ExcSolverFailure(
                      failure.empty() ?
                        "A material point on another process failed." :
                        failure));
      }
    residual.compress(VectorOperation::add);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::material_group(
    const Task                              task,
    const typename PointGroups<dim>::Group &group,
    const MaterialState<dim> &              state) const
  {
    constexpr unsigned int   n_pairs = dim * (dim + 1) / 2;
    const BSplineKernel<dim> kernel(spline_space->degree());
    const unsigned int       n      = kernel.n_functions();
    const unsigned int       stride = DenseKernels::padded(n_pairs * n);
    const Tensor<1, dim>     inverse_h = inverse_extents(*points, group.cell);

    std::fill_n(scratch.residual.begin(), n, Tensor<1, dim>());

    typename Material<dim>::Response response;
    double *                         G  = scratch.G.data();
    double *                         CG = scratch.CG.data();
    for (unsigned int k = group.begin; k < group.end;
         ++k, G += dim * n, CG += dim * stride)
      {
        const unsigned int q = material_groups.point(k);
        kernel.values_and_gradients(
          points->unit_point(q), inverse_h, scratch.B.data(), G, n);

        std::array<Tensor<1, dim>, dim> gradient;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              gradient[a][d] += scratch.coefficients[i][a] * G[d * n + i];

        const Tensor<2, dim> &F_n = state.F[q];
        const Tensor<2, dim>  F   = deformation<dim>(gradient, F_n);
        const double          V   = state.volume[q];
        const double          g   = degradation.value(state.damage[q]);
        const EnergyBranch    branch = branch_of(branches, q);
        if (task == Task::residual)
          material.stress(F, g, response.P, branch);
        else
          material.response(F, g, response, branch);

        const Tensor<2, dim> stress = V * response.P * transpose(F_n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              scratch.residual[i][a] += stress[a][d] * G[d * n + i];

        if (task == Task::residual)
          continue;

        // c_{ijkl} = V F_{jB} A_{iBkD} F_{lD}, for i<=k only, times G.
        for (unsigned int i = 0, pair = 0; i < dim; ++i)
          for (unsigned int kk = i; kk < dim; ++kk, ++pair)
            {
              Tensor<2, dim> A;
              for (unsigned int b = 0; b < dim; ++b)
                for (unsigned int d = 0; d < dim; ++d)
                  A[b][d] = V * response.A[i][b][kk][d];
              const Tensor<2, dim> c = F_n * A * transpose(F_n);
              for (unsigned int j = 0; j < dim; ++j)
                {
                  double *row = CG + j * stride + pair * n;
                  for (unsigned int J = 0; J < n; ++J)
                    {
                      double sum = c[j][0] * G[J];
                      for (unsigned int l = 1; l < dim; ++l)
                        sum += c[j][l] * G[l * n + J];
                      row[J] = sum;
                    }
                }
            }
      }

    if (task == Task::residual)
      return;

    DenseKernels::transposed_product(dim * (group.end - group.begin),
                                     n,
                                     stride,
                                     scratch.G.data(),
                                     n,
                                     scratch.CG.data(),
                                     scratch.product.data());

    // Unfold into a matrix per pair of components, the lower ones by symmetry.
    for (unsigned int i = 0, pair = 0; i < dim; ++i)
      for (unsigned int k = i; k < dim; ++k, ++pair)
        for (unsigned int I = 0; I < n; ++I)
          for (unsigned int J = 0; J < n; ++J)
            {
              const double value = scratch.product[I * stride + pair * n + J];
              scratch.pair[((i * dim + k) * n + I) * n + J] = value;
              if (k != i)
                scratch.pair[((k * dim + i) * n + J) * n + I] = value;
            }
  }



  template <int dim>
  void
  DisplacementSystem<dim>::boundary_group(
    const Task                              task,
    const typename PointGroups<dim>::Group &group,
    const BoundaryState<dim> &              boundary) const
  {
    const BSplineKernel<dim> kernel(spline_space->degree());
    const unsigned int       n = kernel.n_functions();
    const Tensor<1, dim>     inverse_h =
      inverse_extents(*boundary_points, group.cell);

    std::fill_n(scratch.residual.begin(), n, Tensor<1, dim>());
    std::fill_n(scratch.pair.begin(), dim * dim * n * n, 0.);

    std::array<double, BSplineKernel<dim>::max_n_functions>       B;
    std::array<double, dim * BSplineKernel<dim>::max_n_functions> G;
    std::array<Tensor<1, dim>, BSplineKernel<dim>::max_n_functions> traction;
    typename Material<dim>::Response                                response;

    for (unsigned int k = group.begin; k < group.end; ++k)
      {
        const unsigned int q = boundary_groups.point(k);
        kernel.values_and_gradients(
          boundary_points->unit_point(q), inverse_h, B.data(), G.data(), n);

        Tensor<1, dim>                  value;
        std::array<Tensor<1, dim>, dim> gradient;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int a = 0; a < dim; ++a)
            {
              value[a] += scratch.coefficients[i][a] * B[i];
              for (unsigned int d = 0; d < dim; ++d)
                gradient[a][d] += scratch.coefficients[i][a] * G[d * n + i];
            }

        const Tensor<2, dim> &F_n = boundary.F[q];
        const Tensor<2, dim>  F   = deformation<dim>(gradient, F_n);
        const double          g   = degradation.value(boundary.damage[q]);
        const Tensor<1, dim> &N   = boundary.normal[q];
        const double          A0  = boundary.area[q];
        const Tensor<1, dim>  w   = mismatch(boundary, q, value);
        material.response(F,
                          g,
                          response,
                          branch_of(boundary_branches, q));
        const Tensor<1, dim> PN = response.P * N;

        Tensor<2, dim> S;
        for (unsigned int i = 0; i < dim; ++i)
          if (boundary.constrained[q][i])
            {
              // The traction in direction i due to function J, component k:
              // (A : grad_X)_i N = N_B A_{iBkD} F_{lD} dB_J/dx_l.
              Tensor<2, dim> NA;
              for (unsigned int b = 0; b < dim; ++b)
                for (unsigned int kk = 0; kk < dim; ++kk)
                  for (unsigned int d = 0; d < dim; ++d)
                    NA[kk][d] += N[b] * response.A[i][b][kk][d];
              NA = NA * transpose(F_n);
              S += w[i] * NA;

              for (unsigned int J = 0; J < n; ++J)
                {
                  traction[J] = Tensor<1, dim>();
                  for (unsigned int kk = 0; kk < dim; ++kk)
                    for (unsigned int l = 0; l < dim; ++l)
                      traction[J][kk] += NA[kk][l] * G[l * n + J];
                  scratch.residual[J][i] += A0 * B[J] * (beta * w[i] - PN[i]);
                }

              if (task != Task::residual)
                for (unsigned int I = 0; I < n; ++I)
                  for (unsigned int J = 0; J < n; ++J)
                    {
                      scratch.pair[((i * dim + i) * n + I) * n + J] +=
                        A0 * beta * B[I] * B[J];
                      for (unsigned int kk = 0; kk < dim; ++kk)
                        {
                          scratch.pair[((i * dim + kk) * n + I) * n + J] -=
                            A0 * B[I] * traction[J][kk];
                          scratch.pair[((kk * dim + i) * n + J) * n + I] -=
                            A0 * B[I] * traction[J][kk];
                        }
                    }
            }

        for (unsigned int I = 0; I < n; ++I)
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int l = 0; l < dim; ++l)
              scratch.residual[I][a] -= A0 * S[a][l] * G[l * n + I];

        // The derivative of A in the last term of the residual.
        if (task == Task::tangent && w.norm_square() > 0.)
          {
            const Tensor<4, dim> dA =
              material.tangent_derivative(F, g, outer_product(w, N));
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int kk = 0; kk < dim; ++kk)
                {
                  Tensor<2, dim> c;
                  for (unsigned int b = 0; b < dim; ++b)
                    for (unsigned int d = 0; d < dim; ++d)
                      c[b][d] = A0 * dA[i][b][kk][d];
                  c = F_n * c * transpose(F_n);
                  for (unsigned int I = 0; I < n; ++I)
                    for (unsigned int J = 0; J < n; ++J)
                      for (unsigned int j = 0; j < dim; ++j)
                        for (unsigned int l = 0; l < dim; ++l)
                          scratch.pair[((i * dim + kk) * n + I) * n + J] -=
                            G[j * n + I] * c[j][l] * G[l * n + J];
                }
          }
      }
  }



  template <int dim>
  void
  DisplacementSystem<dim>::distribute(
    const Task                              task,
    const PointGroups<dim> &                groups,
    const typename PointGroups<dim>::Group &group,
    const unsigned int                      list,
    LA::FieldVector &                       residual,
    SystemMatrix *                          matrix) const
  {
    const unsigned int  n = groups.n_functions_per_cell();
    const unsigned int  m = group.n_functions;
    const unsigned int *f = groups.functions(group);
    const double *      E = groups.extension(group);

    for (unsigned int j = 0; j < m; ++j)
      {
        Tensor<1, dim> sum;
        if (E == nullptr)
          sum = scratch.residual[j];
        else
          for (unsigned int i = 0; i < n; ++i)
            sum += E[i * m + j] * scratch.residual[i];
        for (unsigned int a = 0; a < dim; ++a)
          residual.local_element(dim * f[j] + a) += sum[a];
      }

    if (task == Task::residual)
      return;

    // E^T K E for each pair of components, interleaved on the way out.
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
        {
          const double *K = scratch.pair.data() + (a * dim + b) * n * n;
          if (E == nullptr)
            for (unsigned int I = 0; I < n; ++I)
              for (unsigned int J = 0; J < n; ++J)
                scratch.matrix[(dim * I + a) * dim * n + dim * J + b] =
                  K[I * n + J];
          else
            {
              std::fill_n(scratch.half.begin(), n * m, 0.);
              for (unsigned int I = 0; I < n; ++I)
                for (unsigned int J = 0; J < n; ++J)
                  for (unsigned int j = 0; j < m; ++j)
                    scratch.half[I * m + j] += K[I * n + J] * E[J * m + j];
              for (unsigned int i = 0; i < m; ++i)
                for (unsigned int j = 0; j < m; ++j)
                  {
                    double sum = 0.;
                    for (unsigned int I = 0; I < n; ++I)
                      sum += E[I * m + i] * scratch.half[I * m + j];
                    scratch.matrix[(dim * i + a) * dim * m + dim * j + b] = sum;
                  }
            }
        }
    matrix->add(list, scratch.matrix.data());
  }



  template <int dim>
  void
  DisplacementSystem<dim>::add_body_force(const MaterialState<dim> &    state,
                                          const TensorFunction<1, dim> &force,
                                          LA::FieldVector &residual) const
  {
    const BSplineKernel<dim> kernel(spline_space->degree());
    const unsigned int       n = kernel.n_functions();
    for (const auto &group : material_groups.groups())
      {
        std::fill_n(scratch.residual.begin(), n, Tensor<1, dim>());
        for (unsigned int k = group.begin; k < group.end; ++k)
          {
            const unsigned int q = material_groups.point(k);
            kernel.values(points->unit_point(q), scratch.B.data());
            const Tensor<1, dim> f =
              state.volume[q] * force.value(points->location(q));
            for (unsigned int i = 0; i < n; ++i)
              scratch.residual[i] -= scratch.B[i] * f;
          }
        distribute(
          Task::residual, material_groups, group, 0, residual, nullptr);
      }
    residual.compress(VectorOperation::add);
  }



  template <int dim>
  const LA::SparseMatrix &
  DisplacementSystem<dim>::matrix() const
  {
    return tangent.matrix();
  }



  template <int dim>
  void
  DisplacementSystem<dim>::driving_energy(
    const MaterialState<dim> &state,
    const LA::FieldVector &   increment,
    std::vector<double> &     psi_degraded) const
  {
    increment.update_ghost_values();
    psi_degraded.resize(points->n_points());
    evaluate_field<dim>(*points,
                        material_groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int q,
                            const Tensor<1, dim> &,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          double psi_intact;
                          material.energies(deformation<dim>(gradient,
                                                             state.F[q]),
                                            psi_degraded[q],
                                            psi_intact);
                        });
  }



  template <int dim>
  typename DisplacementSystem<dim>::Energies
  DisplacementSystem<dim>::energies(const MaterialState<dim> &state,
                                    const BoundaryState<dim> &boundary,
                                    const LA::FieldVector &   increment) const
  {
    increment.update_ghost_values();
    Energies result;
    evaluate_field<dim>(*points,
                        material_groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int q,
                            const Tensor<1, dim> &,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          double psi_degraded, psi_intact;
                          material.energies(deformation<dim>(gradient,
                                                             state.F[q]),
                                            psi_degraded,
                                            psi_intact);
                          result.elastic +=
                            state.volume[q] *
                            (degradation.value(state.damage[q]) * psi_degraded +
                             psi_intact);
                        });
    evaluate_field<dim>(*boundary_points,
                        boundary_groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int                     q,
                            const Tensor<1, dim> &                 value,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          Tensor<2, dim> P;
                          material.stress(deformation<dim>(gradient,
                                                           boundary.F[q]),
                                          degradation.value(boundary.damage[q]),
                                          P);
                          const auto w = mismatch(boundary, q, value);
                          result.penalty +=
                            boundary.area[q] *
                            (0.5 * beta * w.norm_square() -
                             w * (P * boundary.normal[q]));
                        });
    const MPI_Comm &comm = spline_space->communicator();
    result.elastic       = Utilities::MPI::sum(result.elastic, comm);
    result.penalty       = Utilities::MPI::sum(result.penalty, comm);
    return result;
  }



  template <int dim>
  std::map<types::boundary_id, Tensor<1, dim>>
  DisplacementSystem<dim>::reactions(
    const MaterialState<dim> &,
    const BoundaryState<dim> &             boundary,
    const LA::FieldVector &                increment,
    const std::vector<types::boundary_id> &ids) const
  {
    increment.update_ghost_values();
    std::map<types::boundary_id, Tensor<1, dim>> result;
    for (const auto id : ids)
      result[id] = Tensor<1, dim>();
    evaluate_field<dim>(*boundary_points,
                        boundary_groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int                     q,
                            const Tensor<1, dim> &                 value,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          Tensor<2, dim> P;
                          material.stress(deformation<dim>(gradient,
                                                           boundary.F[q]),
                                          degradation.value(boundary.damage[q]),
                                          P,
                                          branch_of(boundary_branches, q));
                          const auto w    = mismatch(boundary, q, value);
                          const auto flux = boundary.area[q] *
                                            (P * boundary.normal[q] - beta * w);
                          auto &sum = result.at(boundary.boundary_id[q]);
                          for (unsigned int i = 0; i < dim; ++i)
                            if (boundary.constrained[q][i])
                              sum[i] += flux[i];
                        });
    for (auto &entry : result)
      entry.second =
        Utilities::MPI::sum(entry.second, spline_space->communicator());
    return result;
  }



  template <int dim>
  typename DisplacementSystem<dim>::Update
  DisplacementSystem<dim>::update_points(const MaterialState<dim> &state,
                                         const LA::FieldVector &increment) const
  {
    increment.update_ghost_values();
    Update update;
    update.displacement_increment.resize(points->n_points());
    update.F.resize(points->n_points());
    evaluate_field<dim>(*points,
                        material_groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int                     q,
                            const Tensor<1, dim> &                 value,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          update.displacement_increment[q] = value;
                          update.F[q] =
                            deformation<dim>(gradient, state.F[q]);
                        });
    return update;
  }



  template <int dim>
  typename DisplacementSystem<dim>::Update
  DisplacementSystem<dim>::update_points(const BoundaryState<dim> &boundary,
                                         const LA::FieldVector &increment) const
  {
    increment.update_ghost_values();
    Update update;
    update.displacement_increment.resize(boundary_points->n_points());
    update.F.resize(boundary_points->n_points());
    evaluate_field<dim>(*boundary_points,
                        boundary_groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int                     q,
                            const Tensor<1, dim> &                 value,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          update.displacement_increment[q] = value;
                          update.F[q] =
                            deformation<dim>(gradient, boundary.F[q]);
                        });
    return update;
  }



  template <int dim>
  void
  DisplacementSystem<dim>::boundary_driving(const BoundaryState<dim> &boundary,
                                            const LA::FieldVector &   increment,
                                            std::vector<double> &driving) const
  {
    increment.update_ghost_values();
    driving.resize(boundary_points->n_points());
    evaluate_field<dim>(*boundary_points,
                        boundary_groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int                     q,
                            const Tensor<1, dim> &                 value,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          const Tensor<2, dim> P =
                            material.degraded_stress(
                              deformation<dim>(gradient, boundary.F[q]));
                          driving[q] = mismatch(boundary, q, value) *
                                       (P * boundary.normal[q]);
                        });
  }



  template <int dim>
  const std::shared_ptr<const Utilities::MPI::Partitioner> &
  DisplacementSystem<dim>::partitioner() const
  {
    return unknowns;
  }



  template <int dim>
  const SplineSpace<dim> &
  DisplacementSystem<dim>::space() const
  {
    return *spline_space;
  }



  template <int dim>
  const PointGroups<dim> &
  DisplacementSystem<dim>::groups() const
  {
    return material_groups;
  }



  template <int dim>
  double
  DisplacementSystem<dim>::penalty() const
  {
    return beta;
  }



  template <int dim>
  Tensor<1, dim>
  DisplacementSystem<dim>::inverse_extents(const CellPoints<dim> &points,
                                           const unsigned int     cell) const
  {
    Tensor<1, dim> result =
      spline_space->lattice().cell_extents(points.cells()[cell].level);
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = 1. / result[d];
    return result;
  }



  template class DisplacementSystem<2>;
  template class DisplacementSystem<3>;
} // namespace EBSMPM
