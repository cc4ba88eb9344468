// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/history_table.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace EBSMPM
{
  namespace
  {
    std::vector<std::string>
    split(const std::string &line)
    {
      std::vector<std::string> entries;
      std::istringstream       stream(line);
      for (std::string entry; std::getline(stream, entry, ',');)
        entries.push_back(entry);
      return entries;
    }
  } // namespace



  HistoryTable
  HistoryTable::read(const std::string &filename)
  {
    HistoryTable      table;
    const std::string problem = table.try_to_read(filename);
    AssertThrow(problem.empty(), ExcFile(filename, problem));
    return table;
  }



  std::string
  HistoryTable::try_to_read(const std::string &filename)
  {
    names.clear();
    rows.clear();
    lines.clear();

    std::ifstream file(filename);
    if (!file)
      return "cannot be opened";

    // A getline() that meets the end of the file has not met the end of the
    // line: the line is incomplete.
    std::string line;
    if (std::getline(file, line) && !file.eof())
      names = split(line);
    if (names.empty())
      return "has no line with the names of columns";

    while (std::getline(file, line) && !file.eof())
      {
        const std::string where = " in line " + std::to_string(rows.size() + 2);
        std::vector<double> row;
        for (const std::string &entry : split(line))
          {
            char        *end   = nullptr;
            const double value = std::strtod(entry.c_str(), &end);
            if (end == entry.c_str() || *end != '\0')
              return "has the entry '" + entry + "', which is not a number," +
                     where;
            row.push_back(value);
          }
        if (row.size() != names.size())
          return "has " + std::to_string(row.size()) + " numbers" + where +
                 ", but names " + std::to_string(names.size()) + " columns";

        rows.push_back(row);
        lines.push_back(line);
      }

    return "";
  }



  std::vector<double>
  HistoryTable::column(const std::string &name) const
  {
    const auto position = std::find(names.begin(), names.end(), name);
    AssertThrow(position != names.end(),
                ExcInput("The history has no column '" + name + "'."));

    std::vector<double> result;
    for (const std::vector<double> &row : rows)
      result.push_back(row[position - names.begin()]);
    return result;
  }
} // namespace EBSMPM
