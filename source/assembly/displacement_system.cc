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
    assemble_matrix(
      AssemblyTask::tangent, state, boundary, increment, residual);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble_tangent(const MaterialState<dim> &state,
                                            const BoundaryState<dim> &boundary,
                                            const LA::FieldVector    &increment,
                                            const std::vector<bool>  &wanted,
                                            LA::FieldVector          &residual)
  {
    AssertDimension(wanted.size(),
                    functions->locally_owned_size() +
                      functions->n_ghost_indices());
    assemble_matrix(
      AssemblyTask::tangent, state, boundary, increment, residual, &wanted);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble_predictor(
    const MaterialState<dim> &state,
    const BoundaryState<dim> &boundary,
    const LA::FieldVector    &increment,
    LA::FieldVector          &residual)
  {
    assemble_matrix(
      AssemblyTask::predictor, state, boundary, increment, residual);
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble_matrix(const AssemblyTask        task,
                                           const MaterialState<dim> &state,
                                           const BoundaryState<dim> &boundary,
                                           const LA::FieldVector    &increment,
                                           LA::FieldVector          &residual,
                                           const std::vector<bool>  *wanted)
  {
    tangent.begin(wanted);
    assemble(task, state, boundary, increment, residual, &tangent, wanted);
    tangent.compress();
  }



  template <int dim>
  void
  DisplacementSystem<dim>::assemble(const AssemblyTask        task,
                                    const MaterialState<dim> &state,
                                    const BoundaryState<dim> &boundary,
                                    const LA::FieldVector    &increment,
                                    LA::FieldVector          &residual,
                                    SystemMatrix             *matrix,
                                    const std::vector<bool>  *wanted) const
  {
    increment.update_ghost_values();
    residual = 0.;

    // A state that is impossible at a point of one process (turned inside out,
    // say) is an error on all of them.
    std::string failure;
    try
      {
        add_groups(task, state, boundary, increment, residual, matrix, wanted);
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
                                      SystemMatrix             *matrix,
                                      const std::vector<bool>  *wanted) const
  {
    const auto is_wanted = [&](const PointGroups<dim>                 &groups,
                               const typename PointGroups<dim>::Group &group) {
      return wanted == nullptr ||
             groups.reads_any(group, [wanted](const unsigned int i) {
               return (*wanted)[i];
             });
    };
    const auto distribute = [&](const unsigned int list) {
      local.distribute_residual(residual);
      if (task != AssemblyTask::residual)
        local.distribute_tangent(list, *matrix);
    };

    // Groups, and then the lone ones, are numbered as the lists of the matrix.
    const unsigned int n_groups = material_groups.groups().size();
    for (unsigned int g = 0; g < n_groups; ++g)
      {
        if (!is_wanted(material_groups, material_groups.groups()[g]))
          continue;
        local.reinit(*points, material_groups, material_groups.groups()[g]);
        local.gather(increment);
        elastic_terms.compute(task, state, branches, local);
        if (connected_pieces.is_free(g))
          add_mass(task, state, g);
        if (partners[g] != numbers::invalid_unsigned_int)
          {
            local.go_on(*boundary_points,
                        boundary_groups,
                        boundary_groups.groups()[partners[g]]);
            nitsche_terms.compute(task, boundary, boundary_branches, local);
          }
        distribute(g);
      }
    for (unsigned int l = 0; l < lone_boundary_groups.size(); ++l)
      {
        const auto &group = boundary_groups.groups()[lone_boundary_groups[l]];
        if (!is_wanted(boundary_groups, group))
          continue;
        local.reinit(*boundary_points, boundary_groups, group);
        local.gather(increment);
        nitsche_terms.compute(task, boundary, boundary_branches, local);
        distribute(n_groups + l);
      }
  }



  template <int dim>
  void
  DisplacementSystem<dim>::add_mass(const AssemblyTask        task,
                                    const MaterialState<dim> &state,
                                    const unsigned int        g) const
  {
    const unsigned int n       = local.n_functions();
    const double       density = 1e-6 * material.nitsche_stiffness() /
                           Utilities::fixed_power<2>(local.cell_extent());
    std::array<double, BSplineKernel<dim>::max_n_functions> B;
    for (unsigned int k = 0; k < local.n_points(); ++k)
      {
        local.values(k, B.data());
        const unsigned int            q = local.point(k);
        const SymmetricTensor<2, dim> mass =
          density * state.volume[q] *
          connected_pieces.free_directions(g, points->location(q));
        local.add_force(mass * local.value(B.data()), B.data());
        if (task != AssemblyTask::residual)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = i; j < n; ++j)
              for (unsigned int a = 0; a < dim; ++a)
                for (unsigned int b = 0; b < dim; ++b)
                  local.tangent(i, a, j, b) += B[i] * B[j] * mass[a][b];
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
            local.add_force(-state.volume[q] * force.value(points->location(q)),
                            B.data());
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



  template class DisplacementSystem<2>;
  template class DisplacementSystem<3>;
} // namespace EBSMPM
