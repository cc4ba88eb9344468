// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// What is worked out from the values of the parameters, and the checks of them.
// The sections are declared in parameters.cc.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/expression.h>

#include <ebsmpm/solvers/dirichlet_conditions.h>
#include <ebsmpm/solvers/parameters.h>
#include <ebsmpm/solvers/traction_conditions.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace EBSMPM
{
  double
  Parameters::number(const std::string &parameter,
                     const std::string &formula) const
  {
    // The cell size and the length scale are formulas themselves, in which the
    // other is not known.
    std::map<std::string, double> constants;
    if (parameter != "Background grid/Cell size")
      {
        constants["h"] = cell_size();
        if (parameter != "Damage/Length scale")
          constants["l"] = length_scale();
      }
    double result = 0.;
    try
      {
        result = Expression(formula, {}, constants).value({});
      }
    catch (const std::exception &)
      {
        AssertThrow(false,
                    ExcParameter(parameter,
                                 formula,
                                 "a number or a formula of one"));
      }
    AssertThrow(std::isfinite(result),
                ExcParameter(parameter, formula, "finite"));
    return result;
  }



  double
  Parameters::cell_size() const
  {
    const double h = number("Background grid/Cell size", grid.cell_size);
    AssertThrow(h > 0.,
                ExcParameter("Background grid/Cell size",
                             grid.cell_size,
                             "positive"));
    return h;
  }



  double
  Parameters::length_scale() const
  {
    const double l = number("Damage/Length scale", damage.length_scale);
    AssertThrow(l > 0.,
                ExcParameter("Damage/Length scale",
                             damage.length_scale,
                             "positive"));
    return l;
  }



  template <int dim>
  Point<dim>
  Parameters::point(const std::string &parameter,
                    const std::string &formulas) const
  {
    const auto entries = Utilities::split_string_list(formulas, ',');
    AssertThrow(entries.size() == dim,
                ExcParameter(parameter,
                             formulas,
                             "a list of " + std::to_string(dim) +
                               " coordinates, separated by commas"));
    Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = number(parameter, entries[d]);
    return result;
  }



  std::vector<std::pair<std::string, std::string>>
  Parameters::boundaries() const
  {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto &entry : Utilities::split_string_list(body.boundaries, ';'))
      {
        const auto colon = entry.find(':');
        AssertThrow(colon != std::string::npos,
                    ExcParameter("Body/Boundaries",
                                 body.boundaries,
                                 "a list of 'name: condition', separated by "
                                 "semicolons"));
        result.emplace_back(Utilities::trim(entry.substr(0, colon)),
                            Utilities::trim(entry.substr(colon + 1)));
      }
    return result;
  }



  std::vector<std::string>
  Parameters::boundary_names() const
  {
    std::vector<std::string> names;
    for (const auto &boundary : boundaries())
      names.push_back(boundary.first);
    if (has_faces())
      for (const auto &name : {"slit.lower", "slit.upper"})
        names.push_back(name);
    return names;
  }



  bool
  Parameters::has_faces() const
  {
    AssertThrow(!notch.faces || notch.type == "slit",
                ExcParameter("Notch/Faces",
                             "true",
                             "false unless 'Notch/Type' is slit"));
    return notch.faces;
  }



  std::vector<std::pair<double, double>>
  Parameters::increments() const
  {
    const std::string                      name = "Loading/Increments";
    std::vector<std::pair<double, double>> result;
    for (const auto &entry :
         Utilities::split_string_list(loading.increments, ','))
      {
        const auto colon = entry.find(':');
        AssertThrow(colon != std::string::npos,
                    ExcParameter(name,
                                 loading.increments,
                                 "a list of 'load: increment', separated by "
                                 "commas"));
        const double until     = number(name, entry.substr(0, colon));
        const double increment = number(name, entry.substr(colon + 1));
        AssertThrow(increment > 0. &&
                      until > (result.empty() ? 0. : result.back().first),
                    ExcParameter(name,
                                 loading.increments,
                                 "made of growing loads and positive "
                                 "increments"));
        result.emplace_back(until, increment);
      }
    AssertThrow(!result.empty(),
                ExcParameter(name, loading.increments, "a table of loads"));
    return result;
  }



  std::pair<unsigned int, unsigned int>
  Parameters::driven() const
  {
    if (Utilities::trim(loading.driven) == "load")
      return {numbers::invalid_unsigned_int, numbers::invalid_unsigned_int};
    const auto        dot  = loading.driven.rfind('.');
    const std::string name = Utilities::trim(loading.driven.substr(0, dot));
    const auto        list = boundary_names();
    for (unsigned int id = 0; id < list.size() && dot != std::string::npos;
         ++id)
      if (list[id] == name)
        {
          const auto component = std::string("xyz").find(
            Utilities::trim(loading.driven.substr(dot + 1)));
          if (component < grid.dimension)
            return {id, static_cast<unsigned int>(component)};
        }
    AssertThrow(false,
                ExcParameter("Loading/Driven boundary",
                             loading.driven,
                             "a boundary and a component, such as 'top.y', or "
                             "'load'"));
    return {};
  }



  void
  Parameters::check() const
  {
    cell_size();
    length_scale();
    number("Body/Boundary point spacing", body.spacing);
    number("Notch/Label width", notch.label_width);
    number("Notch/Label reach", notch.label_reach);
    number("Notch/Damage width", notch.damage_width);
    number("Notch/Tip margin", notch.tip_margin);
    increments();
    driven();
    const std::vector<std::string> names = boundary_names();
    if (grid.dimension == 2)
      {
        const auto lower =
          point<2>("Background grid/Lower corner", grid.lower_corner);
        const auto upper =
          point<2>("Background grid/Upper corner", grid.upper_corner);
        AssertThrow(upper[0] > lower[0] && upper[1] > lower[1],
                    ExcParameter("Background grid/Upper corner",
                                 grid.upper_corner,
                                 "larger than the lower corner in all "
                                 "directions"));
        const DirichletConditions<2> conditions(loading.conditions, names);
        TractionConditions<2>(loading.tractions, names, conditions.formulas());
      }
    else
      {
        const auto lower =
          point<3>("Background grid/Lower corner", grid.lower_corner);
        const auto upper =
          point<3>("Background grid/Upper corner", grid.upper_corner);
        AssertThrow(upper[0] > lower[0] && upper[1] > lower[1] &&
                      upper[2] > lower[2],
                    ExcParameter("Background grid/Upper corner",
                                 grid.upper_corner,
                                 "larger than the lower corner in all "
                                 "directions"));
        const DirichletConditions<3> conditions(loading.conditions, names);
        TractionConditions<3>(loading.tractions, names, conditions.formulas());
      }
    AssertThrow(!output.directory.empty(),
                ExcParameter("Output/Directory", "", "the name of a folder"));
  }



  template <int dim>
  typename StaggeredStep<dim>::AdditionalData
  Parameters::step_data() const
  {
    typename StaggeredStep<dim>::AdditionalData data;
    data.degree               = grid.degree;
    data.extension_threshold  = extension.threshold;
    data.extension_hysteresis = extension.hysteresis;
    data.damage               = damage.enable;
    data.damage_boundary_term = damage.boundary_term;
    data.max_passes           = staggered.maximum_passes;
    data.tolerance            = staggered.tolerance;
    data.max_relaxation       = staggered.relaxation;
    // A slit is part of the model, whether or not cracks become discrete: then,
    // without the transition, only what it labels at the start is separable.
    data.partition            = partition.enable || notch.type == "slit";
    data.max_partition_passes = partition.maximum_passes;
    // The ball has to be wider than the crest, which is as wide as the length
    // scale says.
    const unsigned int radius =
      partition.ridge_radius > 0 ?
        partition.ridge_radius :
        std::max(4U,
                 static_cast<unsigned int>(
                   std::ceil(1.5 * length_scale() / cell_size() - 1e-6)));
    data.partition_data =
      typename CrackPartition<dim>::AdditionalData(partition.damage_threshold,
                                                   partition.closure_damage,
                                                   partition.frozen_ratio,
                                                   radius);
    data.partition_data.grow               = partition.enable;
    data.partition_data.remainder_majority = partition.remainder_majority;
    data.newton                 = NewtonSolver::AdditionalData(newton.tolerance,
                                               newton.maximum_iterations,
                                               newton.maximum_bisections);
    data.intermediate_tolerance = newton.intermediate_tolerance;
    data.refuse_indefinite      = (newton.indefinite_tangent == "cut back");
    data.displacement_solver.method =
      LinearSolver::method_from_name(linear.displacement);
    data.displacement_solver.refresh_iterations = linear.refresh_iterations;
    data.displacement_solver.max_iterations     = linear.maximum_iterations;
    data.damage_solver                          = data.displacement_solver;
    data.damage_solver.method = LinearSolver::method_from_name(linear.damage);
    // The condition number of the damage matrix is about (l/h)^2, on any number
    // of cells; as long as this is not large, nothing beats a local method.
    if (data.damage_solver.method == LinearSolver::Method::automatic &&
        length_scale() < 20. * cell_size())
      data.damage_solver.method = LinearSolver::Method::cg_ic;
    return data;
  }



  template Point<2>
  Parameters::point<2>(const std::string &, const std::string &) const;
  template Point<3>
  Parameters::point<3>(const std::string &, const std::string &) const;
  template typename StaggeredStep<2>::AdditionalData
  Parameters::step_data<2>() const;
  template typename StaggeredStep<3>::AdditionalData
  Parameters::step_data<3>() const;
} // namespace EBSMPM
