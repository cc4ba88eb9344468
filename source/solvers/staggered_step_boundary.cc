// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of StaggeredStep that is about what acts on the boundary.

#include <ebsmpm/assembly/boundary_resultants.h>

#include <ebsmpm/solvers/staggered_step.h>

namespace EBSMPM
{
  template <int dim>
  void
  StaggeredStep<dim>::set_tractions(
    const TractionConditions<dim>         &tractions_,
    const std::vector<types::boundary_id> &faces)
  {
    tractions   = &tractions_;
    crack_faces = faces;
  }



  template <int dim>
  void
  StaggeredStep<dim>::sum_up_boundary(
    const DirichletConditions<dim> &conditions,
    const double                    load,
    Report                         &report)
  {
    const MPI_Comm &communicator = u_space.communicator();

    boundary_update = u_system.update_points(boundary, u_increment);
    flux            = u_system.flux(boundary, boundary_update);
    all_reactions =
      BoundaryResultants::reactions(boundary, flux, boundary_ids, communicator);
    report.conjugate_force = BoundaryResultants::conjugate_force(
      boundary,
      flux,
      conditions.rates(load, boundary_points, boundary),
      communicator);
    if (!crack_faces.empty())
      report.opened_volume = BoundaryResultants::opened_volume(boundary,
                                                               boundary_update,
                                                               crack_faces,
                                                               communicator);
  }



  template void
  StaggeredStep<2>::set_tractions(const TractionConditions<2> &,
                                  const std::vector<types::boundary_id> &);
  template void
  StaggeredStep<3>::set_tractions(const TractionConditions<3> &,
                                  const std::vector<types::boundary_id> &);

  template void
  StaggeredStep<2>::sum_up_boundary(const DirichletConditions<2> &,
                                    const double,
                                    Report &);
  template void
  StaggeredStep<3>::sum_up_boundary(const DirichletConditions<3> &,
                                    const double,
                                    Report &);
} // namespace EBSMPM
