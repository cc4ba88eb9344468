// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/degradation.h>

#include <string>

namespace EBSMPM
{
  Degradation::Degradation(const double residual_stiffness)
    : k(residual_stiffness)
  {
    AssertThrow(k >= 0. && k < 1.,
                ExcParameter("Damage/Residual stiffness",
                             std::to_string(k),
                             "at least 0 and smaller than 1"));
  }
} // namespace EBSMPM
