// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_displacement_system_h
#define ebsmpm_assembly_displacement_system_h

#include <ebsmpm/lac/system_matrix.h>
#include <ebsmpm/lac/types.h>

#include <ebsmpm/materials/degradation.h>
#include <ebsmpm/materials/material.h>

#include <ebsmpm/assembly/connected_pieces.h>
#include <ebsmpm/assembly/elastic_terms.h>
#include <ebsmpm/assembly/local_system.h>
#include <ebsmpm/assembly/nitsche_terms.h>
#include <ebsmpm/assembly/point_groups.h>
#include <ebsmpm/assembly/point_state.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/base/tensor_function.h>

#include <memory>
#include <vector>

namespace EBSMPM
{
  /**
   * The equation for the displacement increment of a load step: residual,
   * consistent tangent, and what is computed from its solution.
   *
   * The unknown is the increment $\Delta\mathbf u$ from the configuration
   * $\mathbf x_n$ at the start of the step, on which all integrals are written.
   * With $\mathbf F = (\mathbf I+\nabla_n\Delta\mathbf u)\mathbf F_n$ and
   * $\mathbf w=\mathbf\Pi(\mathbf u_n+\Delta\mathbf u-\bar{\mathbf u})$, where
   * $\mathbf\Pi$ projects onto the directions that are prescribed, the residual
   * is
   * @f[
   *   R(\delta\mathbf u) =
   *     \sum_p V_0\, (\mathbf P\mathbf F_n^T):\nabla_n\delta\mathbf u
   *   + \sum_b A_0\, \bigl[ \beta\, \mathbf w\cdot\delta\mathbf u
   *     - \delta\mathbf u\cdot\mathbf\Pi\mathbf P\mathbf N
   *     - \mathbf w\cdot(\mathbf A:\nabla_X\delta\mathbf u)\mathbf N
   *     - \mathbf t\cdot\delta\mathbf u \bigr],
   * @f]
   * (equation (6) of Sugai et al.; method, sections 1 and 3; $\mathbf t$ is a
   * given force per reference area), and the tangent
   * its exact derivative, including that of $\mathbf A$ in the last term. The
   * tangent is symmetric.
   *
   * Each group of points (see PointGroups) makes one dense matrix:
   * ElasticTerms and NitscheTerms compute it, for material and boundary points,
   * and LocalSystem adds it to the global one. Constraints are part of the
   * groups.
   *
   * @code
   * DisplacementSystem<dim> system(material, degradation, beta);
   * system.reinit(points, boundary_points, space, constraints, {}, {});
   * LA::FieldVector increment = system.make_vector(), residual = increment;
   * system.assemble_tangent(state, boundary, increment, residual);
   * solver.solve(system.matrix(), ...);
   * @endcode
   *
   * All functions that assemble are collective and leave ghost entries of the
   * residual zero. Nothing is allocated in the loop over points.
   */
  template <int dim>
  class DisplacementSystem
  {
  public:
    using Pattern = typename PointGroups<dim>::Pattern;

    /** Energies of the body; sums over all processes. */
    struct Energies
    {
      /** Stored energy, $\sum_p V_0\Psi^e$. */
      double elastic = 0.;

      /**
       * Energy of the boundary terms, $\sum_b A_0(\frac\beta2|\mathbf w|^2 -
       * \mathbf w\cdot\mathbf P\mathbf N)$.
       */
      double penalty = 0.;
    };

    /**
     * Constructor. The objects given must live as long as this one.
     *
     * @param material the elastic energy
     * @param degradation the function $g(d)$
     * @param penalty the factor $\beta$, stress per length
     */
    DisplacementSystem(const Material<dim> &material,
                       const Degradation   &degradation,
                       const double         penalty);

    /**
     * Prepare for a load step, or for a new space within it. The points must
     * not be sorted or removed while this object is in use. Return whether the
     * matrix has a new structure. Collective.
     *
     * @param points, @p boundary_points where the points are
     * @param space, @p constraints the functions
     * @param patterns, @p boundary_patterns which of them the points read, see
     *   PointGroups; may be empty
     */
    bool
    reinit(const CellPoints<dim>           &points,
           const CellPoints<dim>           &boundary_points,
           const SplineSpace<dim>          &space,
           const AffineConstraints<double> &constraints,
           const std::vector<Pattern>      &patterns,
           const std::vector<Pattern>      &boundary_patterns);

    /**
     * Find the pieces that the body has been cut into, and let those that are
     * free to move as rigid bodies have a small mass in these directions: the
     * residual gets the term $\sum_p V_0\,\rho\,\Delta\mathbf
     * u\cdot\mathbf D_p\,\delta\mathbf u$ there, with
     * $\rho=10^{-6}\,(K+\frac43G)/h^2$ and the
     * ConnectedPieces::free_directions() $\mathbf D_p$. It is what makes the
     * static problem solvable; as no load acts on such a piece, it stays where
     * it is, with the stress it has, and follows where it is held. reinit()
     * forgets the pieces if anything has changed; as long as they are known,
     * nothing is done. Collective.
     */
    void
    hold_free_pieces(const MaterialState<dim> &state,
                     const BoundaryState<dim> &boundary);

    /** What hold_free_pieces() has found. */
    const ConnectedPieces<dim> &
    pieces() const;

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
     * Hold all points on the branch of the energy split that they are on now,
     * see EnergyBranch, in residuals and tangents to come. At boundary points,
     * not only the tangent jumps between branches but, through the last term of
     * Nitsche's method, the residual itself: it may have no root.
     */
    void
    hold_branches(const MaterialState<dim> &state,
                  const BoundaryState<dim> &boundary,
                  const LA::FieldVector    &increment);

    /** Let the branches follow the state again. reinit() does that as well. */
    void
    release_branches();

    /** Compute the residual. The ghost entries of @p increment are updated. */
    void
    assemble_residual(const MaterialState<dim> &state,
                      const BoundaryState<dim> &boundary,
                      const LA::FieldVector    &increment,
                      LA::FieldVector          &residual) const;

    /** Compute the residual and the tangent matrix. */
    void
    assemble_tangent(const MaterialState<dim> &state,
                     const BoundaryState<dim> &boundary,
                     const LA::FieldVector    &increment,
                     LA::FieldVector          &residual);

    /**
     * The same, but right in the rows of some functions only, for which few
     * groups of points have to be looked at. What is in the other rows is of no
     * use.
     *
     * @param functions for each function that groups() of this process read,
     *   by its number there, whether its rows are wanted; the same on all
     *   processes that know it
     */
    void
    assemble_tangent(const MaterialState<dim> &state,
                     const BoundaryState<dim> &boundary,
                     const LA::FieldVector    &increment,
                     const std::vector<bool>  &functions,
                     LA::FieldVector          &residual);

    /**
     * The tangent without the derivative of $\mathbf A$ in the last term, which
     * is proportional to $\mathbf w$. It vanishes with $\mathbf w$ at the
     * solution; but where a step begins, $\mathbf w$ is as large as the
     * increment of the Dirichlet data, and the exact tangent is useless: for a
     * linear material, the predictor meets the data in one step.
     */
    void
    assemble_predictor(const MaterialState<dim> &state,
                       const BoundaryState<dim> &boundary,
                       const LA::FieldVector    &increment,
                       LA::FieldVector          &residual);

    /**
     * Subtract the virtual work of a body force per reference volume, given as
     * a function of the position at the start of the step.
     */
    void
    add_body_force(const MaterialState<dim>     &state,
                   const TensorFunction<1, dim> &force,
                   LA::FieldVector              &residual) const;

    /** The tangent, or predictor, that was assembled last. */
    const LA::SparseMatrix &
    matrix() const;

    /**
     * The increments of displacement and deformation at the material points,
     * or at the boundary points: $\Delta\mathbf u$ and $\mathbf F_{n+1}$.
     */
    struct Update
    {
      std::vector<Tensor<1, dim>> displacement_increment;
      std::vector<Tensor<2, dim>> F;
    };

    /** Compute what the material points are to become. */
    Update
    update_points(const MaterialState<dim> &state,
                  const LA::FieldVector    &increment) const;

    /** Compute what the boundary points are to become. */
    Update
    update_points(const BoundaryState<dim> &boundary,
                  const LA::FieldVector    &increment) const;

    /**
     * Compute $\Psi_0^+$ at the material points, which drives the damage.
     */
    void
    driving_energy(const Update        &update,
                   std::vector<double> &psi_degraded) const;

    /**
     * Compute the consistent flux $\mathbf f=\mathbf P\mathbf N-\beta\mathbf w$
     * at the boundary points, which are given @p update: what acts on the body,
     * per area, see BoundaryResultants. Points that are held on a branch stay
     * on it.
     */
    std::vector<Tensor<1, dim>>
    flux(const BoundaryState<dim> &boundary, const Update &update) const;

    /**
     * Compute the energies of the body when the points have been given their
     * updates. Collective.
     *
     * @param flux what flux() returns
     */
    Energies
    energies(const MaterialState<dim>          &state,
             const Update                      &update,
             const BoundaryState<dim>          &boundary,
             const Update                      &boundary_update,
             const std::vector<Tensor<1, dim>> &flux) const;

    /**
     * The shear driving the damage at boundary points, $\mathbf w\cdot\mathbf
     * P^+\mathbf N$, for the Nitsche term of the damage equation.
     */
    void
    boundary_driving(const BoundaryState<dim> &boundary,
                     const LA::FieldVector    &increment,
                     std::vector<double>      &driving) const;

    /** The distribution of the unknowns. */
    const std::shared_ptr<const Utilities::MPI::Partitioner> &
    partitioner() const;

    /** The space of the displacement. */
    const SplineSpace<dim> &
    space() const;

    /** The groups of material points. */
    const PointGroups<dim> &
    groups() const;

  private:
    /**
     * Compute the residual and #tangent: of all functions, if @p wanted is a
     * null pointer.
     */
    void
    assemble_matrix(const AssemblyTask        task,
                    const MaterialState<dim> &state,
                    const BoundaryState<dim> &boundary,
                    const LA::FieldVector    &increment,
                    LA::FieldVector          &residual,
                    const std::vector<bool>  *wanted = nullptr);

    /**
     * Compute the residual, or the tangent as well; @p matrix may be a null
     * pointer if it is not wanted, and so may @p wanted if all functions are.
     */
    void
    assemble(const AssemblyTask        task,
             const MaterialState<dim> &state,
             const BoundaryState<dim> &boundary,
             const LA::FieldVector    &increment,
             LA::FieldVector          &residual,
             SystemMatrix             *matrix,
             const std::vector<bool>  *wanted = nullptr) const;

    /**
     * Add the terms of all groups of points of this process, or of those that
     * read functions that are wanted.
     */
    void
    add_groups(const AssemblyTask        task,
               const MaterialState<dim> &state,
               const BoundaryState<dim> &boundary,
               const LA::FieldVector    &increment,
               LA::FieldVector          &residual,
               SystemMatrix             *matrix,
               const std::vector<bool>  *wanted) const;

    /** Add the mass of the points of group @p g, of a free piece, to #local. */
    void
    add_mass(const AssemblyTask        task,
             const MaterialState<dim> &state,
             const unsigned int        g) const;

    /** What the public functions of this name return, for points of a kind. */
    Update
    update_points(const CellPoints<dim>             &at,
                  const PointGroups<dim>            &groups,
                  const std::vector<Tensor<2, dim>> &F_n,
                  const LA::FieldVector             &increment) const;

    const Material<dim> &material;
    const Degradation   &degradation;
    const double         beta;

    const CellPoints<dim>  *points          = nullptr;
    const CellPoints<dim>  *boundary_points = nullptr;
    const SplineSpace<dim> *spline_space    = nullptr;
    unsigned int            n_changes       = 0;

    /** The branches of the points; empty unless they are held. */
    std::vector<EnergyBranch> branches;
    std::vector<EnergyBranch> boundary_branches;

    PointGroups<dim> material_groups;
    PointGroups<dim> boundary_groups;

    /**
     * For each group of material points, the group of boundary points that
     * reads the same functions, and the groups of boundary points without one.
     */
    std::vector<unsigned int> partners;
    std::vector<unsigned int> lone_boundary_groups;

    ConnectedPieces<dim> connected_pieces;

    std::shared_ptr<const Utilities::MPI::Partitioner> functions;
    std::shared_ptr<const Utilities::MPI::Partitioner> unknowns;

    SystemMatrix tangent;

    /** The terms; their arrays are allocated once per step. */
    mutable LocalSystem<dim>  local;
    mutable ElasticTerms<dim> elastic_terms;
    mutable NitscheTerms<dim> nitsche_terms;
  };
} // namespace EBSMPM

#endif
