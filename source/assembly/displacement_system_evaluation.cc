// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The part of DisplacementSystem that evaluates the field at the points.

#include <ebsmpm/assembly/displacement_system.h>
#include <ebsmpm/assembly/field_evaluation.h>
#include <ebsmpm/assembly/point_values.h>

#include <deal.II/base/mpi.h>

namespace EBSMPM
{
  template <int dim>
  void
  DisplacementSystem<dim>::hold_branches(const MaterialState<dim> &state,
                                         const BoundaryState<dim> &boundary,
                                         const LA::FieldVector    &increment)
  {
    const auto hold = [&](const Update &update) {
      std::vector<EnergyBranch> result;
      for (const auto &F : update.F)
        result.push_back(material.branch(F));
      return result;
    };
    branches          = hold(update_points(state, increment));
    boundary_branches = hold(update_points(boundary, increment));
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
  std::vector<Tensor<1, dim>>
  DisplacementSystem<dim>::flux(const BoundaryState<dim> &boundary,
                                const Update             &update) const
  {
    std::vector<Tensor<1, dim>> result(update.F.size());
    for (unsigned int q = 0; q < result.size(); ++q)
      {
        const double   g = degradation.value(boundary.damage[q]);
        Tensor<2, dim> P;
        material.stress(update.F[q], g, P, branch_of(boundary_branches, q));
        result[q] =
          P * boundary.normal[q] -
          beta * mismatch(boundary, q, update.displacement_increment[q]);
      }
    return result;
  }



  template <int dim>
  typename DisplacementSystem<dim>::Energies
  DisplacementSystem<dim>::energies(
    const MaterialState<dim>          &state,
    const Update                      &update,
    const BoundaryState<dim>          &boundary,
    const Update                      &boundary_update,
    const std::vector<Tensor<1, dim>> &flux) const
  {
    Energies result;
    for (unsigned int q = 0; q < update.F.size(); ++q)
      {
        const double g = degradation.value(state.damage[q]);
        double       psi_degraded, psi_intact;
        material.energies(update.F[q], psi_degraded, psi_intact);
        result.elastic += state.volume[q] * (g * psi_degraded + psi_intact);
      }
    for (unsigned int q = 0; q < flux.size(); ++q)
      {
        const auto w =
          mismatch(boundary, q, boundary_update.displacement_increment[q]);
        result.penalty -= boundary.area[q] * (w * (flux[q] + 0.5 * beta * w));
      }
    const MPI_Comm &comm = spline_space->communicator();
    result.elastic       = Utilities::MPI::sum(result.elastic, comm);
    result.penalty       = Utilities::MPI::sum(result.penalty, comm);
    return result;
  }



  template <int dim>
  typename DisplacementSystem<dim>::Update
  DisplacementSystem<dim>::update_points(const MaterialState<dim> &state,
                                         const LA::FieldVector &increment) const
  {
    return update_points(*points, material_groups, state.F, increment);
  }



  template <int dim>
  typename DisplacementSystem<dim>::Update
  DisplacementSystem<dim>::update_points(const BoundaryState<dim> &boundary,
                                         const LA::FieldVector &increment) const
  {
    return update_points(*boundary_points,
                         boundary_groups,
                         boundary.F,
                         increment);
  }



  template <int dim>
  typename DisplacementSystem<dim>::Update
  DisplacementSystem<dim>::update_points(const CellPoints<dim>  &at,
                                         const PointGroups<dim> &groups,
                                         const std::vector<Tensor<2, dim>> &F_n,
                                         const LA::FieldVector &increment) const
  {
    increment.update_ghost_values();
    Update update;
    update.displacement_increment.resize(at.n_points());
    update.F.resize(at.n_points());
    evaluate_field<dim>(at,
                        groups,
                        spline_space->lattice(),
                        spline_space->degree(),
                        increment,
                        [&](const unsigned int                     q,
                            const Tensor<1, dim>                  &value,
                            const std::array<Tensor<1, dim>, dim> &gradient) {
                          update.displacement_increment[q] = value;
                          update.F[q] = deformation<dim>(gradient, F_n[q]);
                        });
    return update;
  }



  template <int dim>
  void
  DisplacementSystem<dim>::boundary_driving(const BoundaryState<dim> &boundary,
                                            const LA::FieldVector    &increment,
                                            std::vector<double> &driving) const
  {
    const Update update = update_points(boundary, increment);
    driving.resize(update.F.size());
    for (unsigned int q = 0; q < driving.size(); ++q)
      {
        const Tensor<2, dim> P = material.degraded_stress(update.F[q]);
        const auto w = mismatch(boundary, q, update.displacement_increment[q]);
        driving[q]   = w * (P * boundary.normal[q]);
      }
  }



  template void
  DisplacementSystem<2>::hold_branches(const MaterialState<2> &,
                                       const BoundaryState<2> &,
                                       const LA::FieldVector &);
  template void
  DisplacementSystem<2>::driving_energy(const Update &,
                                        std::vector<double> &) const;
  template std::vector<Tensor<1, 2>>
  DisplacementSystem<2>::flux(const BoundaryState<2> &, const Update &) const;
  template typename DisplacementSystem<2>::Energies
  DisplacementSystem<2>::energies(const MaterialState<2> &,
                                  const Update &,
                                  const BoundaryState<2> &,
                                  const Update &,
                                  const std::vector<Tensor<1, 2>> &) const;
  template typename DisplacementSystem<2>::Update
  DisplacementSystem<2>::update_points(const MaterialState<2> &,
                                       const LA::FieldVector &) const;
  template typename DisplacementSystem<2>::Update
  DisplacementSystem<2>::update_points(const BoundaryState<2> &,
                                       const LA::FieldVector &) const;
  template void
  DisplacementSystem<2>::boundary_driving(const BoundaryState<2> &,
                                          const LA::FieldVector &,
                                          std::vector<double> &) const;

  template void
  DisplacementSystem<3>::hold_branches(const MaterialState<3> &,
                                       const BoundaryState<3> &,
                                       const LA::FieldVector &);
  template void
  DisplacementSystem<3>::driving_energy(const Update &,
                                        std::vector<double> &) const;
  template std::vector<Tensor<1, 3>>
  DisplacementSystem<3>::flux(const BoundaryState<3> &, const Update &) const;
  template typename DisplacementSystem<3>::Energies
  DisplacementSystem<3>::energies(const MaterialState<3> &,
                                  const Update &,
                                  const BoundaryState<3> &,
                                  const Update &,
                                  const std::vector<Tensor<1, 3>> &) const;
  template typename DisplacementSystem<3>::Update
  DisplacementSystem<3>::update_points(const MaterialState<3> &,
                                       const LA::FieldVector &) const;
  template typename DisplacementSystem<3>::Update
  DisplacementSystem<3>::update_points(const BoundaryState<3> &,
                                       const LA::FieldVector &) const;
  template void
  DisplacementSystem<3>::boundary_driving(const BoundaryState<3> &,
                                          const LA::FieldVector &,
                                          std::vector<double> &) const;
} // namespace EBSMPM
