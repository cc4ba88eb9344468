// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_damage_system_h
#define ebsmpm_assembly_damage_system_h

#include <ebsmpm/lac/system_matrix.h>
#include <ebsmpm/lac/types.h>

#include <ebsmpm/assembly/extension_product.h>
#include <ebsmpm/assembly/point_groups.h>
#include <ebsmpm/assembly/point_state.h>

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace EBSMPM
{
  /**
   * The equation for the damage (phase field), linear for a given history
   * field.
   *
   * With the crack density of AT2,
   * $\gamma=(d^2+l^2|\nabla_X d|^2)/(2l)$, and $g'(d)=-2(1-d)$,
   * @f[
   *   \sum_p V_0 \Bigl[ -2(1-d)\,\mathcal H\, q + G_c \Bigl( \frac{d\,q}{l}
   *     + l\, \nabla_X d\cdot\nabla_X q \Bigr) \Bigr]
   *   + \sum_b 2 A_0 (1-d)\, q\, \mathbf w\cdot\mathbf P^+\mathbf N = 0,
   *   \qquad \nabla_X = \mathbf F_n^T\nabla_n,
   * @f]
   * (equation (7) of Sugai et al.; method, section 3). The boundary term
   * belongs to Nitsche's method for the displacement, and is there only if its
   * driving factor $\mathbf w\cdot\mathbf P^+\mathbf N$ is given.
   *
   * The matrix of a group of points is a single product $\mathbf X^T\mathbf X$,
   * where the rows of $\mathbf X$ are the values and reference gradients of all
   * functions at a point, times the roots of their weights.
   *
   * @code
   * DamageSystem<dim> system(Gc, l);
   * system.reinit(points, boundary_points, space, constraints, {}, {});
   * LA::FieldVector damage = system.make_vector(), rhs = damage;
   * system.assemble(state, boundary, {}, rhs);
   * solver.solve(system.matrix(), damage, rhs);
   * system.evaluate(damage, at_points, at_boundary_points);
   * @endcode
   */
  template <int dim>
  class DamageSystem
  {
  public:
    using Pattern = typename PointGroups<dim>::Pattern;

    /**
     * Constructor.
     *
     * @param fracture_energy $G_c$, energy per area
     * @param length_scale $l$
     */
    DamageSystem(const double fracture_energy, const double length_scale);

    /** Prepare for a load step. See DisplacementSystem::reinit(). */
    bool
    reinit(const CellPoints<dim>           &points,
           const CellPoints<dim>           &boundary_points,
           const SplineSpace<dim>          &space,
           const AffineConstraints<double> &constraints,
           const std::vector<Pattern>      &patterns,
           const std::vector<Pattern>      &boundary_patterns);

    /** Return a zero vector of the right distribution. */
    LA::FieldVector
    make_vector() const;

    /**
     * Give @p vector the right distribution, and set it to zero. An assignment
     * from make_vector() is not the same: if both vectors own the same range,
     * deal.II keeps the ghost entries of the one on the left.
     */
    void
    initialize_vector(LA::FieldVector &vector) const;

    /**
     * Assemble matrix and right hand side. Collective.
     *
     * @param state the material points; the history field is used, the damage
     *   is not
     * @param boundary the boundary points
     * @param boundary_driving the factor $\mathbf w\cdot\mathbf P^+\mathbf N$
     *   at the boundary points, or an empty array to leave the term out
     * @param right_hand_side is overwritten
     */
    void
    assemble(const MaterialState<dim>  &state,
             const BoundaryState<dim>  &boundary,
             const std::vector<double> &boundary_driving,
             LA::FieldVector           &right_hand_side);

    /** The matrix of the last call of assemble(). */
    const LA::SparseMatrix &
    matrix() const;

    /**
     * Evaluate the damage at material and boundary points, as it is: a spline
     * may leave $[0,1]$.
     */
    void
    evaluate(const LA::FieldVector &damage,
             std::vector<double>   &at_points,
             std::vector<double>   &at_boundary_points) const;

    /**
     * Compute the regularised crack area, $\sum_p V_0\gamma$; times $G_c$ it
     * is the fracture energy. Collective.
     */
    double
    crack_area(const MaterialState<dim> &state,
               const LA::FieldVector    &damage) const;

    /** The energy release rate $G_c$. */
    double
    fracture_energy() const;

    /** The length scale $l$. */
    double
    length_scale() const;

    /** The space of the damage. */
    const SplineSpace<dim> &
    space() const;

  private:
    /**
     * Resolve constraints and add a local vector, and a local matrix of which
     * the upper half is there.
     */
    void
    distribute(const PointGroups<dim>                 &groups,
               const typename PointGroups<dim>::Group &group,
               const unsigned int                      list,
               double                                 *matrix,
               const double                           *vector,
               LA::FieldVector                        &right_hand_side);

    const double Gc;
    const double l;

    const CellPoints<dim>  *points          = nullptr;
    const CellPoints<dim>  *boundary_points = nullptr;
    const SplineSpace<dim> *spline_space    = nullptr;
    unsigned int            n_changes       = 0;

    PointGroups<dim> material_groups;
    PointGroups<dim> boundary_groups;

    std::shared_ptr<const Utilities::MPI::Partitioner> functions;

    SystemMatrix system_matrix;

    /** Arrays of the loop over the groups, allocated once. */
    std::vector<double> X, product, local_vector;
    ExtensionProduct<1> extension_product;
  };
} // namespace EBSMPM

#endif
