// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/solvers/staggered_step.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace EBSMPM
{
  namespace
  {
    /**
     * When the relaxation may grow, and how far.
     */
    struct Caution
    {
      /** Updates are parallel if the cosine of their angle is larger. */
      double least_cosine;

      /** Change of the damage in a pass up to which the relaxation may grow. */
      double largest_change;

      /** Factor by which the relaxation may grow from pass to pass. */
      double largest_growth;
    };

    /**
     * What is overshot cannot be taken back, because damage does not heal. Only
     * in steps that take many passes, where the crack runs through the body
     * without stopping, there is less to lose: each time that it has advanced,
     * the relaxation begins with one again, and most passes would be spent on
     * getting back to where it helps.
     */
    constexpr Caution      at_first      = {0.9, 0.15, 3.};
    constexpr Caution      in_long_steps = {0.5, 0.5, 9.};
    constexpr unsigned int many_passes   = 12;
  } // namespace



  template <int dim>
  double
  StaggeredStep<dim>::solve_damage(double          &relaxation,
                                   LA::FieldVector &last_update,
                                   Report          &report)
  {
    std::vector<double> driving;
    if (data.damage_boundary_term)
      u_system.boundary_driving(boundary, u_increment, driving);

    LA::FieldVector rhs = d_system.make_vector();
    {
      TimerOutput::Scope scope(*timer, "assemble damage");
      d_system.assemble(state, boundary, driving, rhs);
    }
    LA::FieldVector solution = d_field;
    {
      TimerOutput::Scope scope(*timer, "solve damage");
      const auto         linear =
        solve_linear_system(d_solver, d_system.matrix(), rhs, 1e-11, solution);
      report.linear_iterations += linear.iterations;
      report.refreshes += linear.refreshed;
    }

    // d <- d + omega (solution - d)
    d_field.zero_out_ghost_values();
    solution.zero_out_ghost_values();
    solution -= d_field;
    relaxation =
      next_relaxation(relaxation, report.passes, solution, last_update);
    last_update.reinit(solution);
    last_update = solution;
    d_field.add(relaxation, solution);

    std::vector<double> at_points, at_boundary_points;
    d_system.evaluate(d_field, at_points, at_boundary_points);
    double change = 0.;
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        const double d  = std::min(1., std::max(0., at_points[q]));
        change          = std::max(change, std::abs(d - state.damage[q]));
        state.damage[q] = d;
      }
    for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
      boundary.damage[q] = std::min(1., std::max(0., at_boundary_points[q]));
    return Utilities::MPI::max(change, d_space.communicator());
  }



  template <int dim>
  double
  StaggeredStep<dim>::next_relaxation(const double           relaxation,
                                      const unsigned int     pass,
                                      const LA::FieldVector &update,
                                      const LA::FieldVector &last_update) const
  {
    if (last_update.size() == 0)
      return 1.;
    const Caution caution   = (pass > many_passes ? in_long_steps : at_first);
    const double  last_norm = last_update.l2_norm();
    const double  product   = update * last_update;
    if (!(product > caution.least_cosine * update.l2_norm() * last_norm))
      return 1.;

    // A single mode is left, of which the last step has left this part. If
    // nothing, or more than before, go as far as is safe.
    const double ratio = product / (last_norm * last_norm);
    double       result =
      std::min(data.max_relaxation, caution.largest_growth * relaxation);
    if (ratio < 1.)
      result = std::min(result, relaxation / (1. - ratio));
    return std::max(1.,
                    std::min(result,
                             caution.largest_change / update.linfty_norm()));
  }



  template double
  StaggeredStep<2>::solve_damage(double &, LA::FieldVector &, Report &);
  template double
  StaggeredStep<3>::solve_damage(double &, LA::FieldVector &, Report &);
  template double
  StaggeredStep<2>::next_relaxation(const double,
                                    const unsigned int,
                                    const LA::FieldVector &,
                                    const LA::FieldVector &) const;
  template double
  StaggeredStep<3>::next_relaxation(const double,
                                    const unsigned int,
                                    const LA::FieldVector &,
                                    const LA::FieldVector &) const;
} // namespace EBSMPM
