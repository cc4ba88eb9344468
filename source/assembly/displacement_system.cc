// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/splines/bspline_kernel.h>

#include <ebsmpm/assembly/displacement_system.h>
#include <ebsmpm/assembly/field_evaluation.h>
#include <ebsmpm/assembly/point_values.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>

namespace EBSMPM
{
  template <int dim>
  DisplacementSystem<dim>::DisplacementSystem(const Material<dim> &material,
                                              const Degradation   &degradation,
                                              const double         penalty)
    : material(material)
    , degradation(degradation)
    , beta(penalty)
    , elastic_terms(material, degradation)
    , nitsche_terms(material, degradation, penalty)
  {}



  template <int dim>
  bool
  DisplacementSystem<dim>::reinit(const CellPoints<dim>  &points_,
                                  const CellPoints<dim>  &boundary_points_,
                                  const SplineSpace<dim> &space,
                                  const AffineConstraints<double> &constraints,
                                  const std::vector<Pattern>      &patterns,
                                  const std::vector<Pattern> &boundary_patterns)
  {
    bool changed = (spline_space != &space || n_changes != space.n_changes());
    points       = &points_;
    boundary_points = &boundary_points_;
    spline_space    = &space;
    n_changes       = space.n_changes();
    release_branches();

    if (changed)
      {
        functions = make_partitioner(space, constraints, 1);
        unknowns  = make_partitioner(space, constraints, dim);
      }
    changed |=
      material_groups.reinit(*points, patterns, space, constraints, *functions);
    changed |= boundary_groups.reinit(
      *boundary_points, boundary_patterns, space, constraints, *functions);
    if (Utilities::MPI::max(changed ? 1U : 0U, space.communicator()) == 0)
      return false;
    connected_pieces.clear();

    // Boundary points mostly read the same functions as material points of the
    // same cell, and add to the same local system.
    partners = find_partners(*points,
                             material_groups,
                             *boundary_points,
                             boundary_groups);
    std::vector<bool> has_partner(boundary_groups.groups().size(), false);
    for (const unsigned int partner : partners)
      if (partner != numbers::invalid_unsigned_int)
        has_partner[partner] = true;

    std::vector<SystemMatrix::List> lists;
    for (const auto &group : material_groups.groups())
      lists.push_back({material_groups.functions(group), group.n_functions});
    lone_boundary_groups.clear();
    for (unsigned int b = 0; b < has_partner.size(); ++b)
      if (!has_partner[b])
        {
          const auto &group = boundary_groups.groups()[b];
          lone_boundary_groups.push_back(b);
          lists.push_back(
            {boundary_groups.functions(group), group.n_functions});
        }
    const bool is_new = tangent.reinit(*functions, dim, lists);

    local.initialize(space,
                     std::max(material_groups.max_n_functions(),
                              boundary_groups.max_n_functions()));
    elastic_terms.initialize(space.n_functions_per_cell(),
                             material_groups.max_n_points());
    nitsche_terms.initialize(space.n_functions_per_cell(),
                             boundary_groups.max_n_points());
    return is_new;
  }



  template <int dim>
  void
  DisplacementSystem<dim>::hold_free_pieces(const MaterialState<dim> &state,
                                            const BoundaryState<dim> &boundary)
  {
    if (!connected_pieces.pieces().empty())
      return;
    connected_pieces.reinit(*points,
                            state.volume,
                            material_groups,
                            *boundary_points,
                            boundary,
                            boundary_groups,
                            functions);
  }



  template <int dim>
  const ConnectedPieces<dim> &
  DisplacementSystem<dim>::pieces() const
  {
    return connected_pieces;
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
                                         const LA::FieldVector    &increment)
  {
    increment.update_ghost_values();
    branches.resize(points->n_points());
    evaluate_material(state,
                      increment,
                      [&](const unsigned int q,
                          const Tensor<1, dim> &,
                          const Tensor<2, dim> &F) {
                        branches[q] = material.branch(F);
                      });
    boundary_branches.resize(boundary_points->n_points());
    evaluate_boundary(boundary,
                      increment,
                      [&](const unsigned int q,
                          const Tensor<1, dim> &,
                          const Tensor<2, dim> &F) {
                        boundary_branches[q] = material.branch(F);
                      });
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
    assemble(
      AssemblyTask::residual, state, boundary, increment, residual, nullptr);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble_tangent(const MaterialState<dim> &state,
                                            const BoundaryState<dim> &boundary,
                                            const LA::FieldVector    &increment,
                                            LA::FieldVector          &residual)
  {
    tangent.begin();
    assemble(
      AssemblyTask::tangent, state, boundary, increment, residual, &tangent);
    tangent.compress();
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble_predictor(
    const MaterialState<dim> &state,
    const BoundaryState<dim> &boundary,
    const LA::FieldVector    &increment,
    LA::FieldVector          &residual)
  {
    tangent.begin();
    assemble(
      AssemblyTask::predictor, state, boundary, increment, residual, &tangent);
    tangent.compress();
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble(const AssemblyTask        task,
                                    const MaterialState<dim> &state,
                                    const BoundaryState<dim> &boundary,
                                    const LA::FieldVector    &increment,
                                    LA::FieldVector          &residual,
                                    SystemMatrix             *matrix) const
  {
    increment.update_ghost_values();
    residual = 0.;

    // A state that is impossible at a point of one process (turned inside out,
    // say) is an error on all of them.
    std::string failure;
    try
      {
        add_groups(task, state, boundary, increment, residual, matrix);
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
  DisplacementSystem<dim>::add_groups(const AssemblyTask        task,
                                      const MaterialState<dim> &state,
                                      const BoundaryState<dim> &boundary,
                                      const LA::FieldVector    &increment,
                                      LA::FieldVector          &residual,
                                      SystemMatrix             *matrix) const
  {
    unsigned int list       = 0;
    const auto   distribute = [&]() {
      local.distribute_residual(residual);
      if (task != AssemblyTask::residual)
        local.distribute_tangent(list++, *matrix);
    };

    for (unsigned int g = 0; g < material_groups.groups().size(); ++g)
      {
        local.reinit(*points, material_groups, material_groups.groups()[g]);
        local.gather(increment);
        elastic_terms.compute(task, state, branches, local);
        if (connected_pieces.is_free(g))
          add_mass(task, state);
        if (partners[g] != numbers::invalid_unsigned_int)
          {
            local.go_on(*boundary_points,
                        boundary_groups,
                        boundary_groups.groups()[partners[g]]);
            nitsche_terms.compute(task, boundary, boundary_branches, local);
          }
        distribute();
      }
    for (const unsigned int b : lone_boundary_groups)
      {
        local.reinit(*boundary_points,
                     boundary_groups,
                     boundary_groups.groups()[b]);
        local.gather(increment);
        nitsche_terms.compute(task, boundary, boundary_branches, local);
        distribute();
      }
  }



  template <int dim>
  void
  DisplacementSystem<dim>::add_mass(const AssemblyTask        task,
                                    const MaterialState<dim> &state) const
  {
    const unsigned int n       = local.n_functions();
    const double       density = 1e-6 * material.nitsche_stiffness() /
                           Utilities::fixed_power<2>(local.cell_extent());
    std::array<double, BSplineKernel<dim>::max_n_functions> B;
    for (unsigned int k = 0; k < local.n_points(); ++k)
      {
        local.values(k, B.data());
        const Tensor<1, dim> increment = local.value(B.data());
        const double         mass      = density * state.volume[local.point(k)];
        for (unsigned int i = 0; i < n; ++i)
          local.residual[i] += mass * B[i] * increment;
        if (task != AssemblyTask::residual)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = i; j < n; ++j)
              for (unsigned int a = 0; a < dim; ++a)
                local.tangent()[i * local.tangent_stride() +
                                (j * dim + a) * dim + a] += mass * B[i] * B[j];
      }
  }



  template <int dim>
  void
  DisplacementSystem<dim>::add_body_force(const MaterialState<dim>     &state,
                                          const TensorFunction<1, dim> &force,
                                          LA::FieldVector &residual) const
  {
    std::array<double, BSplineKernel<dim>::max_n_functions> B;
    for (const auto &group : material_groups.groups())
      {
        local.reinit(*points, material_groups, group);
        for (unsigned int k = 0; k < local.n_points(); ++k)
          {
            const unsigned int q = local.point(k);
            local.values(k, B.data());
            const Tensor<1, dim> f =
              state.volume[q] * force.value(points->location(q));
            for (unsigned int i = 0; i < local.n_functions(); ++i)
              local.residual[i] -= B[i] * f;
          }
        local.distribute_residual(residual);
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
    const Update        &update,
    std::vector<double> &psi_degraded) const
  {
    psi_degraded.resize(update.F.size());
    double psi_intact;
    for (unsigned int q = 0; q < update.F.size(); ++q)
      material.energies(update.F[q], psi_degraded[q], psi_intact);
  }



  template <int dim>
  typename DisplacementSystem<dim>::Energies
  DisplacementSystem<dim>::energies(const MaterialState<dim> &state,
                                    const BoundaryState<dim> &boundary,
                                    const LA::FieldVector    &increment) const
  {
    increment.update_ghost_values();
    Energies result;
    evaluate_material(state,
                      increment,
                      [&](const unsigned int q,
                          const Tensor<1, dim> &,
                          const Tensor<2, dim> &F) {
                        const double g = degradation.value(state.damage[q]);
                        double       psi_degraded, psi_intact;
                        material.energies(F, psi_degraded, psi_intact);
                        result.elastic +=
                          state.volume[q] * (g * psi_degraded + psi_intact);
                      });
    evaluate_boundary(boundary,
                      increment,
                      [&](const unsigned int    q,
                          const Tensor<1, dim> &value,
                          const Tensor<2, dim> &F) {
                        const double g = degradation.value(boundary.damage[q]);
                        Tensor<2, dim> P;
                        material.stress(F, g, P);
                        const auto w = mismatch(boundary, q, value);
                        result.penalty +=
                          boundary.area[q] * (0.5 * beta * w.norm_square() -
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
    const BoundaryState<dim>              &boundary,
    const LA::FieldVector                 &increment,
    const std::vector<types::boundary_id> &ids) const
  {
    increment.update_ghost_values();
    std::map<types::boundary_id, Tensor<1, dim>> result;
    for (const auto id : ids)
      result[id] = Tensor<1, dim>();
    evaluate_boundary(
      boundary,
      increment,
      [&](const unsigned int    q,
          const Tensor<1, dim> &value,
          const Tensor<2, dim> &F) {
        const double   g = degradation.value(boundary.damage[q]);
        Tensor<2, dim> P;
        material.stress(F, g, P, branch_of(boundary_branches, q));
        const auto w = mismatch(boundary, q, value);
        const auto flux =
          boundary.area[q] * (P * boundary.normal[q] - beta * w);
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
    evaluate_material(state,
                      increment,
                      [&](const unsigned int    q,
                          const Tensor<1, dim> &value,
                          const Tensor<2, dim> &F) {
                        update.displacement_increment[q] = value;
                        update.F[q]                      = F;
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
    evaluate_boundary(boundary,
                      increment,
                      [&](const unsigned int    q,
                          const Tensor<1, dim> &value,
                          const Tensor<2, dim> &F) {
                        update.displacement_increment[q] = value;
                        update.F[q]                      = F;
                      });
    return update;
  }



  template <int dim>
  void
  DisplacementSystem<dim>::boundary_driving(const BoundaryState<dim> &boundary,
                                            const LA::FieldVector    &increment,
                                            std::vector<double> &driving) const
  {
    increment.update_ghost_values();
    driving.resize(boundary_points->n_points());
    evaluate_boundary(boundary,
                      increment,
                      [&](const unsigned int    q,
                          const Tensor<1, dim> &value,
                          const Tensor<2, dim> &F) {
                        const Tensor<2, dim> P = material.degraded_stress(F);
                        const auto           w = mismatch(boundary, q, value);
                        driving[q]             = w * (P * boundary.normal[q]);
                      });
  }



  template <int dim>
  template <typename Visitor>
  void
  DisplacementSystem<dim>::evaluate_material(const MaterialState<dim> &state,
                                             const LA::FieldVector &increment,
                                             const Visitor         &visit) const
  {
    evaluate(*points, material_groups, state.F, increment, visit);
  }



  template <int dim>
  template <typename Visitor>
  void
  DisplacementSystem<dim>::evaluate_boundary(const BoundaryState<dim> &boundary,
                                             const LA::FieldVector &increment,
                                             const Visitor         &visit) const
  {
    evaluate(*boundary_points, boundary_groups, boundary.F, increment, visit);
  }



  template <int dim>
  template <typename Visitor>
  void
  DisplacementSystem<dim>::evaluate(const CellPoints<dim>             &at,
                                    const PointGroups<dim>            &groups,
                                    const std::vector<Tensor<2, dim>> &F_n,
                                    const LA::FieldVector &increment,
                                    const Visitor         &visit) const
  {
    evaluate_field<dim>(at,
                        groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int                     q,
                            const Tensor<1, dim>                  &value,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          visit(q, value, deformation<dim>(gradient, F_n[q]));
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



  template class DisplacementSystem<2>;
  template class DisplacementSystem<3>;
} // namespace EBSMPM
