// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/output/patches.h>

#include <cmath>
#include <limits>

namespace EBSMPM
{
  template <int dim, int spacedim>
  void
  Patches<dim, spacedim>::declare(const std::string   &name,
                                  const Interpretation interpretation)
  {
    Assert(patches.empty(),
           ExcMessage("All fields must be declared before the first patch."));

    unsigned int n = 1;
    if (interpretation ==
        DataComponentInterpretation::component_is_part_of_vector)
      n = spacedim;
    else if (interpretation ==
             DataComponentInterpretation::component_is_part_of_tensor)
      n = spacedim * spacedim;

    if (interpretation != DataComponentInterpretation::component_is_scalar)
      nonscalar_ranges.emplace_back(n_components(),
                                    n_components() + n - 1,
                                    name,
                                    interpretation);
    component_names.insert(component_names.end(), n, name);
  }



  template <int dim, int spacedim>
  void
  Patches<dim, spacedim>::add(const DataOutBase::Patch<dim, spacedim> &patch)
  {
    AssertDimension(patch.data.n_rows(), n_components());
    patches.push_back(patch);
    patches.back().patch_index = patches.size() - 1;
  }



  template <int dim, int spacedim>
  unsigned int
  Patches<dim, spacedim>::n_patches() const
  {
    return patches.size();
  }



  template <int dim, int spacedim>
  unsigned int
  Patches<dim, spacedim>::n_components() const
  {
    return component_names.size();
  }



  template <int dim, int spacedim>
  const std::string &
  Patches<dim, spacedim>::component_name(const unsigned int component) const
  {
    AssertIndexRange(component, n_components());
    return component_names[component];
  }



  template <int dim, int spacedim>
  bool
  Patches<dim, spacedim>::is_finite(const double value)
  {
    // False for a NaN, too.
    return std::abs(value) <= std::numeric_limits<float>::max();
  }



  template <int dim, int spacedim>
  const std::vector<DataOutBase::Patch<dim, spacedim>> &
  Patches<dim, spacedim>::get_patches() const
  {
    return patches;
  }



  template <int dim, int spacedim>
  std::vector<std::string>
  Patches<dim, spacedim>::get_dataset_names() const
  {
    return component_names;
  }



  template <int dim, int spacedim>
  std::vector<
    std::tuple<unsigned int,
               unsigned int,
               std::string,
               DataComponentInterpretation::DataComponentInterpretation>>
  Patches<dim, spacedim>::get_nonscalar_data_ranges() const
  {
    return nonscalar_ranges;
  }
} // namespace EBSMPM



template class EBSMPM::Patches<0, 2>;
template class EBSMPM::Patches<0, 3>;
template class EBSMPM::Patches<2, 2>;
template class EBSMPM::Patches<3, 3>;
