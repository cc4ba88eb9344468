// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/solvers/line_search.h>

#include <algorithm>
#include <cmath>

namespace EBSMPM
{
  namespace
  {
    /** Whether a step reduces the residual, or the slope, or is good enough. */
    bool
    is_good(const LineSearch::Trial &trial,
            const LineSearch::Trial &start,
            const double             target)
    {
      return trial.norm <= std::max(0.9 * start.norm, target) ||
             (start.slope < 0. &&
              std::abs(trial.slope) <= 0.5 * std::abs(start.slope));
    }
  } // namespace



  LineSearch::LineSearch(const unsigned int max_bisections,
                         const std::function<Trial(const double)> &evaluate)
    : max_bisections(max_bisections)
    , evaluate(evaluate)
  {}



  LineSearch::Trial
  LineSearch::search(const Trial &start,
                     const double allowed_norm,
                     const double target)
  {
    Trial trial = try_step(1.);
    while (!std::isfinite(trial.norm) && n_tried <= max_bisections)
      trial = try_step(0.5 * trial.step);
    if (is_good(trial, start, target) || trial.norm <= allowed_norm ||
        !std::isfinite(trial.norm) || (start.slope < 0. && trial.slope < 0.))
      return trial;
    return search_between(start, trial, target);
  }



  LineSearch::Trial
  LineSearch::search_between(const Trial &start,
                             const Trial &end,
                             const double target)
  {
    const bool has_slope = (start.slope < 0.);
    Trial      lower     = start;
    Trial      upper     = end;
    Trial      best      = end;
    int        last_side = 0;
    while (n_tried <= max_bisections)
      {
        const double fraction =
          has_slope ?
            std::clamp(-lower.slope / (upper.slope - lower.slope), 0.05, 0.95) :
            0.5;
        const Trial trial =
          try_step(lower.step + fraction * (upper.step - lower.step));
        if (has_slope ? std::abs(trial.slope) < std::abs(best.slope) :
                        trial.norm < best.norm)
          best = trial;
        if (is_good(trial, start, target))
          return trial;

        // Where the same end moves twice, the other one counts half.
        const int side               = (has_slope && trial.slope < 0.) ? -1 : 1;
        (side == -1 ? lower : upper) = trial;
        if (side == last_side)
          (side == -1 ? upper : lower).slope *= 0.5;
        last_side = side;
      }

    // Where the slope jumps, stop behind the kink: the next tangent has to
    // know what is there.
    return (has_slope && upper.norm < start.norm) ? upper : best;
  }



  LineSearch::Trial
  LineSearch::try_step(const double step)
  {
    ++n_tried;
    return evaluate(step);
  }



  unsigned int
  LineSearch::n_trials() const
  {
    return n_tried;
  }
} // namespace EBSMPM
