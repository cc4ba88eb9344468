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
    this->initialize_common();
    reference_volume() = volume;
    history()          = 0.;
    damageable()       = 1.;
  }



  template <int dim>
  std::vector<std::string>
  MaterialPoint<dim>::component_names()
  {
    std::vector<std::string> names = PointView<dim>::common_names();
    for (const char *name : {"reference_volume", "history", "damageable"})
      names.push_back(name);
    return names;
  }



  template <int dim>
  std::vector<DataComponentInterpretation::DataComponentInterpretation>
  MaterialPoint<dim>::component_interpretations()
  {
    auto interpretations = PointView<dim>::common_interpretations();
    interpretations.insert(interpretations.end(),
                           3,
                           DataComponentInterpretation::component_is_scalar);
    return interpretations;
  }



  template class MaterialPoint<2>;
  template class MaterialPoint<3>;
} // namespace EBSMPM
