// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_history_h
#define ebsmpm_output_history_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/output/files.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace EBSMPM
{
  class HistoryTable;

  /**
   * Writer of the table with one line per load step: the load-displacement
   * curve, and whatever else a program wants to follow.
   *
   * The file is plain CSV: a first line with the names of the columns, then
   * numbers with twelve digits. The first three columns are <tt>step</tt>,
   * <tt>displacement</tt> and <tt>force</tt>; the others are named once, in the
   * constructor. HistoryTable reads the file back, PointWriter and GridWriter
   * write the fields that belong to a step.
   *
   * @code
   * HistoryWriter history(directory + "/history.csv",
   *                       {"elastic energy", "crack length"},
   *                       communicator,
   *                       Overwrite::no);
   * for (...)
   *   history.write(step, displacement, force, {energy, length});
   * @endcode
   *
   * The file holds whole lines of finite numbers at any time: a line is
   * flushed when it is written, a NaN or an infinity is refused with an
   * exception before anything is written, and what a full disk has left of a
   * line is cut off.
   *
   * A run that is continued after a step uses resume(), which removes the lines
   * of the steps that are going to be repeated.
   *
   * All functions are collective. Only rank 0 touches the file, and only the
   * numbers of rank 0 count; but what goes wrong is thrown on all ranks.
   */
  class HistoryWriter
  {
  public:
    /**
     * Constructor. Creates the file and writes the names of the columns. Throws
     * ExcFile if the file exists and must not be overwritten, or cannot be
     * created, and ExcInput for a name in @p columns that is empty, appears
     * twice or contains a comma, a quotation mark or the end of a line.
     */
    HistoryWriter(const std::string              &filename,
                  const std::vector<std::string> &columns,
                  const MPI_Comm                  communicator,
                  const Overwrite                 overwrite);

    /**
     * Return a writer that continues the existing file @p filename after the
     * line of @p last_step: later lines are removed. Throws ExcFile if the
     * file cannot be read, has other columns, or ends before
     * @p last_step. A table without lines can be continued after step 0.
     */
    static HistoryWriter
    resume(const std::string              &filename,
           const std::vector<std::string> &columns,
           const MPI_Comm                  communicator,
           const unsigned int              last_step);

    /**
     * Write one line. @p values has one number for each of the names given to
     * the constructor. The numbers of the steps must increase from line to
     * line.
     *
     * Throws ExcSolverFailure for a number that is not finite, leaving the file
     * as it is, and ExcFile if the line cannot be written.
     */
    void
    write(const unsigned int         step,
          const double               displacement,
          const double               force,
          const std::vector<double> &values = {});

    /**
     * Return the names of all columns.
     */
    const std::vector<std::string> &
    names() const;

  private:
    /**
     * Constructor that leaves the file alone.
     */
    HistoryWriter(const std::string              &filename,
                  const std::vector<std::string> &columns,
                  const MPI_Comm                  communicator);

    /**
     * Replace the file by the lines of @p table up to @p last_step, open it for
     * more, on rank 0, and return what went wrong.
     */
    std::string
    replace(const HistoryTable &table, const unsigned int last_step);

    /**
     * Append @p text to the file, on rank 0, and return what went wrong.
     */
    std::string
    append(const std::string &text);

    const std::string        filename;
    std::vector<std::string> column_names;
    MPI_Comm                 communicator;

    /**
     * Open on rank 0 only.
     */
    std::ofstream file;

    /**
     * The size of the file up to the end of its last whole line.
     */
    std::uintmax_t size;
  };
} // namespace EBSMPM

#endif
