// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_energy_split_h
#define ebsmpm_materials_energy_split_h

#include <ebsmpm/base/config.h>

namespace EBSMPM
{
  /**
   * Which part of the stored energy a crack can release.
   */
  enum class EnergySplit
  {
    /**
     * The isochoric part always, the volumetric one only where the material is
     * expanded, so that a closed crack still carries pressure.
     */
    volumetric_deviatoric,
    /**
     * All of it.
     */
    none
  };



  /**
   * Which side of the switch of the energy split a point is on: by its state,
   * or as told. The derivative of the stress jumps at the switch by four orders
   * of magnitude where the material is broken, and Newton's method may go in
   * circles around it. With the branches held, the problem is smooth.
   */
  enum class EnergyBranch : char
  {
    by_state,
    expanded,
    compressed
  };
} // namespace EBSMPM

#endif
