// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/solvers/dirichlet_conditions.h>

#include <cmath>

namespace EBSMPM
{
  template <int dim>
  DirichletConditions<dim>::DirichletConditions(
    const std::string              &text,
    const std::vector<std::string> &boundary_names)
    : text_formulas("Dirichlet condition", text, boundary_names)
  {}



  template <int dim>
  void
  DirichletConditions<dim>::apply(const double           load,
                                  const CellPoints<dim> &boundary_points,
                                  BoundaryState<dim>    &boundary) const
  {
    text_formulas.set_load(load);
    for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
      {
        const Point<dim> X =
          boundary_points.location(q) - boundary.displacement[q];
        boundary.prescribed[q] = Tensor<1, dim>();
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto *formula =
              text_formulas.formula(boundary.boundary_id[q], c);
            boundary.constrained[q][c] = (formula != nullptr);
            if (formula != nullptr)
              boundary.prescribed[q][c] = formula->value(X);
          }
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
          for (unsigned int c = 0; c < dim; ++c)
            if (const auto *formula =
                  text_formulas.formula(boundary.boundary_id[q], c))
              result[q][c] += sign / (2. * step) *
                              formula->value(boundary_points.location(q) -
                                             boundary.displacement[q]);
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
