// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/particles/point_view.h>

#include <algorithm>

namespace EBSMPM
{
  template <int dim>
  void
  PointView<dim>::initialize_common()
  {
    std::fill_n(values, n_common, 0.);
    for (unsigned int d = 0; d < dim; ++d)
      values[first_gradient + d * dim + d] = 1.;
  }



  template <int dim>
  std::vector<std::string>
  PointView<dim>::common_names()
  {
    std::vector<std::string> names = {"damage", "peak_damage", "label_frozen"};
    names.insert(names.end(), dim, "displacement");
    names.insert(names.end(), dim * dim, "deformation_gradient");
    names.insert(names.end(), dim, "side");
    return names;
  }



  template <int dim>
  std::vector<DataComponentInterpretation::DataComponentInterpretation>
  PointView<dim>::common_interpretations()
  {
    using namespace DataComponentInterpretation;

    std::vector<DataComponentInterpretation::DataComponentInterpretation>
      interpretations(3, component_is_scalar);
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



  template class PointView<2>;
  template class PointView<3>;
} // namespace EBSMPM
