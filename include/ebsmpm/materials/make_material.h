// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_make_material_h
#define ebsmpm_materials_make_material_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/materials/material.h>

#include <memory>
#include <string>

namespace EBSMPM
{
  /**
   * Return a new material by its name(), one of material_names(). Any other
   * name raises ExcParameter. This is the one place to change when a material
   * is added.
   *
   * @code
   *   const auto material = make_material<2>(
   *     "neo-Hookean",
   *     energy_split_from_name("volumetric-deviatoric"),
   *     ElasticConstants::bulk_modulus(210., 0.3),
   *     ElasticConstants::shear_modulus(210., 0.3));
   * @endcode
   */
  template <int dim>
  std::unique_ptr<Material<dim>>
  make_material(const std::string &name,
                const EnergySplit  split,
                const double       bulk_modulus,
                const double       shear_modulus);

  /**
   * Return the names make_material() knows, separated by bars as in a
   * Patterns::Selection.
   */
  std::string
  material_names();

  /**
   * Return the energy split of the given name, one of energy_split_names(). Any
   * other name raises ExcParameter.
   */
  EnergySplit
  energy_split_from_name(const std::string &name);

  /**
   * Return the names of the energy splits, separated by bars as in a
   * Patterns::Selection.
   */
  std::string
  energy_split_names();
} // namespace EBSMPM

#endif
