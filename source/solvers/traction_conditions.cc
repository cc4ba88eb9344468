// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/solvers/traction_conditions.h>

namespace EBSMPM
{
  template <int dim>
  TractionConditions<dim>::TractionConditions(
    const std::string              &text,
    const std::vector<std::string> &boundary_names,
    const BoundaryFormulas<dim>    &displacements)
    : formulas("traction", text, boundary_names, "pressure")
  {
    for (unsigned int id = 0; id < boundary_names.size(); ++id)
      for (unsigned int c = 0; c <= dim; ++c)
        if (displacements.formula(id, c) != nullptr)
          for (unsigned int t = 0; t <= dim; ++t)
            AssertThrow(formulas.formula(id, t) == nullptr ||
                          (t != c && t != formulas.along_normal &&
                           c != formulas.along_normal),
                        ExcInput("The boundary '" + boundary_names[id] +
                                 "' has a prescribed displacement " +
                                 (c == formulas.along_normal ?
                                    "along its normal and cannot have a "
                                    "traction." :
                                    "in direction " +
                                      std::string("xyz").substr(c, 1) +
                                      " and cannot have a traction there.")));
  }



  template <int dim>
  void
  TractionConditions<dim>::apply(const double           load,
                                 const CellPoints<dim> &boundary_points,
                                 BoundaryState<dim>    &boundary) const
  {
    formulas.set_load(load);
    for (unsigned int q = 0; q < boundary_points.n_points(); ++q)
      {
        const auto       id = boundary.boundary_id[q];
        const Point<dim> X =
          boundary_points.location(q) - boundary.displacement[q];
        Tensor<1, dim> &traction = boundary.traction[q];

        traction = Tensor<1, dim>();
        if (const auto *p = formulas.formula(id, formulas.along_normal))
          traction = -p->value(X) * boundary.normal[q];
        for (unsigned int c = 0; c < dim; ++c)
          if (const auto *formula = formulas.formula(id, c))
            traction[c] += formula->value(X);
      }
  }



  template class TractionConditions<2>;
  template class TractionConditions<3>;
} // namespace EBSMPM
