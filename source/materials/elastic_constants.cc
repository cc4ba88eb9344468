// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/elastic_constants.h>

#include <cmath>
#include <sstream>

namespace EBSMPM
{
  namespace
  {
    std::string
    to_text(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }



    void
    check(const double youngs_modulus, const double poissons_ratio)
    {
      AssertThrow(youngs_modulus > 0. && std::isfinite(youngs_modulus),
                  ExcParameter("Material/Young's modulus",
                               to_text(youngs_modulus),
                               "a positive number"));
      AssertThrow(poissons_ratio > -1. && poissons_ratio < 0.5,
                  ExcParameter("Material/Poisson's ratio",
                               to_text(poissons_ratio),
                               "larger than -1 and smaller than 0.5"));
    }
  } // namespace



  namespace ElasticConstants
  {
    double
    bulk_modulus(const double youngs_modulus, const double poissons_ratio)
    {
      check(youngs_modulus, poissons_ratio);
      return youngs_modulus / (3. * (1. - 2. * poissons_ratio));
    }



    double
    shear_modulus(const double youngs_modulus, const double poissons_ratio)
    {
      check(youngs_modulus, poissons_ratio);
      return youngs_modulus / (2. * (1. + poissons_ratio));
    }
  } // namespace ElasticConstants
} // namespace EBSMPM
