// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>
#include <ebsmpm/solvers/dirichlet_conditions.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace EBSMPM
{
  template <int dim>
  DirichletConditions<dim>::DirichletConditions(
    const std::string &             text,
    const std::vector<std::string> &boundary_names)
  {
    const std::string coordinates = "xyz";
    const std::string variables   = (dim == 2 ? "x,y,u" : "x,y,z,u");

    for (const auto &entry : Utilities::split_string_list(text, ';'))
      {
        const auto equal = entry.find('=');
        const auto dot   = entry.substr(0, equal).rfind('.');
        AssertThrow(equal != std::string::npos && dot != std::string::npos,
                    ExcInput("The Dirichlet condition '" + entry +
                             "' is not of the form 'boundary.component = "
                             "formula', for example 'top.y = u'."));
        const std::string name      = Utilities::trim(entry.substr(0, dot));
        const std::string component =
          Utilities::trim(entry.substr(dot + 1, equal - dot - 1));
        const std::string formula = Utilities::trim(entry.substr(equal + 1));

        const auto found =
          std::find(boundary_names.begin(), boundary_names.end(), name);
        AssertThrow(found != boundary_names.end(),
                    ExcInput("The Dirichlet condition '" + entry +
                             "' names the boundary '" + name +
                             "', but no boundary is called so."));
        const auto c = (component.size() == 1 ?
                          coordinates.substr(0, dim).find(component) :
                          std::string::npos);
        AssertThrow(c != std::string::npos,
                    ExcInput("The Dirichlet condition '" + entry +
                             "' names the component '" + component +
                             "', but components are called x, y" +
                             (dim == 3 ? ", z." : ".")));

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
                        ExcInput("The formula '" + formula +
                                 "' of the Dirichlet condition '" + entry +
                                 "' cannot be understood; it may contain " +
                                 variables + " and the usual functions."));
          }
        formulas[found - boundary_names.begin()][c] = std::move(parser);
      }
  }



  template <int dim>
  void
  DirichletConditions<dim>::apply(const double           load,
                                  const CellPoints<dim> &boundary_points,
                                  BoundaryState<dim> &   boundary) const
  {
    for (const auto &entry : formulas)
      for (const auto &formula : entry.second)
        if (formula)
          formula->set_time(load);

    for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
      {
        boundary.prescribed[q] = Tensor<1, dim>();
        boundary.constrained[q].fill(false);
        const auto found = formulas.find(boundary.boundary_id[q]);
        if (found == formulas.end())
          continue;
        const Point<dim> X =
          boundary_points.location(q) - boundary.displacement[q];
        for (unsigned int c = 0; c < dim; ++c)
          if (found->second[c])
            {
              boundary.constrained[q][c] = true;
              boundary.prescribed[q][c]  = found->second[c]->value(X);
            }
      }
  }



  template class DirichletConditions<2>;
  template class DirichletConditions<3>;
} // namespace EBSMPM
