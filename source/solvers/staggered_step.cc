// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/assembly/rigid_motions.h>
#include <ebsmpm/assembly/supports.h>

#include <ebsmpm/solvers/staggered_step.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace EBSMPM
{
  template <int dim>
  StaggeredStep<dim>::StaggeredStep(MaterialPoints<dim>  &points,
                                    BoundaryPoints<dim>  &boundary_points,
                                    const Material<dim>  &material,
                                    const Degradation    &degradation,
                                    const double          fracture_energy,
                                    const double          length_scale,
                                    const double          penalty,
                                    const AdditionalData &data,
                                    TimerOutput          *timer_)
    : material_points(points)
    , boundary_material_points(boundary_points)
    , data(data)
    , own_timer(timer_ != nullptr ?
                  nullptr :
                  std::make_unique<TimerOutput>(std::cout,
                                                TimerOutput::never,
                                                TimerOutput::wall_times))
    , timer(timer_ != nullptr ? timer_ : own_timer.get())
    , u_space(points.triangulation(), data.degree)
    , d_space(points.triangulation(), data.degree)
    , partition(d_space, data.partition_data)
    , u_system(material, degradation, penalty)
    , d_system(fracture_energy, length_scale)
    , newton(data.newton)
    , u_solver(data.displacement_solver)
    , d_solver(data.damage_solver)
  {
    u_solver.set_block_size(dim);
    begin(FieldSnapshot<dim>());

    // All ids of all processes, by way of the largest one.
    unsigned int n_ids = 0;
    for (const auto id : boundary.boundary_id)
      n_ids = std::max(n_ids, id + 1U);
    n_ids = Utilities::MPI::max(n_ids, u_space.communicator());
    for (unsigned int id = 0; id < n_ids; ++id)
      boundary_ids.push_back(id);
  }



  template <int dim>
  void
  StaggeredStep<dim>::begin(const FieldSnapshot<dim> &old_damage)
  {
    TimerOutput::Scope scope(*timer, "points and spaces");

    number_points();

    // The damage sees both sides of a crack.
    const FieldSnapshot<dim> old_rows(d_space, d_solver.former_rows());
    d_supports.clear();
    add_supports<dim>(points, current_volume, {}, d_space, d_supports);
    add_supports<dim>(boundary_points, {}, {}, d_space, d_supports);
    if (d_space.reinit(d_supports,
                       data.extension_threshold,
                       data.extension_hysteresis))
      make_extension_constraints(d_space, d_constraints);
    if (d_system.reinit(
          points, boundary_points, d_space, d_constraints, {}, {}))
      {
        LA::FieldVector rows = d_system.make_vector();
        old_rows.template transfer<1>(d_space, rows);
        d_solver.renumber(rows);
      }
    d_system.initialize_vector(d_field);
    old_damage.template transfer<1>(d_space, d_field);
    // For cell_damage(), which has to do without communication.
    d_field.update_ghost_values();

    space_is_current = false;
  }



  template <int dim>
  void
  StaggeredStep<dim>::build_displacement_space()
  {
    TimerOutput::Scope scope(*timer, "points and spaces");

    const FieldSnapshot<dim> old_increment(u_space, u_increment);
    const FieldSnapshot<dim> old_rows(u_space, u_solver.former_rows());

    // Without a crack, the points read the same functions as for the damage.
    typename SplineSpace<dim>::SupportTable u_supports;
    if (partition.is_open())
      {
        add_supports<dim>(
          points, current_volume, partition.patterns(), u_space, u_supports);
        add_supports<dim>(boundary_points,
                          {},
                          partition.boundary_patterns(),
                          u_space,
                          u_supports);
        partition.add_sides(u_supports);
      }
    if (u_space.reinit(partition.is_open() ? u_supports : d_supports,
                       data.extension_threshold,
                       data.extension_hysteresis))
      u_extension = make_extension_constraints(u_space, u_constraints);
    if (u_system.reinit(points,
                        boundary_points,
                        u_space,
                        u_constraints,
                        partition.patterns(),
                        partition.boundary_patterns()))
      {
        LA::FieldVector rows = u_system.make_vector();
        old_rows.template transfer<dim>(u_space, rows);
        u_solver.renumber(rows);
        u_solver.set_near_null_space(RigidMotions::coefficients(
          u_space, u_system.matrix().locally_owned_range_indices()));
      }
    u_system.hold_free_pieces(state, boundary);

    u_system.initialize_vector(u_increment);
    old_increment.template transfer<dim>(u_space, u_increment);
    space_is_current = true;
  }



  template <int dim>
  typename StaggeredStep<dim>::Report
  StaggeredStep<dim>::solve(const DirichletConditions<dim> &conditions,
                            const double                    load,
                            const double                    guess_factor)
  {
    Report report;

    // Everything that is iterated starts from what the points say.
    read_iterates();
    conditions.apply(load, boundary_points, boundary);
    if (tractions != nullptr)
      tractions->apply(load, boundary_points, boundary);

    // The first pass updates the partition after the damage, if it does, and
    // nothing asks for it before unless the damage has a boundary term.
    const bool comes_with_damage = data.damage && !data.damage_boundary_term &&
                                   data.max_partition_passes > 0;
    bool partition_changed =
      data.partition && !comes_with_damage && update_partition();

    // The space is spared if the damage is going to change it.
    if (data.damage_boundary_term)
      begin_increment(guess_factor);

    const bool      iterate    = data.damage && data.max_passes > 1;
    bool            converged  = !iterate;
    double          relaxation = 1.;
    LA::FieldVector last_update;

    for (unsigned int pass = 1; pass <= data.max_passes; ++pass)
      {
        ++report.passes;
        if (pass > 1)
          partition_changed = false;
        if (data.damage)
          {
            report.damage_change =
              solve_damage(relaxation, last_update, report);

            if (data.partition && pass <= data.max_partition_passes &&
                update_partition())
              partition_changed = true;
          }
        if (pass == 1 && !data.damage_boundary_term)
          begin_increment(guess_factor);
        else if (!space_is_current)
          build_displacement_space();

        converged = !iterate || (pass > 1 && !partition_changed &&
                                 report.damage_change < data.tolerance);
        solve_displacement(converged ? data.newton.tolerance :
                                       data.intermediate_tolerance,
                           partition_changed,
                           pass == 1 && guess_factor == 0.,
                           report);

        update = u_system.update_points(state, u_increment);
        if (data.damage)
          update_history();
        if (converged)
          break;
      }
    AssertThrow(converged,
                ExcSolverFailure("The staggered scheme did not converge in " +
                                 std::to_string(data.max_passes) +
                                 " passes: the damage still changes by " +
                                 std::to_string(report.damage_change) + "."));
    if (data.refuse_indefinite && report.indefinite_at_end)
      check_stability();
    sum_up_boundary(conditions, load, report);
    report.n_pieces      = u_system.pieces().pieces().size();
    report.n_free_pieces = u_system.pieces().n_free();
    report.n_junctions   = partition.n_junctions();
    if (u_space.n_twins() > 0)
      report.opening = opening();
    return report;
  }



  template <int dim>
  bool
  StaggeredStep<dim>::update_partition()
  {
    TimerOutput::Scope scope(*timer, "crack partition");
    const bool         changed = partition.update(points,
                                          boundary_points,
                                          current_volume,
                                          state.damage,
                                          labels,
                                          boundary_labels);
    space_is_current           = space_is_current && !changed;
    return changed;
  }



  template <int dim>
  void
  StaggeredStep<dim>::begin_increment(const double guess_factor)
  {
    u_increment.reinit(0);
    if (!space_is_current)
      build_displacement_space();
    else
      u_system.initialize_vector(u_increment);
    if (guess_factor != 0.)
      {
        last_increment.template transfer<dim>(u_space, u_increment);
        u_increment *= guess_factor;
      }

    // The force of a broken specimen goes to zero, so compare residuals with
    // the largest one so far; before there is any, with the first residual.
    // That is large, as no Dirichlet data are met yet, but what is lost by
    // roundoff is a part of it, and a piece that nothing holds never has a
    // force.
    if (first_residual == 0.)
      {
        LA::FieldVector residual = u_system.make_vector();
        u_system.assemble_residual(state, boundary, u_increment, residual);
        first_residual = residual.l2_norm();
      }
    force_scale = largest_force == 0. ?
                    first_residual :
                    std::max(largest_force, 1e-3 * first_residual);
  }



  template <int dim>
  void
  StaggeredStep<dim>::update_history()
  {
    TimerOutput::Scope scope(*timer, "history");
    u_system.driving_energy(update, psi);
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        // What has become part of the discrete crack in this step is unloaded
        // by that, but must not heal in the next pass.
        const MaterialPoint<dim> point(points.properties(q));
        const bool               is_separated =
          data.partition &&
          labels.peak_damage[q] > data.partition_data.damage_threshold;
        if (point.damageable() != 0.)
          state.history[q] =
            std::max(is_separated ? state.history[q] : point.history(), psi[q]);
      }
  }



  template <int dim>
  CrackOpening
  StaggeredStep<dim>::opening() const
  {
    std::vector<Tensor<1, dim>> displacements(points.n_points());
    for (unsigned int q = 0; q < points.n_points(); ++q)
      displacements[q] =
        MaterialPoint<dim>(points.properties(q)).displacement();
    return crack_opening(points,
                         partition,
                         state.volume,
                         displacements,
                         update.displacement_increment,
                         update.F);
  }



  template <int dim>
  void
  StaggeredStep<dim>::check_stability()
  {
    // What the solver has found may have been true of an earlier tangent.
    LA::FieldVector residual = u_system.make_vector();
    u_system.assemble_tangent(state, boundary, u_increment, residual);
    AssertThrow(!u_solver.is_found_indefinite(u_system.matrix()),
                ExcSolverFailure(
                  "The equilibrium is not stable: its tangent has negative "
                  "pivots. (If this is so from the first step on, the penalty "
                  "factor of Nitsche's method is too small.)"));
  }



  template <int dim>
  void
  StaggeredStep<dim>::solve_displacement(const double tolerance,
                                         const bool   partition_changed,
                                         const bool   from_zero,
                                         Report      &report)
  {
    NewtonSolver::Problem problem;

    // Points that read twins now see a displacement from the other side.
    if (partition_changed)
      problem.first_tolerance = 0.1;
    problem.residual = [&](const LA::FieldVector &x, LA::FieldVector &r) {
      TimerOutput::Scope scope(*timer, "assemble residual");
      u_system.assemble_residual(state, boundary, x, r);
    };
    problem.tangent = [&](const LA::FieldVector &x, LA::FieldVector &r) {
      TimerOutput::Scope scope(*timer, "assemble tangent");
      u_system.assemble_tangent(state, boundary, x, r);
    };
    if (report.passes == 1)
      problem.predictor = [&](const LA::FieldVector &x, LA::FieldVector &r) {
        TimerOutput::Scope scope(*timer, "assemble tangent");
        u_system.assemble_predictor(state, boundary, x, r);
      };
    problem.matrix = [&]() -> const LA::SparseMatrix & {
      return u_system.matrix();
    };

    problem.smooth = [&](const LA::FieldVector &x) {
      u_system.hold_branches(state, boundary, x);
    };

    u_system.release_branches();
    if (partition_changed && !from_zero)
      {
        TimerOutput::Scope scope(*timer, "nonlinear elimination");
        elimination.improve(u_system, state, boundary, u_increment);
      }

    TimerOutput::Scope scope(*timer, "Newton");
    const double       scale = force_scale;
    const auto         result =
      newton.solve(problem, u_solver, scale, tolerance, u_increment);
    report.newton_iterations += result.iterations;
    report.linear_iterations += result.linear_iterations;
    report.refreshes += result.refreshes;
    report.bisections += result.bisections;
    report.indefinite_at_end = result.indefinite_at_end;
    report.indefinite        = report.indefinite || result.indefinite;
    report.smoothed          = report.smoothed || result.smoothed;
    report.residual          = result.residual / (scale > 0. ? scale : 1.);
    report.residuals         = result.residuals;
  }



  template <int dim>
  void
  StaggeredStep<dim>::accept()
  {
    TimerOutput::Scope scope(*timer, "accept");

    for (const auto &reaction : all_reactions)
      largest_force = std::max(largest_force, reaction.second.norm());

    move_points();
    last_increment.reinit(u_space, u_increment);
    material_points.sort();
    boundary_material_points.sort();
    begin(FieldSnapshot<dim>(d_space, d_field));
  }



  template <int dim>
  const std::map<types::boundary_id, Tensor<1, dim>> &
  StaggeredStep<dim>::reactions() const
  {
    return all_reactions;
  }



  template <int dim>
  typename DisplacementSystem<dim>::Energies
  StaggeredStep<dim>::energies() const
  {
    return u_system.energies(state, update, boundary, boundary_update, flux);
  }



  template <int dim>
  double
  StaggeredStep<dim>::crack_area() const
  {
    return data.damage ? d_system.crack_area(state, d_field) : 0.;
  }



  template <int dim>
  void
  StaggeredStep<dim>::cell_damage(
    const typename Triangulation<dim>::active_cell_iterator &cell,
    std::vector<double>                                     &coefficients) const
  {
    coefficients =
      cell_coefficients<dim, 1>(cell, d_space, d_constraints, d_field);
  }



  template <int dim>
  const SplineSpace<dim> &
  StaggeredStep<dim>::displacement_space() const
  {
    return u_space;
  }



  template <int dim>
  const ExtensionReport &
  StaggeredStep<dim>::extension_report() const
  {
    return u_extension;
  }



  template <int dim>
  DisplacementSystem<dim> &
  StaggeredStep<dim>::displacement_system()
  {
    return u_system;
  }



  template <int dim>
  const MaterialState<dim> &
  StaggeredStep<dim>::material_state() const
  {
    return state;
  }



  template <int dim>
  const BoundaryState<dim> &
  StaggeredStep<dim>::boundary_state() const
  {
    return boundary;
  }



  template <int dim>
  const LA::FieldVector &
  StaggeredStep<dim>::increment() const
  {
    return u_increment;
  }



  template class StaggeredStep<2>;
  template class StaggeredStep<3>;
} // namespace EBSMPM
