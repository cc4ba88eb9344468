// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_simulation_h
#define ebsmpm_solvers_simulation_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/materials/degradation.h>
#include <ebsmpm/materials/material.h>

#include <ebsmpm/particles/boundary_points.h>
#include <ebsmpm/particles/material_points.h>
#include <ebsmpm/particles/shape.h>

#include <ebsmpm/solvers/dirichlet_conditions.h>
#include <ebsmpm/solvers/parameters.h>
#include <ebsmpm/solvers/staggered_step.h>

#include <ebsmpm/output/files.h>
#include <ebsmpm/output/history.h>
#include <ebsmpm/output/vtu_series.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <boost/signals2.hpp>

#include <fstream>
#include <memory>

namespace EBSMPM
{
  /**
   * A whole run from a parameter file: grid, body, notch, load steps with
   * cut-back, and output.
   *
   * This is what the program <tt>ebsmpm</tt> runs. It contains no numerics; all
   * of that is in StaggeredStep and below. See Parameters for what can be
   * chosen.
   *
   * Load steps follow the table of increments. When a step fails, the increment
   * is halved; when the following steps are easy, it grows again up to that of
   * the table. Everything is written by the processes together, into the folder
   * "Output/Directory": <tt>history.csv</tt> with a line per step,
   * <tt>points.pvd</tt> and <tt>grid.pvd</tt> with the fields, the parameters
   * in <tt>parameters.prm</tt> and a log with a line per step in
   * <tt>log.txt</tt>.
   */
  template <int dim>
  class Simulation
  {
  public:
    /**
     * Constructor. Nothing is computed or written yet.
     *
     * @param parameters must live as long as this object
     * @param communicator the processes
     * @param overwrite whether results of an earlier run may be overwritten
     * @param screen where the log goes in addition; may be null
     */
    Simulation(const Parameters &parameters,
               const MPI_Comm    communicator,
               const Overwrite   overwrite,
               std::ostream     *screen);

    /** What others may do during a run. */
    struct Signals
    {
      /**
       * Called on all processes after a load step has been accepted, with its
       * number, the load, and how it went. The points are those of the end of
       * the step.
       */
      boost::signals2::signal<void(const unsigned int,
                                   const double,
                                   const typename StaggeredStep<dim>::Report &)>
        step_done;
    };

    /** Connect functions to these. */
    Signals signals;

    /** The material points, for functions that are called during a run. */
    const MaterialPoints<dim> &
    material_points() const;

    /** The force of the driven boundary in the last step. */
    double
    driven_force() const;

    /**
     * Run from the beginning to the end. Raises ExcStepFailure if a step fails
     * with the smallest increment; what was computed before is on disk then.
     */
    void
    run();

  private:
    void
    make_grid();
    void
    make_points();
    void
    make_notch();
    void
    open_files();
    void
    write_header();
    void
    write_step(const unsigned int                         n_step,
               const double                               load,
               const typename StaggeredStep<dim>::Report &report);
    void
    write_fields(const unsigned int n_step, const double load);

    /**
     * Distribute the grid anew if some process has more than its share of the
     * points, see "Background grid/Largest imbalance".
     */
    void
    balance(const unsigned int n_step);

    /** The largest number of points of a process, over the mean. */
    double
    imbalance() const;

    /** The increment of the table at a load, and the end of its interval. */
    std::pair<double, double>
    table_entry(const double load) const;

    const Parameters &parameters;
    const MPI_Comm    communicator;
    const Overwrite   overwrite;
    std::ofstream     log_file;

    parallel::distributed::Triangulation<dim> triangulation;
    const MappingCartesian<dim>               mapping;
    std::shared_ptr<const Shape<dim>>         body;
    MaterialPoints<dim>                       points;
    BoundaryPoints<dim>                       boundary_points;

    std::unique_ptr<Material<dim>>      material;
    const Degradation                   degradation;
    const DirichletConditions<dim>      conditions;
    const TractionConditions<dim>       tractions;
    double                              penalty = 0.;
    std::unique_ptr<StaggeredStep<dim>> step;

    std::unique_ptr<HistoryWriter> history;
    std::unique_ptr<VTUSeries>     point_series;
    std::unique_ptr<VTUSeries>     grid_series;
    double                         peak_force     = 0.;
    double                         last_force     = 0.;
    double                         last_imbalance = 1.;

    ConditionalOStream pcout;
    TimerOutput        timer;
    Timer              wall_clock;
  };
} // namespace EBSMPM

#endif
