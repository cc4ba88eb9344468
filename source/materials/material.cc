// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/material.h>

#include <cmath>

namespace EBSMPM
{
  template <int dim>
  Material<dim>::Material(const double      bulk_modulus,
                          const double      shear_modulus,
                          const EnergySplit split)
    : K(bulk_modulus)
    , G(shear_modulus)
    , split(split)
  {
    // Written so that a NaN fails, too.
    AssertThrow(K > 0. && std::isfinite(K),
                ExcParameter("Material/Bulk modulus",
                             std::to_string(K),
                             "a positive number"));
    AssertThrow(G > 0. && std::isfinite(G),
                ExcParameter("Material/Shear modulus",
                             std::to_string(G),
                             "a positive number"));
  }



  template class Material<1>;
  template class Material<2>;
  template class Material<3>;
} // namespace EBSMPM
