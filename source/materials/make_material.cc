// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/linear_elastic.h>
#include <ebsmpm/materials/make_material.h>
#include <ebsmpm/materials/neo_hookean.h>

namespace EBSMPM
{
  template <int dim>
  std::unique_ptr<Material<dim>>
  make_material(const std::string &name,
                const EnergySplit  split,
                const double       bulk_modulus,
                const double       shear_modulus)
  {
    if (name == "neo-Hookean")
      return std::make_unique<NeoHookean<dim>>(bulk_modulus,
                                               shear_modulus,
                                               split);
    if (name == "linear elastic")
      return std::make_unique<LinearElastic<dim>>(bulk_modulus,
                                                  shear_modulus,
                                                  split);
    AssertThrow(false,
                ExcParameter("Material/Model",
                             name,
                             "one of " + material_names()));
    return nullptr;
  }



  std::string
  material_names()
  {
    return "neo-Hookean|linear elastic";
  }



  EnergySplit
  energy_split_from_name(const std::string &name)
  {
    if (name == "volumetric-deviatoric")
      return EnergySplit::volumetric_deviatoric;
    AssertThrow(name == "none",
                ExcParameter("Material/Energy split",
                             name,
                             "one of " + energy_split_names()));
    return EnergySplit::none;
  }



  std::string
  energy_split_names()
  {
    return "volumetric-deviatoric|none";
  }



  template std::unique_ptr<Material<1>>
  make_material<1>(const std::string &,
                   const EnergySplit,
                   const double,
                   const double);
  template std::unique_ptr<Material<2>>
  make_material<2>(const std::string &,
                   const EnergySplit,
                   const double,
                   const double);
  template std::unique_ptr<Material<3>>
  make_material<3>(const std::string &,
                   const EnergySplit,
                   const double,
                   const double);
} // namespace EBSMPM
