// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/solvers/boundary_formulas.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace EBSMPM
{
  template <int dim>
  BoundaryFormulas<dim>::BoundaryFormulas(
    const std::string              &name,
    const std::string              &text,
    const std::vector<std::string> &boundary_names,
    const std::string              &normal_name)
  {
    const std::string variables = (dim == 2 ? "x,y,u" : "x,y,z,u");

    std::vector<std::string> component_names = {"x", "y", "z"};
    component_names.resize(along_normal);
    component_names.push_back(normal_name);
    std::string list = component_names[0];
    for (unsigned int c = 1; c < component_names.size(); ++c)
      list += ", " + component_names[c];

    for (const auto &entry : Utilities::split_string_list(text, ';'))
      {
        const std::string what  = "The " + name + " '" + entry + "'";
        const auto        equal = entry.find('=');
        const auto        dot   = entry.substr(0, equal).rfind('.');
        AssertThrow(equal != std::string::npos && dot != std::string::npos,
                    ExcInput(what + " is not of the form 'boundary.component = "
                                    "formula', for example 'top.y = u'."));
        const std::string boundary = Utilities::trim(entry.substr(0, dot));
        const std::string component =
          Utilities::trim(entry.substr(dot + 1, equal - dot - 1));
        const std::string formula = Utilities::trim(entry.substr(equal + 1));

        const auto found =
          std::find(boundary_names.begin(), boundary_names.end(), boundary);
        AssertThrow(found != boundary_names.end(),
                    ExcInput(what + " names the boundary '" + boundary +
                             "', but no boundary is called so."));
        const auto c =
          std::find(component_names.begin(), component_names.end(), component);
        AssertThrow(c != component_names.end(),
                    ExcInput(what + " names the component '" + component +
                             "', but components are called " + list + "."));

        auto parser = std::make_unique<FunctionParser<dim>>(1);
        try
          {
            parser->initialize(variables,
                               formula,
                               {{"pi", numbers::PI}},
                               /*time_dependent=*/true);
            parser->set_time(0.);
            parser->value(Point<dim>());
          }
        catch (const std::exception &)
          {
            AssertThrow(false,
                        ExcInput("The formula '" + formula + "' of the " +
                                 name + " '" + entry +
                                 "' cannot be understood; it may contain " +
                                 variables + " and the usual functions."));
          }
        formulas[{static_cast<types::boundary_id>(found -
                                                  boundary_names.begin()),
                  static_cast<unsigned int>(c - component_names.begin())}] =
          std::move(parser);
      }
  }



  template <int dim>
  void
  BoundaryFormulas<dim>::set_load(const double load) const
  {
    for (const auto &entry : formulas)
      entry.second->set_time(load);
  }



  template <int dim>
  const FunctionParser<dim> *
  BoundaryFormulas<dim>::formula(const types::boundary_id id,
                                 const unsigned int       component) const
  {
    const auto found = formulas.find({id, component});
    return found == formulas.end() ? nullptr : found->second.get();
  }



  template class BoundaryFormulas<2>;
  template class BoundaryFormulas<3>;
} // namespace EBSMPM
