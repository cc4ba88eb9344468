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

#include <ebsmpm/base/exceptions.h>
#include <ebsmpm/base/parameter_values.h>
#include <ebsmpm/base/text.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <sstream>

namespace EBSMPM
{
  namespace
  {
    void
    collect(const boost::property_tree::ptree &tree,
            const std::string                 &prefix,
            ParameterValues                   &values)
    {
      for (const auto &[key, child] : tree)
        if (child.count("value") > 0)
          values[prefix + key] = child.get<std::string>("value");
        else if (child.count("alias") == 0)
          collect(child, prefix + key + '/', values);
    }
  } // namespace



  ParameterValues
  parameter_values(const ParameterHandler &prm)
  {
    // As in ParameterCatalogue: only a JSON file has them all.
    std::stringstream stream;
    prm.print_parameters(stream, ParameterHandler::JSON);
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(stream, tree);
    ParameterValues values;
    collect(tree, "", values);
    return values;
  }



  void
  require_same_parameters(
    const ParameterValues                          &values,
    const ParameterValues                          &required,
    const std::function<bool(const std::string &)> &may_differ,
    const std::string                              &reason)
  {
    for (const auto &[name, value] : values)
      {
        const auto other = required.find(name);
        AssertThrow(other == required.end() || other->second == value ||
                      may_differ(name),
                    ExcParameter(name,
                                 value,
                                 Text::quote(other->second) + ", " + reason));
      }
  }
} // namespace EBSMPM
