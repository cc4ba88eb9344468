// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_staggered_step_h
#define ebsmpm_solvers_staggered_step_h

#include <ebsmpm/lac/linear_solver.h>

#include <ebsmpm/splines/extension.h>
#include <ebsmpm/splines/spline_space.h>

#include <ebsmpm/particles/boundary_points.h>
#include <ebsmpm/particles/material_points.h>

#include <ebsmpm/fracture/crack_opening.h>
#include <ebsmpm/fracture/crack_partition.h>

#include <ebsmpm/assembly/damage_system.h>
#include <ebsmpm/assembly/displacement_system.h>
#include <ebsmpm/assembly/field_snapshot.h>

#include <ebsmpm/solvers/dirichlet_conditions.h>
#include <ebsmpm/solvers/newton_solver.h>
#include <ebsmpm/solvers/nonlinear_elimination.h>
#include <ebsmpm/solvers/traction_conditions.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace EBSMPM
{
  /**
   * One load step: solve for damage and displacement in turns, and move the
   * points when the result is accepted.
   *
   * A step begins with the state on the points. From where these are follow the
   * functions, standard or deficient, of the damage and of the displacement;
   * then, in each pass of the staggered scheme,
   *
   * 1. the damage is solved for with the history field $\mathcal H$,
   * 2. the crack partition is brought up to date, and with it the space of the
   *    displacement,
   * 3. the displacement is solved for by Newton's method,
   * 4. $\mathcal H\leftarrow\max(\mathcal H_n,\Psi_0^+)$.
   *
   * The paper's algorithm (Miehe et al., 2010) is a single pass per step.
   * Otherwise, passes are repeated until the damage of no point changes by more
   * than AdditionalData::tolerance (alternate minimisation).
   *
   * Passes are many where a crack begins to run: after a few of them, the
   * updates of the damage, $\mathbf s_k$, are parallel, and get smaller (or, if
   * the equilibrium is unstable, larger) by a factor close to one each time. So
   * the damage goes by $\omega_k\mathbf s_k$, where
   * @f[
   *   \omega_k = \frac{\omega_{k-1}}{1-r_k}, \qquad
   *   r_k = \frac{\mathbf s_k\cdot\mathbf s_{k-1}}
   *              {\mathbf s_{k-1}\cdot\mathbf s_{k-1}}
   * @f]
   * leaves nothing of a single mode (Irons and Tuck, A version of the Aitken
   * accelerator for computer iteration, 1969; relaxation by that number is
   * common in fluid-structure interaction: Kuettler and Wall, 2008). It is
   * used as long as $\mathbf s_k$ and $\mathbf s_{k-1}$ enclose an angle of
   * less than 26 degrees, otherwise $\omega_k=1$; it grows by no more than a
   * factor of three, up to AdditionalData::max_relaxation, and not so far that
   * the damage changes by more than 0.15 at once. After twelve passes, in steps
   * in which the crack runs through the body, these are 60 degrees, nine, and
   * 0.5.
   *
   * The points are not touched before accept(). A step that fails, which
   * solve() reports by an exception of type ExcSolverFailure, therefore leaves
   * nothing to restore: call solve() again with a smaller load.
   *
   * @code
   * StaggeredStep<dim> step(points, boundary_points, material, degradation,
   *                         Gc, l, beta, data);
   * for (load : loads)
   *   {
   *     step.solve(conditions, load);
   *     std::cout << step.reactions(ids) << std::endl;
   *     step.accept();
   *   }
   * @endcode
   */
  template <int dim>
  class StaggeredStep
  {
  public:
    /** Parameters of the step. */
    struct AdditionalData
    {
      /** Degree of the splines. */
      unsigned int degree = 2;

      /** Occupied fraction $\phi_\text{cr}$ below which functions are
       * deficient. */
      double extension_threshold = 0.1;

      /** How far below it they may sink, see SplineSpace::reinit(). */
      double extension_hysteresis = 0.2;

      /** Whether there is a damage equation. */
      bool damage = true;

      /** Whether the damage equation has the boundary term. */
      bool damage_boundary_term = false;

      /** Number of passes; one is the algorithm of the paper. */
      unsigned int max_passes = 1;

      /** Change of the damage at which the passes have converged. */
      double tolerance = 1e-3;

      /** Largest factor of over-relaxation; one for none. */
      double max_relaxation = 100.;

      /** Whether diffusive cracks become discrete. */
      bool partition = false;

      /** Passes after which the partition stays as it is. */
      unsigned int max_partition_passes = 50;

      /** Parameters of the partition. */
      typename CrackPartition<dim>::AdditionalData partition_data;

      /** Parameters of Newton's method. */
      NewtonSolver::AdditionalData newton;

      /**
       * Whether a solution whose tangent has negative eigenvalues, i.e., an
       * equilibrium that is not stable, is a failure of the step.
       */
      bool refuse_indefinite = true;

      /** Tolerance of Newton's method while the passes have not converged. */
      double intermediate_tolerance = 1e-5;

      /** Parameters of the linear solvers. */
      LinearSolver::AdditionalData displacement_solver;
      LinearSolver::AdditionalData damage_solver;
    };

    /** How a step went. */
    struct Report
    {
      unsigned int passes            = 0;
      unsigned int newton_iterations = 0;
      unsigned int linear_iterations = 0;
      unsigned int refreshes         = 0;
      unsigned int bisections        = 0;
      bool         indefinite        = false;
      bool         indefinite_at_end = false;
      bool         smoothed          = false;
      double       damage_change     = 0.;
      double       residual          = 0.;

      /** Norms of the residual in the last Newton solve. */
      std::vector<double> residuals;

      /**
       * Pieces that the body is in, and those of them that nothing prevents
       * from moving, see ConnectedPieces.
       */
      unsigned int n_pieces      = 1;
      unsigned int n_free_pieces = 0;

      /** See CrackPartition::n_junctions(). */
      unsigned int n_junctions = 0;

      /** How far the lips of the cracks are apart at the end of the step. */
      CrackOpening opening;

      /** See BoundaryResultants::conjugate_force(). */
      double conjugate_force = 0.;

      /** See BoundaryResultants::opened_volume(), for the faces of a slit. */
      double opened_volume = 0.;
    };

    /**
     * What a step knows beyond what is on the points: which functions were
     * standard (see SplineSpace::reinit()), the fields that are a guess for the
     * next step, and to what residuals are compared. Fields and functions are
     * those of one process; those of all together can be handed over to any
     * other number of processes.
     */
    struct Memory
    {
      std::vector<FunctionKey<dim>>             standard_u;
      std::vector<FunctionKey<dim>>             standard_d;
      typename FieldSnapshot<dim>::Coefficients damage;
      typename FieldSnapshot<dim>::Coefficients last_increment;
      double                                    largest_force  = 0.;
      double                                    first_residual = 0.;

      /** Add what another process knew. */
      void
      append(const Memory &other);

      /** Write everything to an archive, or read it. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &standard_u &standard_d &damage &last_increment &largest_force
          &first_residual;
      }
    };

    /**
     * Constructor. All objects must live as long as this one.
     *
     * @param points, @p boundary_points carry the state
     * @param material, @p degradation the constitutive law
     * @param fracture_energy, @p length_scale of the damage
     * @param penalty the factor $\beta$ of Nitsche's method
     * @param data the parameters
     * @param timer may be null
     */
    StaggeredStep(MaterialPoints<dim>  &points,
                  BoundaryPoints<dim>  &boundary_points,
                  const Material<dim>  &material,
                  const Degradation    &degradation,
                  const double          fracture_energy,
                  const double          length_scale,
                  const double          penalty,
                  const AdditionalData &data,
                  TimerOutput          *timer = nullptr);

    /**
     * Let tractions act on the boundary, too.
     *
     * @param tractions must live as long as this object
     * @param faces the boundary ids of faces of cracks whose opened volume is
     *   reported
     */
    void
    set_tractions(const TractionConditions<dim>         &tractions,
                  const std::vector<types::boundary_id> &faces = {});

    /**
     * Solve for the state under the load @p load. Starts from the accepted
     * state, however often it is called. Collective.
     *
     * @param conditions the Dirichlet data
     * @param load the argument of the conditions and of the tractions
     * @param guess_factor ratio of this load increment to the last accepted
     *   one, by which the last increment of displacement is extrapolated for
     *   the initial guess; zero for none
     */
    Report
    solve(const DirichletConditions<dim> &conditions,
          const double                    load,
          const double                    guess_factor = 0.);

    /** Write the solution to the points and move them. Collective. */
    void
    accept();

    /**
     * Distribute the grid anew between two steps: call @p move, which is to do
     * this and to take the points along, and prepare for the next step. The
     * fields that are only a guess for it (the damage, the last increment) go
     * to the processes that need them now. Collective.
     */
    void
    repartition(const std::function<void()> &move);

    /**
     * Return what is not on the points, between two steps. Together with these
     * it is the whole state. Collective.
     */
    Memory
    memory() const;

    /**
     * Go on from the points as they are now, and what memory() has returned for
     * them, now or in another run, and on any number of processes. All else is
     * forgotten, even factorisations that could be used on: the following steps
     * depend on nothing else. Collective.
     */
    void
    recall(const Memory &memory);

    /** The reactions of all boundaries to the last solution, by boundary id. */
    const std::map<types::boundary_id, Tensor<1, dim>> &
    reactions() const;

    /** Elastic and boundary energies. Collective. */
    typename DisplacementSystem<dim>::Energies
    energies() const;

    /** The regularised area (2-D: length) of the crack. Collective. */
    double
    crack_area() const;

    /** The space of the displacement. */
    const SplineSpace<dim> &
    displacement_space() const;

    /** How the extension went. */
    const ExtensionReport &
    extension_report() const;

    /** The system of the displacement, and its state. */
    DisplacementSystem<dim> &
    displacement_system();
    const MaterialState<dim> &
    material_state() const;
    const BoundaryState<dim> &
    boundary_state() const;
    const LA::FieldVector &
    increment() const;

    /**
     * The coefficients of the damage that a cell sees, as GridWriter wants
     * them; nothing for cells without points. To be called between accept() and
     * the next solve(). Not collective: processes have different numbers of
     * cells.
     */
    void
    cell_damage(const typename Triangulation<dim>::active_cell_iterator &cell,
                std::vector<double> &coefficients) const;

  private:
    /**
     * Number the points where they are, collect their state, and give the
     * damage its values from before, as far as there are any.
     */
    void
    begin(const FieldSnapshot<dim> &old_damage);

    /** Number the points, and read what does not change within a step. */
    void
    number_points();

    /** Read damage, history and labels, which are iterated in a step. */
    void
    read_iterates();

    /** Write the solution to the points, and move these. */
    void
    move_points();

    /** Bring the crack partition up to date. Return whether it has changed. */
    bool
    update_partition();

    /**
     * Give the increment of displacement the space of today, its initial guess,
     * see solve(), and a scale for its residuals.
     */
    void
    begin_increment(const double guess_factor);

    /** Update the history field after a solve for the displacement. */
    void
    update_history();

    /** Build the space of the displacement for the current partition. */
    void
    build_displacement_space();

    /**
     * One solve for the damage; returns the largest change at a point. Factor
     * and update of the last pass are given, those of this pass returned.
     */
    double
    solve_damage(double          &relaxation,
                 LA::FieldVector &last_update,
                 Report          &report);

    /** Return the factor of over-relaxation for a pass, see the class. */
    double
    next_relaxation(const double           relaxation,
                    const unsigned int     pass,
                    const LA::FieldVector &update,
                    const LA::FieldVector &last_update) const;

    /**
     * One solve for the displacement, after which the residual is below
     * @p tolerance. If the partition has changed, the initial guess is bad
     * where it has; elsewhere it is good, unless @p from_zero.
     */
    void
    solve_displacement(const double tolerance,
                       const bool   partition_changed,
                       const bool   from_zero,
                       Report      &report);

    /** Measure the opening of the cracks at the end of the step. */
    CrackOpening
    opening() const;

    /** Sum up what acts on the boundary at the end of the step. */
    void
    sum_up_boundary(const DirichletConditions<dim> &conditions,
                    const double                    load,
                    Report                         &report);

    /** Raise ExcSolverFailure if the tangent at the solution is indefinite. */
    void
    check_stability();

    MaterialPoints<dim>         &material_points;
    BoundaryPoints<dim>         &boundary_material_points;
    const AdditionalData         data;
    std::unique_ptr<TimerOutput> own_timer;
    TimerOutput                 *timer;

    CellPoints<dim>     points;
    CellPoints<dim>     boundary_points;
    MaterialState<dim>  state;
    BoundaryState<dim>  boundary;
    CrackLabels<dim>    labels;
    CrackLabels<dim>    boundary_labels;
    std::vector<double> current_volume;
    std::vector<double> psi;

    /** Where the points get to in this step, up to the last pass. */
    typename DisplacementSystem<dim>::Update update;

    /** The same for the boundary points, at the end, and what acts on them. */
    typename DisplacementSystem<dim>::Update boundary_update;
    std::vector<Tensor<1, dim>>              flux;

    typename SplineSpace<dim>::SupportTable d_supports;

    SplineSpace<dim>          u_space;
    SplineSpace<dim>          d_space;
    AffineConstraints<double> u_constraints;
    AffineConstraints<double> d_constraints;
    ExtensionReport           u_extension;

    CrackPartition<dim>       partition;
    DisplacementSystem<dim>   u_system;
    DamageSystem<dim>         d_system;
    NewtonSolver              newton;
    NonlinearElimination<dim> elimination;
    LinearSolver              u_solver;
    LinearSolver              d_solver;

    LA::FieldVector    u_increment;
    LA::FieldVector    d_field;
    FieldSnapshot<dim> last_increment;
    bool               space_is_current = false;
    double             largest_force    = 0.;
    double             first_residual   = 0.;
    double             force_scale      = 0.;

    const TractionConditions<dim>               *tractions = nullptr;
    std::vector<types::boundary_id>              crack_faces;
    std::vector<types::boundary_id>              boundary_ids;
    std::map<types::boundary_id, Tensor<1, dim>> all_reactions;
  };
} // namespace EBSMPM

#endif
