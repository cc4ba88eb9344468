// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_fracture_damage_ridge_h
#define ebsmpm_fracture_damage_ridge_h

#include <ebsmpm/splines/function_directory.h>
#include <ebsmpm/splines/spline_space.h>

#include <ebsmpm/particles/cell_points.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <utility>
#include <vector>

namespace EBSMPM
{
  /**
   * Find the ridge of the damage, where a diffusive crack has its middle: its
   * position and its normal near each function, and from these the side of the
   * crack that a point is on. The first three steps of CrackPartition.
   *
   * A crack could be found by the gradient of the damage, but that vanishes on
   * the ridge and is noise where $d\approx 1$. Its shape is robust (method,
   * section 6):
   *
   * 1. smooth_damage(): the damage of the points is smoothed by two passes from
   *    points to functions and back, weighted by volume; a third one makes the
   *    damage $d_I$ of the functions.
   * 2. find(): Let $d_\text{max}$ be the maximum of $d_I$ in a ball of a few
   *    cells around a function. With the weights
   *    $w_I=\max(0,d_I-\frac34 d_\text{max})^2$ and the positions $\mathbf x_I$
   *    of the functions in the ball, the ridge has the centroid and the
   *    variance
   *    @f[
   *      \mathbf c = \frac{\sum_I w_I\,\mathbf x_I}{\sum_I w_I}, \qquad
   *      \mathbf V = \frac{\sum_I w_I\,\mathbf x_I\otimes\mathbf x_I}{\sum_I
   *      w_I} - \mathbf c\otimes\mathbf c.
   *    @f]
   *    Its normal $\mathbf n$ is the axis of least variance, relative to that
   *    of the whole ball: the direction in which
   *    $\mathbf n\cdot\mathbf V\mathbf n/\mathbf n\cdot\mathbf V_0\mathbf n$
   *    is smallest, where $\mathbf V_0$ is $\mathbf V$ with the weights one.
   *    (In the interior, $\mathbf V_0$ is isotropic. Next to a free surface or
   *    in a thin plate, the ball is cut off, and the thickness of what is left
   *    of it must not be taken for that of the ridge.) This is as good as
   *    the ball is well placed: ahead of the tip and far from the ridge, it
   *    contains no more than an end or a segment of the ridge, and the axes are
   *    those of that piece. Therefore, each function finally takes normal and
   *    centroid from the function next to its centroid, on the crest.
   * 3. side_vector(): a point takes both from the function next to it, and
   *    looks towards the ridge,
   *    $\mathbf m_p=\operatorname{sign}((\mathbf c-\mathbf x_p)\cdot\mathbf n)
   *    \,\mathbf n$. Ties go to a fixed side.
   *
   * @code
   *         . o o o .       o  functions above 3/4 of the maximum
   *       . o o c o o .     c  their centroid
   *         . o o o .
   *     n ^     x           x  the function in question
   *       |
   * @endcode
   *
   * Only functions seen by the cells given take part, so that the cost is
   * proportional to the length of the crack.
   */
  template <int dim>
  class DamageRidge
  {
  public:
    using Key = FunctionKey<dim>;

    /** What is known about the ridge next to a function. */
    struct FunctionData
    {
      /** Smoothed damage. */
      double damage = 0.;

      /** Maximum of the smoothed damage around. */
      double ridge_damage = 0.;

      /** Ratio of the two smallest principal variances of the ridge, relative
       * to those of the ball. */
      double variance_ratio = 1.;

      /** The smallest principal variance, over the square of the radius. */
      double least_variance = 0.;

      /** Normal and centroid of the ridge. */
      std::array<double, dim> normal{};
      std::array<double, dim> centroid{};

      /** The lowest rank with points in the support. */
      unsigned int owner = 0;
    };

    using Table = typename FunctionDirectory<dim, FunctionData>::Table;

    /**
     * Constructor.
     *
     * @param space tells which functions a cell sees; must live as long as this
     *   object
     * @param minimum_damage damage that makes a ridge
     * @param radius of the ball, in cells
     */
    DamageRidge(const SplineSpace<dim> &space,
                const double            minimum_damage,
                const int               radius);

    /** Forget all functions. */
    void
    clear();

    /**
     * Compute the smoothed damage of the functions. This must have been called
     * before anything else is asked. Collective.
     *
     * @param points where the points are
     * @param cells numbers of the cells that take part
     * @param volumes current volumes of the points
     * @param damage of the points, in $[0,1]$
     */
    void
    smooth_damage(const CellPoints<dim>           &points,
                  const std::vector<unsigned int> &cells,
                  const std::vector<double>       &volumes,
                  const std::vector<double>       &damage);

    /** Find the ridge next to all functions. Collective. */
    void
    find();

    /** All functions that the cells see, and what is known about them. */
    const Table &
    table() const;

    /**
     * What is known at the function next to a point of a cell, or a null
     * pointer.
     */
    const FunctionData *
    nearest(const typename CellPoints<dim>::Cell &cell,
            const Point<dim>                     &unit_point) const;

    /**
     * Return the direction from a point of a cell towards the ridge, or zero if
     * there is none.
     */
    Tensor<1, dim>
    side_vector(const typename CellPoints<dim>::Cell &cell,
                const Point<dim>                     &unit_point,
                const Point<dim>                     &location) const;

  private:
    /** A sum over the points of a function's support. */
    struct Sums
    {
      double       volume = 0.;
      double       value  = 0.;
      unsigned int owner  = 0;
    };

    using SumTable = typename FunctionDirectory<dim, Sums>::Table;

    /** Positions of functions relative to one of them, and their damage. */
    using Ball = std::vector<std::pair<Tensor<1, dim>, double>>;

    /** Sum up values at the points, weighted by functions and volumes. */
    SumTable
    sum_up(const CellPoints<dim>           &points,
           const std::vector<unsigned int> &cells,
           const std::vector<double>       &volumes,
           const std::vector<double>       &values) const;

    /** Compute values at the points from the means of the functions. */
    void
    evaluate_means(const CellPoints<dim>           &points,
                   const std::vector<unsigned int> &cells,
                   const SumTable                  &sums,
                   std::vector<double>             &values) const;

    /** Return what is known about the functions around one of them. */
    Ball
    ball(const Key &center, const Table &around) const;

    /** Compute normal, centroid and variances of the ridge in a ball. */
    void
    find_axes(const Key    &center,
              const Ball   &ball,
              FunctionData &function) const;

    /** Let each function take its axes from the one next to its centroid. */
    void
    look_from_crest();

    const SplineSpace<dim> *space;
    const double            minimum_damage;
    const int               radius;

    Table functions;
  };
} // namespace EBSMPM

#endif
