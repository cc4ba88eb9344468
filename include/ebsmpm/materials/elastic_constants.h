// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_elastic_constants_h
#define ebsmpm_materials_elastic_constants_h

#include <ebsmpm/base/config.h>

namespace EBSMPM
{
  /**
   * Conversions between the constants of isotropic elasticity. Each function
   * raises ExcParameter unless $E>0$ and $-1<\nu<\frac12$.
   */
  namespace ElasticConstants
  {
    /**
     * Return the bulk modulus $K = E/(3(1-2\nu))$.
     */
    double
    bulk_modulus(const double youngs_modulus, const double poissons_ratio);

    /**
     * Return the shear modulus $G = E/(2(1+\nu))$.
     */
    double
    shear_modulus(const double youngs_modulus, const double poissons_ratio);
  } // namespace ElasticConstants
} // namespace EBSMPM

#endif
