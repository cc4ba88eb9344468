// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_point_groups_h
#define ebsmpm_assembly_point_groups_h

#include <ebsmpm/splines/spline_space.h>

#include <ebsmpm/particles/cell_points.h>

#include <deal.II/base/partitioner.h>

#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace EBSMPM
{
  /**
   * Return the distribution of the vectors of a problem on @p space: each
   * process owns the unknowns of its independent functions, and has as ghosts
   * those that the functions it sees depend on. The unknowns of a function are
   * consecutive, <tt>n_components*function+component</tt>. Collective.
   */
  template <int dim>
  std::shared_ptr<const Utilities::MPI::Partitioner>
  make_partitioner(const SplineSpace<dim>          &space,
                   const AffineConstraints<double> &constraints,
                   const unsigned int               n_components);



  /**
   * The points of a cell that read the same functions, for all cells: what the
   * assembly loops over.
   *
   * Away from cracks, all points of a cell read the cell's $(p+1)^\text{dim}$
   * functions in part 0, and there is one group per cell. Next to a crack, a
   * point may read the twin of some functions. Which ones is its
   * <em>pattern</em>: bit $i$ is set if it reads the twin of function $i$ of
   * the cell. Points with the same pattern form a group.
   *
   * For each group, the constraints are resolved here, once per space: the
   * values of the functions that the group reads are $c_i = \sum_j E_{ij} x_j$,
   * where $x_j$ are the values of independent functions (by their number in
   * the partitioner of a scalar problem, own ones first), and the matrix $E$ is
   * the identity for the majority of groups, where nothing is stored.
   *
   * All components of a vector-valued field share the same $E$.
   */
  template <int dim>
  class PointGroups
  {
  public:
    using Pattern = ReadingPattern;

    /** Some points of a cell, and the functions they read. */
    struct Group
    {
      /** Number of the cell in CellPoints::cells(). */
      unsigned int cell;

      /** Which functions are read as twins. */
      Pattern pattern;

      /** Range in point_numbers(). */
      unsigned int begin;
      unsigned int end;

      /** Range of independent functions in the table of functions. */
      unsigned int first_function;
      unsigned int n_functions;

      /** Begin of the matrix E, or numbers::invalid_unsigned_int. */
      unsigned int extension;
    };

    /**
     * Group the points. Return false if the groups, the functions they read and
     * the matrices $E$ are the same as before: no point has gone to another
     * cell, no pattern has changed, and neither has the space, whose
     * SplineSpace::n_changes() vouches for @p constraints and @p partitioner,
     * too. Then, nothing is done. The answer is about the points of this
     * process.
     *
     * @param points the points
     * @param patterns the pattern of each point, or an empty array if all read
     *   part 0
     * @param space and @p constraints: the functions
     * @param partitioner of a scalar problem on the space
     */
    bool
    reinit(const CellPoints<dim>             &points,
           const std::vector<Pattern>        &patterns,
           const SplineSpace<dim>            &space,
           const AffineConstraints<double>   &constraints,
           const Utilities::MPI::Partitioner &partitioner);

    /** The groups, cell by cell. */
    const std::vector<Group> &
    groups() const
    {
      return group_list;
    }

    /** Number of point @p q, in the numbering of CellPoints. */
    unsigned int
    point(const unsigned int q) const
    {
      return point_numbers[q];
    }

    /**
     * The independent functions of a group: Group::n_functions numbers of the
     * partitioner.
     */
    const unsigned int *
    functions(const Group &group) const
    {
      return function_numbers.data() + group.first_function;
    }

    /**
     * Whether a group reads any function for whose number @p condition is true.
     */
    template <typename Condition>
    bool
    reads_any(const Group &group, const Condition &condition) const
    {
      const unsigned int *f = functions(group);
      return std::any_of(f, f + group.n_functions, condition);
    }

    /**
     * The matrix $E$ of a group, row by row, with a row per function of the
     * cell and a column per independent function; a null pointer stands for the
     * identity.
     */
    const double *
    extension(const Group &group) const
    {
      return group.extension == numbers::invalid_unsigned_int ?
               nullptr :
               extensions.data() + group.extension;
    }

    /** Number of functions that a cell sees, rows of $E$. */
    unsigned int
    n_functions_per_cell() const
    {
      return n_per_cell;
    }

    /** Largest number of independent functions of a group. */
    unsigned int
    max_n_functions() const
    {
      return max_n;
    }

    /** Largest number of points of a group. */
    unsigned int
    max_n_points() const
    {
      return max_points;
    }

  private:
    std::vector<Group>        group_list;
    std::vector<unsigned int> point_numbers;
    std::vector<unsigned int> function_numbers;
    std::vector<double>       extensions;

    /** What the groups were made from. */
    struct Origin
    {
      const SplineSpace<dim>                            *space     = nullptr;
      unsigned int                                       n_changes = 0;
      std::vector<typename CartesianLattice<dim>::Index> cells;
      std::vector<unsigned int>                          levels;
      std::vector<unsigned int>                          ends;
      std::vector<Pattern>                               patterns;

      bool
      operator==(const Origin &other) const
      {
        return has_same_functions(other) && ends == other.ends &&
               patterns == other.patterns;
      }

      /** Whether the groups read the same, as long as there are no patterns. */
      bool
      has_same_functions(const Origin &other) const
      {
        return space == other.space && n_changes == other.n_changes &&
               cells == other.cells && levels == other.levels &&
               patterns.empty() == other.patterns.empty();
      }
    };
    Origin origin;

    unsigned int n_per_cell = 0;
    unsigned int max_n      = 0;
    unsigned int max_points = 0;
  };



  /**
   * Find, for each of the @p groups, the group among @p others that reads the
   * same functions, in the same cell and with the same pattern, for other
   * points; where there is none, the result is numbers::invalid_unsigned_int.
   * Both have to be up to date, for the same space.
   */
  template <int dim>
  std::vector<unsigned int>
  find_partners(const CellPoints<dim>  &points,
                const PointGroups<dim> &groups,
                const CellPoints<dim>  &other_points,
                const PointGroups<dim> &others);
} // namespace EBSMPM

#endif
