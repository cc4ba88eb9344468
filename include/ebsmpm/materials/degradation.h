// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_materials_degradation_h
#define ebsmpm_materials_degradation_h

#include <ebsmpm/base/config.h>

#include <algorithm>

namespace EBSMPM
{
  /**
   * The quadratic degradation function, which tells how much of the energy
   * $\Psi^+$ damaged material still stores (method, section 2):
   * @f[
   *   g(d) = \max\left((1-d)^2,\, k\right), \qquad g'(d) = -2(1-d) .
   * @f]
   * The residual stiffness $k$ keeps the displacement system regular where the
   * material is broken. Only that system sees it: the derivative, which the
   * damage equation contains, has no floor, so that this equation stays linear
   * in $d$.
   *
   * value() clips $d$ to $[0,1]$ first, because a spline field overshoots near
   * a crack, and $(1-d)^2$ would grow again beyond one. derivative() does not,
   * for the reason above: there, $d$ is the unknown itself.
   */
  class Degradation
  {
  public:
    /**
     * Constructor. The residual stiffness must be in $[0,1)$, otherwise
     * ExcParameter is raised.
     */
    explicit Degradation(const double residual_stiffness = 1e-4);

    /**
     * Return $g(d)$.
     */
    double
    value(const double damage) const;

    /**
     * Return $g'(d)$, without floor and clipping.
     */
    static double
    derivative(const double damage);

    /**
     * Return $k$.
     */
    double
    residual_stiffness() const;

  private:
    /**
     * The residual stiffness.
     */
    double k;
  };



  // ------------------------- inline functions -------------------------

  inline double
  Degradation::value(const double damage) const
  {
    const double sound = 1. - std::min(std::max(damage, 0.), 1.);
    return std::max(sound * sound, k);
  }



  inline double
  Degradation::derivative(const double damage)
  {
    return -2. * (1. - damage);
  }



  inline double
  Degradation::residual_stiffness() const
  {
    return k;
  }
} // namespace EBSMPM

#endif
