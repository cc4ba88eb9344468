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
    this->initialize_common();
    reference_area() = area;
    set_boundary_id(id);
    set_reference_normal(normal);
  }



  template <int dim>
  std::vector<std::string>
  BoundaryPoint<dim>::component_names()
  {
    std::vector<std::string> names = PointView<dim>::common_names();
    names.push_back("reference_area");
    names.push_back("boundary_id");
    names.insert(names.end(), dim, "reference_normal");
    return names;
  }



  template <int dim>
  std::vector<DataComponentInterpretation::DataComponentInterpretation>
  BoundaryPoint<dim>::component_interpretations()
  {
    auto interpretations = PointView<dim>::common_interpretations();
    interpretations.insert(interpretations.end(),
                           2,
                           DataComponentInterpretation::component_is_scalar);
    interpretations.insert(
      interpretations.end(),
      dim,
      DataComponentInterpretation::component_is_part_of_vector);
    return interpretations;
  }



  template class BoundaryPoint<2>;
  template class BoundaryPoint<3>;
} // namespace EBSMPM
