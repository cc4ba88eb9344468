// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_vtu_series_h
#define ebsmpm_output_vtu_series_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/output/files.h>
#include <ebsmpm/output/patches.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <utility>
#include <vector>

namespace EBSMPM
{
  /**
   * The graphics files of a run, for ParaView and VisIt: one set of VTU files
   * for each step that is written, and one PVD file that lists them all.
   *
   * A series called <tt>points</tt> consists of
   * @code
   * points.pvd                    what to open: all steps and their times
   * points_00010.pvtu             step 10: the list of its pieces
   * points_00010.0000.vtu         what rank 0 has of step 10
   * points_00010.0001.vtu
   * @endcode
   * PointWriter and GridWriter make the contents:
   * @code
   * VTUSeries series(directory, "points", communicator, Overwrite::no);
   * for (...)
   *   writer.write(handler, series, step, time);
   * @endcode
   *
   * The PVD file is complete after each step, so that a run can be looked at
   * while it goes on. A run that is continued after a step uses resume(),
   * which forgets the steps that are going to be repeated.
   *
   * All functions are collective; each rank writes its own piece, nothing is
   * gathered, and ranks that have nothing write no file. What goes wrong on one
   * rank is thrown on all.
   */
  class VTUSeries
  {
  public:
    /**
     * Constructor for a series called @p name in the folder @p directory, which
     * must exist. Throws ExcFile if there is such a series, unless it may be
     * overwritten; its PVD file is then removed.
     */
    VTUSeries(const std::string &directory,
              const std::string &name,
              const MPI_Comm     communicator,
              const Overwrite    overwrite);

    /**
     * Return the series @p name in the folder @p directory as an earlier run
     * left it after @p last_step; later steps are removed from its PVD file.
     * Throws ExcFile if there is no such series.
     */
    static VTUSeries
    resume(const std::string &directory,
           const std::string &name,
           const MPI_Comm     communicator,
           const unsigned int last_step);

    /**
     * Write @p patches as the contents of @p step. @p time is what is shown as
     * time in the graphics program; the prescribed displacement is often more
     * telling. Throws ExcFile if a file cannot be written.
     */
    template <int dim, int spacedim>
    void
    write(Patches<dim, spacedim> &patches,
          const unsigned int      step,
          const double            time);

    /**
     * Return the communicator.
     */
    MPI_Comm
    get_communicator() const;

    /**
     * Return the times and names of files of all steps; on rank 0 only, it is
     * empty on others.
     */
    const std::vector<std::pair<double, std::string>> &
    get_records() const;

  private:
    VTUSeries(const std::string &directory,
              const std::string &name,
              const MPI_Comm     communicator);

    /**
     * Return the full name of @p file.
     */
    std::string
    path(const std::string &file) const;

    /**
     * Write the PVD file, and return what went wrong.
     */
    std::string
    write_records() const;

    /**
     * Read the PVD file up to @p last_step, and return what went wrong.
     */
    std::string
    read_records(const unsigned int last_step);

    std::string directory;
    std::string name;
    MPI_Comm    communicator;

    std::vector<std::pair<double, std::string>> records;
  };
} // namespace EBSMPM

#endif
