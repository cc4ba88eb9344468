// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Keep a header of boost from reporting what another one does.
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#  define BOOST_BIND_GLOBAL_PLACEHOLDERS
#endif

#include <ebsmpm/base/parameter_catalogue.h>
#include <ebsmpm/base/text.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <regex>
#include <sstream>
#include <utility>

namespace EBSMPM
{
  using namespace Text;

  namespace
  {
    using Tree = boost::property_tree::ptree;

    /**
     * The number of letters to be inserted, removed or exchanged (Levenshtein's
     * distance). The case of letters does not count.
     */
    unsigned int
    distance(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const bool equal =
                std::tolower(static_cast<unsigned char>(a[i])) ==
                std::tolower(static_cast<unsigned char>(b[j]));
              const unsigned int exchanged = diagonal + (equal ? 0 : 1);
              diagonal                     = row[j + 1];
              row[j + 1] = std::min({exchanged, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row[b.size()];
    }



    /**
     * The part of a parameter's full name behind the last slash.
     */
    std::string
    last_part(const std::string &name)
    {
      return name.substr(name.rfind('/') + 1);
    }



    /**
     * Return up to three of @p candidates that look like @p name, the best
     * first.
     */
    std::vector<std::string>
    similar(const std::string &name, const std::vector<std::string> &candidates)
    {
      // A name that is right but for its section is as good as one with a
      // single wrong letter.
      std::vector<std::pair<unsigned int, std::string>> ranking;
      for (const std::string &candidate : candidates)
        {
          const unsigned int whole = distance(name, candidate);
          const unsigned int last =
            distance(last_part(name), last_part(candidate));
          if (whole <= 1 + name.size() / 5)
            ranking.emplace_back(whole, candidate);
          else if (last <= last_part(name).size() / 5)
            ranking.emplace_back(last + 1, candidate);
        }
      std::sort(ranking.begin(), ranking.end());
      if (ranking.size() > 3)
        ranking.resize(3);

      std::vector<std::string> result;
      for (const auto &entry : ranking)
        result.push_back(quote(entry.second));
      return result;
    }
  } // namespace



  ParameterCatalogue::ParameterCatalogue(const ParameterHandler &prm)
  {
    // There is no interface that lists the parameters; a JSON file has them
    // all, with the patterns.
    std::stringstream stream;
    prm.print_parameters(stream, ParameterHandler::JSON);
    Tree tree;
    boost::property_tree::read_json(stream, tree);
    collect(tree, "");
  }



  void
  ParameterCatalogue::collect(const Tree &tree, const std::string &prefix)
  {
    for (const auto &[key, child] : tree)
      {
        const std::string name = prefix + key;
        if (child.count("value") > 0)
          patterns[name] = child.get<std::string>("pattern_description", "");
        else if (const auto alias = child.get_optional<std::string>("alias"))
          {
            const Tree &original = tree.find(*alias)->second;
            patterns[name] =
              original.get<std::string>("pattern_description", "");
          }
        else
          {
            sections.push_back(name);
            collect(child, name + '/');
          }
      }
  }



  bool
  ParameterCatalogue::has(const std::string &name) const
  {
    return patterns.count(name) > 0;
  }



  std::string
  ParameterCatalogue::allowed(const std::string &name) const
  {
    return allowed_by(patterns.at(name));
  }



  std::string
  ParameterCatalogue::unknown(const std::string &name) const
  {
    if (std::find(sections.begin(), sections.end(), name) != sections.end())
      return quote(name) + " is a section, not a parameter";

    std::vector<std::string> names;
    for (const auto &entry : patterns)
      names.push_back(entry.first);

    const std::vector<std::string> suggestions = similar(name, names);
    std::string text = "there is no parameter " + quote(name);
    if (!suggestions.empty())
      text += "; did you mean " + enumerate(suggestions, "or") + "?";
    return text;
  }



  std::string
  ParameterCatalogue::unknown_section(const std::string &name) const
  {
    const std::vector<std::string> suggestions = similar(name, sections);
    std::string                    text = "there is no section " + quote(name);
    if (!suggestions.empty())
      text += "; did you mean " + enumerate(suggestions, "or") + "?";
    return text;
  }



  std::string
  ParameterCatalogue::allowed_by(const std::string &pattern)
  {
    std::smatch match;

    const auto range =
      [](const std::string &kind, std::string low, std::string high) {
        if (low == "-MAX_DOUBLE" || low == "-2147483648")
          low.clear();
        if (high == "MAX_DOUBLE" || high == "2147483647")
          high.clear();
        if (!low.empty() && !high.empty())
          return kind + " from " + low + " to " + high;
        if (!low.empty())
          return kind + " of at least " + low;
        if (!high.empty())
          return kind + " of at most " + high;
        return kind;
      };
    const std::string range_regex = R"((\S+)\.\.\.(\S+) \(inclusive\)\])";
    if (std::regex_match(pattern,
                         match,
                         std::regex(R"(\[Double )" + range_regex)))
      return range("a number", match[1], match[2]);
    if (std::regex_match(pattern,
                         match,
                         std::regex(R"(\[Integer range )" + range_regex)))
      return range("a whole number", match[1], match[2]);
    if (pattern == "[Double]")
      return "a number";
    if (pattern == "[Integer]")
      return "a whole number";
    if (pattern == "[Bool]")
      return "'true' or 'false'";

    if (std::regex_match(pattern,
                         match,
                         std::regex(R"(\[(Multiple)?Selection ((?:.|\n)*)\])")))
      {
        std::vector<std::string> choices =
          Utilities::split_string_list(match[2], '|');
        for (std::string &choice : choices)
          choice = quote(choice);
        return match[1].matched ?
                 "a list of any of " + enumerate(choices, "and") :
                 enumerate(choices, "or");
      }

    if (std::regex_match(
          pattern,
          match,
          std::regex(
            R"(\[List of <(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\))"
            R"((?: separated by <(.*)>)?\])")))
      {
        std::string text = "a list of ";
        if (match[2] == match[3])
          text += match[2].str() + " entries";
        else if (match[3] == "4294967295")
          text += match[2] == "0" ? "entries" :
                                    "at least " + match[2].str() + " entries";
        else
          text += match[2].str() + " to " + match[3].str() + " entries";
        text += ", separated by '" +
                (match[4].matched ? match[4].str() : std::string(",")) + "'";
        if (match[1] != "[Anything]")
          text += ", each " + allowed_by(match[1]);
        return text;
      }

    return "a value that matches " + in_one_line(pattern);
  }
} // namespace EBSMPM
