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

#include <cmath>

namespace EBSMPM
{
  template <int dim>
  DirichletConditions<dim>::DirichletConditions(
    const std::string              &text,
    const std::vector<std::string> &boundary_names)
    : text_formulas("Dirichlet condition", text, boundary_names, "normal")
  {
    for (unsigned int id = 0; id < boundary_names.size(); ++id)
      for (unsigned int c = 0; c < dim; ++c)
        AssertThrow(text_formulas.formula(id, c) == nullptr ||
                      text_formulas.formula(id, text_formulas.along_normal) ==
                        nullptr,
                    ExcInput("The displacement of the boundary '" +
                             boundary_names[id] +
                             "' is prescribed both along its normal and in "
                             "direction " +
                             std::string("xyz").substr(c, 1) +
                             "; it may be either the normal or components."));
  }



  template <int dim>
  template <typename Action>
  void
  DirichletConditions<dim>::for_each_direction(
    const CellPoints<dim>    &boundary_points,
    const BoundaryState<dim> &boundary,
    const unsigned int        q,
    const Action             &action) const
  {
    const Point<dim> X = boundary_points.location(q) - boundary.displacement[q];
    const auto       id = boundary.boundary_id[q];
    for (unsigned int c = 0; c < dim; ++c)
      if (const auto *formula = text_formulas.formula(id, c))
        action(Tensor<1, dim>(Point<dim>::unit_vector(c)), formula->value(X));
    if (const auto *formula =
          text_formulas.formula(id, text_formulas.along_normal))
      action(boundary.normal[q], formula->value(X));
  }



  template <int dim>
  void
  DirichletConditions<dim>::apply(const double           load,
                                  const CellPoints<dim> &boundary_points,
                                  BoundaryState<dim>    &boundary) const
  {
    text_formulas.set_load(load);
    for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
      {
        boundary.projection[q] = 0.;
        boundary.prescribed[q] = 0.;
        for_each_direction(boundary_points,
                           boundary,
                           q,
                           [&](const Tensor<1, dim> &direction,
                               const double          value) {
                             boundary.projection[q] +=
                               symmetrize(outer_product(direction, direction));
                             boundary.prescribed[q] += value * direction;
                           });
      }
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  DirichletConditions<dim>::rates(const double              load,
                                  const CellPoints<dim>    &boundary_points,
                                  const BoundaryState<dim> &boundary) const
  {
    const double step = (load != 0. ? 1e-5 * std::abs(load) : 1e-8);
    std::vector<Tensor<1, dim>> result(boundary_points.n_points());
    for (const double sign : {1., -1.})
      {
        text_formulas.set_load(load + sign * step);
        for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
          for_each_direction(boundary_points,
                             boundary,
                             q,
                             [&](const Tensor<1, dim> &direction,
                                 const double          value) {
                               result[q] +=
                                 sign / (2. * step) * value * direction;
                             });
      }
    return result;
  }



  template <int dim>
  const BoundaryFormulas<dim> &
  DirichletConditions<dim>::formulas() const
  {
    return text_formulas;
  }



  template class DirichletConditions<2>;
  template class DirichletConditions<3>;
} // namespace EBSMPM
