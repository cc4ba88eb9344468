// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/particles/boundary_point.h>

namespace EBSMPM
{
  template <int dim>
  void
  BoundaryPoint<dim>::initialize(const double             area,
                                 const Tensor<1, dim>    &normal,
                                 const types::boundary_id id)
  {
    for (unsigned int i = 0; i < n_properties; ++i)
      values[i] = 0;
    reference_area() = area;
    set_boundary_id(id);
    set_reference_normal(normal);
    for (unsigned int d = 0; d < dim; ++d)
      values[5 + 2 * dim + d * dim + d] = 1;
  }



  template <int dim>
  std::vector<std::string>
  BoundaryPoint<dim>::component_names()
  {
    std::vector<std::string> names = {
      "reference_area", "boundary_id", "damage", "peak_damage", "label_frozen"};
    names.insert(names.end(), dim, "reference_normal");
    names.insert(names.end(), dim, "displacement");
    names.insert(names.end(), dim * dim, "deformation_gradient");
    names.insert(names.end(), dim, "side");
    return names;
  }



  template <int dim>
  std::vector<DataComponentInterpretation::DataComponentInterpretation>
  BoundaryPoint<dim>::component_interpretations()
  {
    using namespace DataComponentInterpretation;

    std::vector<DataComponentInterpretation::DataComponentInterpretation>
      interpretations(5, component_is_scalar);
    interpretations.insert(interpretations.end(),
                           2 * dim,
                           component_is_part_of_vector);
    interpretations.insert(interpretations.end(),
                           dim * dim,
                           component_is_part_of_tensor);
    interpretations.insert(interpretations.end(),
                           dim,
                           component_is_part_of_vector);
    return interpretations;
  }



  template class BoundaryPoint<2>;
  template class BoundaryPoint<3>;
} // namespace EBSMPM
