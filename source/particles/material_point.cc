// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/particles/material_point.h>

namespace EBSMPM
{
  template <int dim>
  void
  MaterialPoint<dim>::initialize(const double volume)
  {
    for (unsigned int i = 0; i < n_properties; ++i)
      values[i] = 0;
    reference_volume() = volume;
    damageable()       = 1;
    for (unsigned int d = 0; d < dim; ++d)
      values[6 + dim + d * dim + d] = 1;
  }



  template <int dim>
  std::vector<std::string>
  MaterialPoint<dim>::component_names()
  {
    std::vector<std::string> names = {"reference_volume",
                                      "damage",
                                      "history",
                                      "peak_damage",
                                      "label_frozen",
                                      "damageable"};
    names.insert(names.end(), dim, "displacement");
    names.insert(names.end(), dim * dim, "deformation_gradient");
    names.insert(names.end(), dim, "side");
    return names;
  }



  template <int dim>
  std::vector<DataComponentInterpretation::DataComponentInterpretation>
  MaterialPoint<dim>::component_interpretations()
  {
    using namespace DataComponentInterpretation;

    std::vector<DataComponentInterpretation::DataComponentInterpretation>
      interpretations(6, component_is_scalar);
    interpretations.insert(interpretations.end(),
                           dim,
                           component_is_part_of_vector);
    interpretations.insert(interpretations.end(),
                           dim * dim,
                           component_is_part_of_tensor);
    interpretations.insert(interpretations.end(),
                           dim,
                           component_is_part_of_vector);
    return interpretations;
  }



  template class MaterialPoint<2>;
  template class MaterialPoint<3>;
} // namespace EBSMPM
