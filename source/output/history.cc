// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/history.h>
#include <ebsmpm/output/history_table.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <system_error>

namespace EBSMPM
{
  namespace
  {
    std::string
    header_line(const std::vector<std::string> &names)
    {
      std::string line;
      for (const std::string &name : names)
        line += (line.empty() ? "" : ",") + name;
      return line + '\n';
    }



    std::string
    to_text(const double number)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.12g", number);
      return text;
    }
  } // namespace



  HistoryWriter::HistoryWriter(const std::string              &filename,
                               const std::vector<std::string> &columns,
                               const MPI_Comm                  communicator)
    : filename(filename)
    , column_names({"step", "displacement", "force"})
    , communicator(communicator)
    , size(0)
  {
    column_names.insert(column_names.end(), columns.begin(), columns.end());

    std::set<std::string> seen;
    for (const std::string &name : column_names)
      {
        AssertThrow(!name.empty() &&
                      name.find_first_of(",\"\n\r") == std::string::npos,
                    ExcInput("A column of the history cannot be called '" +
                             name +
                             "': the name must not be empty or contain "
                             "commas, quotation marks or ends of lines."));
        AssertThrow(seen.insert(name).second,
                    ExcInput("The history has two columns called '" + name +
                             "'."));
      }
  }



  HistoryWriter::HistoryWriter(const std::string              &filename,
                               const std::vector<std::string> &columns,
                               const MPI_Comm                  communicator,
                               const Overwrite                 overwrite)
    : HistoryWriter(filename, columns, communicator)
  {
    std::string problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::error_code error;
        if (overwrite == Overwrite::no &&
            std::filesystem::exists(filename, error))
          problem =
            "exists already: choose another folder, or allow to overwrite it";
        else
          {
            file.open(filename, std::ios::trunc);
            problem = append(header_line(column_names));
          }
      }

    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(filename, problem));
  }



  HistoryWriter
  HistoryWriter::resume(const std::string              &filename,
                        const std::vector<std::string> &columns,
                        const MPI_Comm                  communicator,
                        const unsigned int              last_step)
  {
    HistoryWriter writer(filename, columns, communicator);

    std::string problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        HistoryTable table;
        problem = table.try_to_read(filename);
        if (problem.empty() && table.names != writer.column_names)
          problem = "has other columns than this run and cannot be continued";
        if (problem.empty())
          problem = writer.replace(table, last_step);
      }

    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(filename, problem));
    return writer;
  }



  void
  HistoryWriter::write(const unsigned int         step,
                       const double               displacement,
                       const double               force,
                       const std::vector<double> &values)
  {
    AssertDimension(values.size() + 3, column_names.size());

    std::vector<double> numbers = {displacement, force};
    numbers.insert(numbers.end(), values.begin(), values.end());

    std::string not_finite, problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::string line = std::to_string(step);
        for (unsigned int i = 0; i < numbers.size(); ++i)
          {
            if (!std::isfinite(numbers[i]) && not_finite.empty())
              not_finite = "The value of '" + column_names[i + 1] +
                           "' in step " + std::to_string(step) + " is " +
                           to_text(numbers[i]) + ".";
            line += ',' + to_text(numbers[i]);
          }
        if (not_finite.empty())
          problem = append(line + '\n');
      }

    not_finite = first_message(not_finite, communicator);
    AssertThrow(not_finite.empty(), ExcSolverFailure(not_finite));
    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcFile(filename, problem));
  }



  const std::vector<std::string> &
  HistoryWriter::names() const
  {
    return column_names;
  }



  std::string
  HistoryWriter::replace(const HistoryTable &table,
                         const unsigned int  last_step)
  {
    std::string text       = header_line(table.names);
    double      final_step = 0;
    for (unsigned int i = 0; i < table.rows.size(); ++i)
      if (table.rows[i][0] <= last_step)
        {
          text += table.lines[i] + '\n';
          final_step = table.rows[i][0];
        }
    if (final_step != last_step)
      return "has no line for step " + std::to_string(last_step) +
             ", after which it is to be continued";

    // The old file stays until the new one is complete: the table of a long
    // run must not be lost to a full disk.
    const std::string temporary = filename + ".new";
    std::ofstream     new_file(temporary, std::ios::trunc);
    new_file << text << std::flush;
    if (!new_file)
      return "cannot be rewritten (is the disk full?)";
    new_file.close();

    std::error_code error;
    std::filesystem::rename(temporary, filename, error);
    if (error)
      return "cannot be replaced: " + error.message();

    file.open(filename, std::ios::app);
    size = text.size();
    return append("");
  }



  std::string
  HistoryWriter::append(const std::string &text)
  {
    if (!file.is_open())
      return "cannot be created (does its folder exist, and is it writable?)";

    file << text << std::flush;
    if (file)
      {
        size += text.size();
        return "";
      }

    file.close();
    std::error_code error;
    std::filesystem::resize_file(filename, size, error);
    return "cannot be written (is the disk full?)";
  }
} // namespace EBSMPM
