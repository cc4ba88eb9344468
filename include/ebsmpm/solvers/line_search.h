// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_line_search_h
#define ebsmpm_solvers_line_search_h

#include <ebsmpm/base/config.h>

#include <functional>
#include <limits>

namespace EBSMPM
{
  /**
   * The search for a good step length of Newton's method, for a residual that
   * is the derivative of an energy.
   *
   * The full step is good if it reduces the norm of the residual, or the slope
   * of the energy along the line; otherwise the point is looked for where that
   * slope is about zero. The energy has kinks in its second derivative, where
   * points change from compression to expansion; there, the norm of the
   * residual alone leads to cycles or to tiny steps.
   *
   * @code
   * LineSearch line(max_bisections, evaluate);
   * const LineSearch::Trial best = line.search(start, allowed_norm, target);
   * x.add(best.step, update);
   * @endcode
   *
   * It does not know vectors: whoever evaluates the residual does.
   */
  class LineSearch
  {
  public:
    /** A point on the line. By default, one whose residual is infinite. */
    struct Trial
    {
      /** Step length. */
      double step = 0.;

      /** Norm of the residual. */
      double norm = std::numeric_limits<double>::infinity();

      /** Derivative of the energy along the line. */
      double slope = std::numeric_limits<double>::infinity();
    };

    /**
     * Constructor.
     *
     * @param max_bisections how many steps to try after the first one
     * @param evaluate compute the residual for a step length; its norm is
     *   infinite where it does not exist
     */
    LineSearch(const unsigned int                        max_bisections,
               const std::function<Trial(const double)> &evaluate);

    /**
     * Return a good step, or the best one that was found. It was not
     * necessarily the last one to be evaluated. Its norm is infinite if no step
     * has a residual.
     *
     * @param start the beginning of the line, a step of zero; a slope that is
     *   not negative there tells nothing, and steps are halved until the
     *   residual decreases
     * @param allowed_norm up to which norm a full step is fine
     * @param target the norm that is good enough at any rate
     */
    Trial
    search(const Trial &start, const double allowed_norm, const double target);

    /** The number of steps that were tried. */
    unsigned int
    n_trials() const;

  private:
    /**
     * Try steps between zero and one that is too long, by regula falsi with the
     * modification of Illinois for the slope.
     */
    Trial
    search_between(const Trial &start, const Trial &end, const double target);

    /** Evaluate, and count. */
    Trial
    try_step(const double step);

    const unsigned int                       max_bisections;
    const std::function<Trial(const double)> evaluate;
    unsigned int                             n_tried = 0;
  };
} // namespace EBSMPM

#endif
