// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_splines_extension_h
#define ebsmpm_splines_extension_h

#include <ebsmpm/splines/spline_space.h>

#include <deal.II/lac/affine_constraints.h>

namespace EBSMPM
{
  /**
   * What make_extension_constraints() did, and how well it went. The numbers
   * are the same on all processes.
   */
  struct ExtensionReport
  {
    /** Functions extrapolated from a block of lower degree. */
    types::global_dof_index n_lower_degree = 0;

    /** Among these, functions that copy the value of one other function. */
    types::global_dof_index n_nearest = 0;

    /**
     * Functions with no block on their own side of a crack in reach, which were
     * extrapolated from whatever there is.
     */
    types::global_dof_index n_wrong_side = 0;

    /** The largest Lebesgue product $\prod_a\sum_I|E_{IJ}|$ in use. */
    double max_lebesgue = 1.;
  };



  /**
   * Fill @p constraints with the lines that make all deficient functions and
   * twins of @p space depend on standard functions: the extension of extended
   * B-splines.
   *
   * The value of a dependent function $J$ is extrapolated from a complete block
   * of standard functions, $\mathbb S_J=\{K+[0,p]^\text{dim}\}$, by Lagrange
   * polynomials in index space,
   * @f[
   *   c_J = \sum_{I\in\mathbb S_J} E_{IJ} c_I,
   *   \qquad
   *   E_{IJ} = \prod_a \prod_{m\ne I_a} \frac{J_a-m}{I_a-m}
   *   \qquad\text{(16)}.
   * @f]
   * Since knots are uniform, this reproduces polynomials of degree $p$ exactly.
   *
   * Of the blocks in reach, the one with the smallest Lebesgue product
   * $\prod_a\sum_I|E_{IJ}|$ is taken, between equals the closer one, and then
   * the one with the smaller key. The closest block alone can have very large
   * weights (280 were seen, where this rule keeps them near 10).
   *
   * If there is no complete block within the first reach, the search is
   * widened, and if it still fails, blocks of lower degree are tried, down to a
   * single function. That is counted in the report. No deficient function is
   * ever kept as an unknown; if there is no standard function in reach at all,
   * ExcNoStandardFunction is raised (on all processes).
   *
   * Next to a crack, where functions have a side vector $\mathbf m$, a function
   * is extrapolated from those on its own side of the crack, $\mathbf m_K\cdot
   * \mathbf m_J\ge 0$, and its twin from those of the other side,
   * $\mathbf m_K\cdot\mathbf m_J\le 0$. Functions far from any crack, $\mathbf
   * m_K=0$, are on the side that they lie on, seen from $J$: a block in some
   * distance may be beyond the crack.
   *
   * @param space the numbering
   * @param constraints is emptied first; on output closed, with lines for all
   *   dependent functions that this process sees. Indices are those of @p
   *   space, functions not being multiplied by components.
   *
   * Collective. Every process computes the lines of all functions it sees, from
   * data that are the same everywhere, so nothing has to be made consistent
   * afterwards.
   *
   * K. Höllig, U. Reif, J. Wipper, SIAM J. Numer. Anal. 39 (2001) 442-462;
   * Sugai et al., equations (15) to (17).
   */
  template <int dim>
  ExtensionReport
  make_extension_constraints(const SplineSpace<dim>    &space,
                             AffineConstraints<double> &constraints);



  /** A deficient function has no standard function in its neighbourhood. */
  DeclException1(
    ExcNoStandardFunction,
    std::string,
    << "The function around (" << arg1
    << ") has too little material under it, and there is none with "
    << "enough in its neighbourhood. Use more points, smaller "
    << "cells, or a lower 'Extension/Threshold'.");
} // namespace EBSMPM

#endif
