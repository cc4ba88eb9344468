// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_local_system_h
#define ebsmpm_assembly_local_system_h

#include <ebsmpm/base/block_row.h>

#include <ebsmpm/lac/system_matrix.h>
#include <ebsmpm/lac/types.h>

#include <ebsmpm/splines/bspline_kernel.h>

#include <ebsmpm/assembly/extension_product.h>
#include <ebsmpm/assembly/point_groups.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <utility>
#include <vector>

namespace EBSMPM
{
  /**
   * What an assembly is to compute: the residual, or the tangent as well, with
   * (tangent) or without (predictor) terms that are proportional to the unmet
   * part of the Dirichlet data.
   */
  enum class AssemblyTask
  {
    residual,
    predictor,
    tangent
  };



  /**
   * The share of one group of points in the equation for the displacement, in
   * terms of the functions of the cell, and the way between these and the
   * unknowns.
   *
   * The functions of the cell have the coefficients $\mathbf c_I=\sum_j E_{Ij}
   * \mathbf x_j$, see PointGroups. This class gathers them, tells the increment
   * at the points, and has room for the residual $\mathbf r_I$ and the tangent
   * $\mathbf K_{IJ}$, which classes like ElasticTerms and NitscheTerms fill.
   * What it adds to the global objects is $\mathbf r_j=\sum_I E_{Ij}\mathbf
   * r_I$ and $\mathbf K_{ij}=\sum_{IJ} E_{Ii}\mathbf K_{IJ} E_{Jj}$.
   *
   * It goes from group to group as FEValues goes from cell to cell:
   *
   * @code
   * LocalSystem<dim> local;
   * local.initialize(space, largest_number_of_unknown_functions);
   * for (const auto &group : groups.groups())
   *   {
   *     local.reinit(points, groups, group);
   *     local.gather(increment);
   *     terms.compute(AssemblyTask::tangent, state, {}, local);
   *     local.distribute_residual(residual);
   *     local.distribute_tangent(list++, matrix);
   *   }
   * @endcode
   *
   * Memory is allocated by initialize() only. There is no communication.
   */
  template <int dim>
  class LocalSystem
  {
  public:
    /**
     * Allocate memory.
     *
     * @param space tells the degree and the size of cells; it must live as long
     *   as it is used here
     * @param max_n_functions the largest number of independent functions that a
     *   group reads
     */
    void
    initialize(const SplineSpace<dim> &space,
               const unsigned int      max_n_functions);

    /** Go to @p group; residual and tangent begin with zero. */
    void
    reinit(const CellPoints<dim>                  &points,
           const PointGroups<dim>                 &groups,
           const typename PointGroups<dim>::Group &group);

    /**
     * Go on to another group, which reads the same functions, and keep what
     * there is of them: the coefficients, the residual and the tangent.
     */
    void
    go_on(const CellPoints<dim>                  &points,
          const PointGroups<dim>                 &groups,
          const typename PointGroups<dim>::Group &group);

    /**
     * Get the coefficients of @p increment, a vector with up-to-date ghost
     * entries.
     */
    void
    gather(const LA::FieldVector &increment);

    /** Edge length of the cell, in the first direction. */
    double
    cell_extent() const;

    /** Number of functions that the cell sees. */
    unsigned int
    n_functions() const;

    /** Number of points of the group. */
    unsigned int
    n_points() const;

    /** Number of the <tt>k</tt>th point of the group in CellPoints. */
    unsigned int
    point(const unsigned int k) const;

    /** Compute the values of all functions at a point of the group. */
    void
    values(const unsigned int k, double *B) const;

    /**
     * Compute functionals of all functions at all points of the group, a row
     * per point and functional: the gradient, component by component, or before
     * it also the value, if @p n_rows is larger than dim.
     */
    template <int n_rows>
    void
    functionals(double *X, const unsigned int stride) const;

    /**
     * The coefficients of the increment, a row per component, with the number
     * of each function of the cell.
     */
    const double *
    coefficients() const;

    /** The residual in the same order, to be added to. */
    double *
    residual();

    /** Distance between two rows of these, see padded(). */
    unsigned int
    row_stride() const;

    /** Add a force to the residual of all functions, with the values @p B. */
    void
    add_force(const Tensor<1, dim> &force, const double *B);

    /** Return the increment, where the functions have the values @p B. */
    Tensor<1, dim>
    value(const double *B) const;

    /**
     * The tangent, row by row, each a BlockRow<dim>: block $J$ of row $I$ has
     * the numbers that couple components of function $I$ with those of
     * function $J$, for $I\le J$. The rest follows by symmetry, and what is
     * written there does not matter.
     */
    double *
    tangent();

    /** The number that couples two components of functions $I\le J$. */
    double &
    tangent(const unsigned int I,
            const unsigned int a,
            const unsigned int J,
            const unsigned int b);

    /**
     * Begin to write the tangent. Return whether there is something in it, to
     * add to; otherwise it is zero, but does not say so, and is to be
     * overwritten.
     */
    bool
    begin_tangent();

    /** Resolve the constraints, and add the residual to a vector. */
    void
    distribute_residual(LA::FieldVector &vector) const;

    /**
     * Complete the tangent, resolve the constraints, and add it to a matrix.
     *
     * @param list number of the group's functions in the matrix
     */
    void
    distribute_tangent(const unsigned int list, SystemMatrix &matrix);

  private:
    /** The computation of functionals(), for several instruction sets. */
    template <int n_rows>
    struct Functionals;

    const SplineSpace<dim>                 *space  = nullptr;
    const CellPoints<dim>                  *points = nullptr;
    const PointGroups<dim>                 *groups = nullptr;
    const typename PointGroups<dim>::Group *group  = nullptr;

    BSplineKernel<dim> kernel{1};
    unsigned int       n = 0;

    /** One over the edge lengths of the cell. */
    Tensor<1, dim> inverse_h;

    /** Distance between rows of a number per function. */
    unsigned int short_stride = 0;

    /** For the kernels, these are at the beginning of a cache line. */
    AlignedVector<double> coefficient_rows;
    AlignedVector<double> residual_rows;
    AlignedVector<double> tangent_rows;
    bool                  tangent_begun = false;
    ExtensionProduct<dim> extension_product;
  };



#ifndef DOXYGEN

  template <int dim>
  inline double
  LocalSystem<dim>::cell_extent() const
  {
    return 1. / inverse_h[0];
  }



  template <int dim>
  inline unsigned int
  LocalSystem<dim>::n_functions() const
  {
    return n;
  }



  template <int dim>
  inline unsigned int
  LocalSystem<dim>::n_points() const
  {
    return group->end - group->begin;
  }



  template <int dim>
  inline unsigned int
  LocalSystem<dim>::point(const unsigned int k) const
  {
    return groups->point(group->begin + k);
  }



  template <int dim>
  inline void
  LocalSystem<dim>::values(const unsigned int k, double *B) const
  {
    kernel.values(points->unit_point(point(k)), B);
  }



  template <int dim>
  inline const double *
  LocalSystem<dim>::coefficients() const
  {
    return coefficient_rows.data();
  }



  template <int dim>
  inline double *
  LocalSystem<dim>::residual()
  {
    return residual_rows.data();
  }



  template <int dim>
  inline unsigned int
  LocalSystem<dim>::row_stride() const
  {
    return short_stride;
  }



  template <int dim>
  inline void
  LocalSystem<dim>::add_force(const Tensor<1, dim> &force, const double *B)
  {
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int i = 0; i < n; ++i)
        residual_rows[a * short_stride + i] += force[a] * B[i];
  }



  template <int dim>
  inline Tensor<1, dim>
  LocalSystem<dim>::value(const double *B) const
  {
    Tensor<1, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int i = 0; i < n; ++i)
        result[a] += coefficient_rows[a * short_stride + i] * B[i];
    return result;
  }



  template <int dim>
  inline double *
  LocalSystem<dim>::tangent()
  {
    return tangent_rows.data();
  }



  template <int dim>
  inline double &
  LocalSystem<dim>::tangent(const unsigned int I,
                            const unsigned int a,
                            const unsigned int J,
                            const unsigned int b)
  {
    return tangent_rows[I * BlockRow<dim>::length(n) +
                        BlockRow<dim>::place(n, J, a, b)];
  }



  template <int dim>
  inline bool
  LocalSystem<dim>::begin_tangent()
  {
    return std::exchange(tangent_begun, true);
  }

#endif
} // namespace EBSMPM

#endif
