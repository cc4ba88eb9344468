// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_fracture_crack_partition_h
#define ebsmpm_fracture_crack_partition_h

#include <ebsmpm/splines/function_directory.h>
#include <ebsmpm/splines/spline_space.h>

#include <ebsmpm/particles/cell_points.h>

#include <ebsmpm/fracture/damage_ridge.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace EBSMPM
{
  /**
   * What points remember of a crack next to them, in plain arrays with the
   * numbering of CellPoints. Within a load step these are trial values; they
   * are written to the points when the step is accepted.
   */
  template <int dim>
  struct CrackLabels
  {
    /** Side vector: unit vector towards the crack, or zero. */
    std::vector<Tensor<1, dim>> side;

    /** Whether the side vector is settled. */
    std::vector<char> frozen;

    /** The largest damage so far (one on an initial slit). */
    std::vector<double> peak_damage;

    /** Give all arrays the size @p n. */
    void
    resize(const unsigned int n)
    {
      side.resize(n);
      frozen.resize(n);
      peak_damage.resize(n);
    }
  };



  /**
   * Turn a diffusive crack into a discrete one: decide which functions are read
   * differently from the two sides of the damage ridge, and which points are on
   * which side.
   *
   * The rule of Sugai et al., section 3.(4): a function $J$ whose damage
   * gradient opposes that of a point, $\nabla d_J\cdot\nabla d_p<0$, and whose
   * damage exceeds $d_\text{cr}$, lies on the other side of the crack. The
   * point then reads, instead of $c_J$, an extrapolation from functions on its
   * own side: the twin of $J$. The number of unknowns does not grow.
   *
   * @code
   *      m_p |        points above the ridge: side vector down
   *          v    . . . . . . . .
   *   ===================-------------->   ridge of the damage
   *          ^    . . . . . . . .  tip
   *      m_p |        points below: side vector up
   * @endcode
   *
   * The gradient vanishes on the ridge and is noise where $d\approx 1$.
   * Therefore, side vectors come from the shape of the ridge, which DamageRidge
   * finds (method, section 6):
   *
   * 1. The damage of the points is smoothed.
   * 2. At each function, centroid $\mathbf c$ and normal $\mathbf n$ of the
   *    ridge in a ball of radius AdditionalData::ridge_radius cells are found.
   * 3. A point gets the side vector $\mathbf
   *    m_p=\operatorname{sign}((\mathbf c-\mathbf x_p)\cdot\mathbf n)
   *    \,\mathbf n$. It is settled once the ridge is clear, i.e., the ratio of
   *    the two smallest principal variances below AdditionalData::frozen_ratio,
   *    and the point reads a separable function.
   * 4. The side vector $\mathbf m_I$ of a function is the mean of its points',
   *    weighted by volume: the side with more material owns it. If neither has
   *    much more, it is their principal axis, with the sign of the mean.
   * 5. A function is separable if a damage above $d_\text{cr}$ is met between
   *    $-h$ and $+2h$ from it along $\mathbf m_I$ (for a function outside of
   *    the body, anywhere in its support; in 3-D, from the centre of the
   *    material in its support, so that it is not separable farther ahead of
   *    the tip than its neighbours inside). This is decided per function, not
   *    per cell, so that the field of each side stays $C^{p-1}$ and the opening
   *    closes smoothly at the tip. It stays whole in spite of that where the
   *    ridge has arms in all directions, i.e., the ratio of variances is above
   *    one half and the smaller one above 1/16 of the square of the radius:
   *    where cracks meet, two sides are not enough (n_junctions()). If some of
   *    the material around has settled sides, or there is a gap in it, it was a
   *    crack before, and it remains one: open lips look the same.
   * 6. Closure: a function on a ridge with $d>0.5$ between two separable ones,
   *    or between one and a free boundary (in 3-D, with nothing intact ahead),
   *    within three cells, is separable as well. Single functions left over
   *    would carry load for ever.
   * 7. In 3-D, a function that has hardly any material on the far side, i.e.,
   *    points with $\mathbf m_p\cdot\mathbf m_I<0$ (see
   *    AdditionalData::remainder_majority), is separable as well if all of
   *    these are in cells that see separable functions, and there are such
   *    points: the crack has passed it. A crack that leaves the body at an
   *    angle ends in a thin wedge; functions outside of the body would tie its
   *    edge to the other side.
   * 8. A function without material, which is read by boundary points only, is
   *    like the closest one that has some. If it stayed whole, it would join
   *    both sides of a crack at a free surface, though without a force.
   * 9. A point with $\mathbf m_p\cdot\mathbf m_I<0$ reads the twin of the
   *    separable function $I$.
   *
   * An initial slit is the same with labels given at the start.
   *
   * Cells without noteworthy damage or labels take no part, so that the cost is
   * proportional to the length of the crack. All functions are collective.
   * Decisions are based on sums that are the same on all processes, with
   * margins, and do not depend on the number of processes.
   */
  template <int dim>
  class CrackPartition
  {
  public:
    using Pattern = ReadingPattern;
    using Key     = FunctionKey<dim>;

    /** Parameters of the procedure. Lengths are in cells. */
    struct AdditionalData
    {
      /** Constructor, with the defaults. */
      AdditionalData(const double damage_threshold = 0.9,
                     const double closure_damage   = 0.5,
                     const double frozen_ratio     = 0.2,
                     const int    ridge_radius     = 4)
        : damage_threshold(damage_threshold)
        , closure_damage(closure_damage)
        , frozen_ratio(frozen_ratio)
        , ridge_radius(ridge_radius)
      {}

      /** The damage $d_\text{cr}$ beyond which functions are separable. */
      double damage_threshold;

      /** The damage that makes a ridge for the closure. */
      double closure_damage;

      /** Ratio of principal variances below which the ridge is clear. */
      double frozen_ratio;

      /** Radius of the ball in which the shape of the ridge is determined. */
      int ridge_radius;

      /**
       * Whether cracks grow. Otherwise, only what was labelled at the start (a
       * slit) is discrete, and damage is no reason for more.
       */
      bool grow = true;

      /**
       * How much more material a function must have on its own side, relative
       * to all, to become separable in step 7. In the row next to a crack,
       * functions have two thirds at most: with three quarters, these are not
       * cut before their damage says so. With zero they are, and what is left
       * at the edges of a body breaks sooner.
       */
      double remainder_majority = 0.75;
    };

    /**
     * Constructor. @p space must have been numbered, without twins, from the
     * same points: it tells which functions exist.
     */
    CrackPartition(const SplineSpace<dim> &space,
                   const AdditionalData   &data = AdditionalData());

    /**
     * Determine the partition anew. Return whether any pattern on any process
     * differs from before.
     *
     * @param points, @p boundary_points where the points are
     * @param volumes current volumes of the material points
     * @param damage current damage of the material points, in $[0,1]$
     * @param labels, @p boundary_labels are updated: side vectors that are not
     *   frozen, and the largest damage
     */
    bool
    update(const CellPoints<dim>     &points,
           const CellPoints<dim>     &boundary_points,
           const std::vector<double> &volumes,
           const std::vector<double> &damage,
           CrackLabels<dim>          &labels,
           CrackLabels<dim>          &boundary_labels);

    /** Forget the patterns, as if there had been no update() before. */
    void
    clear();

    /** Which functions the material points read as twins. */
    const std::vector<Pattern> &
    patterns() const;

    /** Whether any point of any process reads a twin. */
    bool
    is_open() const;

    /** Which functions the boundary points read as twins. */
    const std::vector<Pattern> &
    boundary_patterns() const;

    /**
     * Return the side vector of a function in part 0 if its two sides read it
     * differently, else zero.
     */
    Tensor<1, dim>
    side_of(const Key &key) const;

    /** The space that the partition is about. */
    const SplineSpace<dim> &
    space() const;

    /**
     * Number of functions with enough damage ahead to become separable that
     * have not, because the ridge has no clear direction: junctions of cracks.
     */
    unsigned int
    n_junctions() const;

    /** Tell the functions in @p supports their side vectors. */
    void
    add_sides(typename SplineSpace<dim>::SupportTable &supports) const;

  private:
    /** What becomes known about a function, step by step. */
    struct FunctionData
    {
      /** Damage met along the side vector. */
      double damage_ahead = 0.;

      /** The function's side vector. */
      std::array<double, dim> side{};

      /**
       * How much more material is on its side than on the other, relative to
       * both.
       */
      double majority = 0.;

      /** The centre of the material in its support. */
      std::array<double, dim> centre{};

      /** Whether both sides read the function differently. */
      bool separable = false;

      /** Whether the ridge has no direction here. */
      bool at_junction = false;

      /** The lowest rank with points in the support. */
      unsigned int owner = 0;
    };

    /** A sum over the points of a function's support. */
    struct Sums
    {
      double                  volume         = 0.;
      double                  settled_volume = 0.;
      double                  filled_volume  = 0.;
      std::array<double, dim> vector{};
      std::array<double, dim> moment{};
      SymmetricTensor<2, dim> dyads;
    };

    using DataTable = typename FunctionDirectory<dim, FunctionData>::Table;

    /** Find the cells that take part. */
    void
    select_cells(const CellPoints<dim>     &points,
                 const std::vector<double> &damage,
                 const CrackLabels<dim>    &labels);

    /** Step 3, for points that are not settled. */
    void
    label_points(const CellPoints<dim> &points, CrackLabels<dim> &labels) const;

    /** Steps 4 to 6; they fill #table. */
    void
    find_sides(const CellPoints<dim>     &points,
               const std::vector<double> &volumes,
               const CrackLabels<dim>    &labels);
    void
    find_separable(const CellPoints<dim>  &points,
                   const CrackLabels<dim> &labels);
    void
    close_gaps();

    /** Step 7. */
    void
    cut_remainders(const CellPoints<dim>  &points,
                   const CrackLabels<dim> &labels);

    /** Step 8. */
    void
    add_bare_functions(const CellPoints<dim> &boundary_points);

    /** Step 9, and freezing; returns whether a pattern changed. */
    bool
    make_patterns(const CellPoints<dim> &points,
                  CrackLabels<dim>      &labels,
                  std::vector<Pattern>  &patterns) const;

    const SplineSpace<dim> *spline_space;
    const AdditionalData    data;

    /** Numbers of the cells that take part. */
    std::vector<unsigned int> active_cells;

    /** The ridge of the damage in these cells. */
    DamageRidge<dim> ridge;

    /** The functions that these cells see. */
    DataTable table;

    std::vector<Pattern> point_patterns;
    std::vector<Pattern> boundary_point_patterns;
    bool                 any_twin = false;

    unsigned int n_refused = 0;
  };
} // namespace EBSMPM

#endif
