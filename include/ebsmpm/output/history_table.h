// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_history_table_h
#define ebsmpm_output_history_table_h

#include <ebsmpm/base/config.h>

#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * The contents of a file that HistoryWriter has written.
   *
   * For comparisons of runs, and for programs that evaluate a run when it is
   * over. Reading is local: every rank that calls read() opens the file.
   *
   * @code
   * const HistoryTable  history = HistoryTable::read("history.csv");
   * std::vector<double> forces  = history.column("force");
   * @endcode
   */
  class HistoryTable
  {
  public:
    /**
     * Read @p filename. A last line without its end, as it is left by a run
     * that was killed, is ignored. Throws ExcFile if the file cannot be opened,
     * or if a line is not made of as many numbers as there are names.
     */
    static HistoryTable
    read(const std::string &filename);

    /**
     * Fill this object as read() does, but instead of throwing return what is
     * wrong with the file, as the end of a sentence that starts with the file;
     * an empty string if nothing is.
     */
    std::string
    try_to_read(const std::string &filename);

    /**
     * The names of the columns.
     */
    std::vector<std::string> names;

    /**
     * The numbers, <code>rows[line][column]</code>.
     */
    std::vector<std::vector<double>> rows;

    /**
     * The lines as they are in the file, without their ends.
     */
    std::vector<std::string> lines;

    /**
     * Return the column @p name. Throws ExcInput if there is none.
     */
    std::vector<double>
    column(const std::string &name) const;
  };
} // namespace EBSMPM

#endif
