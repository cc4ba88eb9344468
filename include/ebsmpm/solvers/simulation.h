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

#include <ebsmpm/output/checkpoint_folder.h>
#include <ebsmpm/output/files.h>
#include <ebsmpm/output/history.h>
#include <ebsmpm/output/vtu_series.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <boost/signals2.hpp>

#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

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
   *
   * A run can be continued by another one, on any number of processes, from its
   * last checkpoint, see the section "Checkpoint" of the parameters and
   * CheckpointFolder. A checkpoint consists of the grid with all points, as
   * deal.II writes them, a file with the StaggeredStep::Memory of each process,
   * and one with all else. Having written it, the run itself goes on from
   * nothing else: it makes its factorisations anew, and distributes the grid as
   * the continued run does. Therefore, on the same number of processes and with
   * the same interval, a run that is continued is the same, to the last digit,
   * as one that was never interrupted; unless no two runs are, as with MUMPS on
   * several processes. Otherwise, they differ as much as the tolerances of the
   * solvers allow.
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
       * the step. In a run that is continued, the first call is for the step
       * after the checkpoint.
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
     * Run from the beginning, or from the last checkpoint, to the end. Raises
     * ExcStepFailure if a step fails with the smallest increment; what was
     * computed before is on disk then. Raises ExcInput, ExcFile or ExcParameter
     * before anything is written if there is no checkpoint, or if it cannot be
     * read or is that of a different simulation.
     */
    void
    run();

  private:
    /** How far the run is. */
    struct Progress
    {
      unsigned int step           = 0;
      double       load           = 0.;
      double       last_increment = 0.;

      /** The largest increment to be tried next. */
      double allowed = std::numeric_limits<double>::max();

      double peak_force = 0.;
      double last_force = 0.;

      /** Seconds that earlier runs have taken to come here. */
      double wall_time = 0.;

      /** Write everything to an archive, or read it. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &step &load &last_increment &allowed &peak_force &last_force
          &wall_time;
      }
    };

    /** Make the coarse cells; return how often they are to be refined. */
    unsigned int
    make_coarse_grid();
    void
    make_grid();
    void
    make_points();
    void
    make_notch();
    void
    make_step();

    /** Prepare grid, points and step for the beginning, or a checkpoint. */
    void
    set_up();

    /**
     * Solve the next load step, in which the load grows by @p increment, and
     * accept it. Return whether that was possible; if not, a smaller increment
     * is to be tried.
     */
    bool
    advance(const double increment);

    /** Whether the force is as small as "Loading/Stop below" says. */
    bool
    is_broken() const;

    /** The columns of the history, without the first three. */
    std::vector<std::string>
    history_columns() const;

    void
    open_files();

    /** Write to screen and log. */
    void
    print(const std::string &text);
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

    /** Distribute the grid by the number of points. */
    void
    distribute_by_points();

    /** Write a checkpoint, and go on from it. */
    void
    write_checkpoint();

    /**
     * Return to the state of the last checkpoint. Nothing is written, and
     * nothing in the folder changed.
     */
    void
    read_checkpoint();

    /** What a checkpoint says once, for all processes. */
    struct Header;

    /** Read it; raise an exception if the checkpoint is not for this run. */
    void
    read_header(const std::string &folder, Header &header) const;

    /** Read what this process is to tell the others. */
    typename StaggeredStep<dim>::Memory
    read_memory(const std::string &folder, const unsigned int n_files) const;

    /** Continue the files of the run that has written the checkpoint. */
    void
    reopen_files();

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
    const CheckpointFolder         checkpoints;
    Progress                       progress;
    std::string                    failure;
    double                         last_imbalance = 1.;

    /** Whether the run that is continued has written fields. */
    bool had_point_series = false;
    bool had_grid_series  = false;

    ConditionalOStream pcout;
    TimerOutput        timer;
    Timer              wall_clock;
  };
} // namespace EBSMPM

#endif
