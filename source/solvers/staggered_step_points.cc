// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/solvers/staggered_step.h>

namespace EBSMPM
{
  namespace
  {
    /** Read the labels of a point. */
    template <int dim>
    void
    get_labels(const PointView<dim> &point,
               const unsigned int    q,
               CrackLabels<dim>     &labels)
    {
      labels.side[q]        = point.side();
      labels.frozen[q]      = point.label_frozen() != 0.;
      labels.peak_damage[q] = point.peak_damage();
    }



    /**
     * Turn a side vector with the motion during the step: a normal transforms
     * with $F^{-T}$.
     */
    template <int dim>
    Tensor<1, dim>
    convect(const Tensor<1, dim> &side,
            const Tensor<2, dim> &F_new,
            const Tensor<2, dim> &F_old)
    {
      if (side.norm_square() == 0.)
        return side;
      const Tensor<1, dim> moved =
        transpose(invert(F_new * invert(F_old))) * side;
      return moved / moved.norm();
    }



    /** Move a point, and write its deformation and its labels to it. */
    template <int dim>
    void
    advance(const CellPoints<dim>                          &points,
            const unsigned int                              q,
            const typename DisplacementSystem<dim>::Update &update,
            const Tensor<2, dim>                           &F_old,
            const CrackLabels<dim>                         &labels,
            PointView<dim>                                 &point)
    {
      const Tensor<1, dim> &increment = update.displacement_increment[q];
      point.set_displacement(point.displacement() + increment);
      point.set_deformation_gradient(update.F[q]);
      point.set_side(convect(labels.side[q], update.F[q], F_old));
      point.peak_damage()  = labels.peak_damage[q];
      point.label_frozen() = labels.frozen[q];
      auto particle        = points.particle(q);
      particle->set_location(particle->get_location() + increment);
    }
  } // namespace



  template <int dim>
  void
  StaggeredStep<dim>::number_points()
  {
    points.reinit(material_points.handler(), d_space.lattice());
    boundary_points.reinit(boundary_material_points.handler(),
                           d_space.lattice());

    state.resize(points.n_points());
    labels.resize(points.n_points());
    current_volume.resize(points.n_points());
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        const MaterialPoint<dim> point(points.properties(q));
        state.volume[q]   = point.reference_volume();
        state.F[q]        = point.deformation_gradient();
        current_volume[q] = determinant(state.F[q]) * state.volume[q];
      }
    boundary.resize(boundary_points.n_points());
    boundary_labels.resize(boundary_points.n_points());
    for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
      {
        const BoundaryPoint<dim> point(boundary_points.properties(q));
        boundary.area[q]         = point.reference_area();
        boundary.normal[q]       = point.reference_normal();
        boundary.displacement[q] = point.displacement();
        boundary.F[q]            = point.deformation_gradient();
        boundary.boundary_id[q]  = point.boundary_id();
      }
  }



  template <int dim>
  void
  StaggeredStep<dim>::read_iterates()
  {
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        const MaterialPoint<dim> point(points.properties(q));
        state.damage[q]  = point.damage();
        state.history[q] = point.history();
        get_labels(point, q, labels);
      }
    for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
      {
        const BoundaryPoint<dim> point(boundary_points.properties(q));
        boundary.damage[q] = point.damage();
        get_labels(point, q, boundary_labels);
      }
  }



  template <int dim>
  void
  StaggeredStep<dim>::move_points()
  {
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        MaterialPoint<dim> point(points.properties(q));
        advance(points, q, update, state.F[q], labels, point);
        point.damage()  = state.damage[q];
        point.history() = state.history[q];
      }
    for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
      {
        BoundaryPoint<dim> point(boundary_points.properties(q));
        advance(boundary_points,
                q,
                boundary_update,
                boundary.F[q],
                boundary_labels,
                point);
        point.damage() = boundary.damage[q];
      }
  }



  template void
  StaggeredStep<2>::number_points();
  template void
  StaggeredStep<3>::number_points();
  template void
  StaggeredStep<2>::read_iterates();
  template void
  StaggeredStep<3>::read_iterates();
  template void
  StaggeredStep<2>::move_points();
  template void
  StaggeredStep<3>::move_points();
} // namespace EBSMPM
