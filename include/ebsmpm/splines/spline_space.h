// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_splines_spline_space_h
#define ebsmpm_splines_spline_space_h

#include <ebsmpm/splines/cartesian_lattice.h>
#include <ebsmpm/splines/function_directory.h>
#include <ebsmpm/splines/function_key.h>
#include <ebsmpm/splines/shared_functions.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/tensor.h>

#include <deal.II/grid/tria.h>

#include <memory>
#include <unordered_map>
#include <vector>

namespace EBSMPM
{
  /**
   * The numbering of the B-splines on a Cartesian grid: which functions exist,
   * which process owns them, and which indices a cell sees.
   *
   * This is what DoFHandler is for finite elements; a DoFHandler itself cannot
   * number functions that live on several cells. It does not know which
   * functions depend on which others: that is for make_extension_constraints()
   * and the AffineConstraints object filled by it. See the page on notation in
   * function_key.h for the words.
   *
   * Every process hands over the functions that its points see, with the share
   * of the support that its points occupy,
   * @f[
   *   \phi_I = \frac{\sum_p B_I(\mathbf x_p) v_p}{\int B_I},
   * @f]
   * and reinit() adds the shares up, tells standard from deficient functions by
   * $\phi_I>\phi_\text{cr}$, and numbers the independent ones
   * $0,\ldots,n_\text{independent}-1$, rank by rank, and the dependent ones
   * behind, rank by rank as well. Vectors and matrices need the independent
   * range only. A function belongs to the lowest rank that sees it.
   *
   * @code
   * SplineSpace<dim> space(triangulation, degree);
   * SplineSpace<dim>::SupportTable supports;
   * for (cell with points)
   *   for (point in cell)
   *     for (i < n_functions)
   *       supports[space.cell_function(cell_index, level, i)].fraction +=
   *         B[i] * volume / cell->measure();
   * space.reinit(supports, 0.1);
   *
   * AffineConstraints<double> constraints;
   * make_extension_constraints(space, constraints);
   * @endcode
   *
   * The numbering does not depend on the order in which cells or points are
   * visited, and the set of functions and their classes not on the number of
   * processes. reinit() is collective; it sends a few messages about functions
   * that several processes see, and about all of them if anything has changed.
   */
  template <int dim>
  class SplineSpace
  {
  public:
    using Key = FunctionKey<dim>;

    /** What makes a function independent, or not. */
    enum class FunctionClass : int
    {
      standard,
      deficient,
      twin
    };

    /** What the points of one process say about a function. */
    struct Support
    {
      /** Their share of the occupied fraction $\phi_I$. */
      double fraction = 0.;

      /**
       * The unit vector that points from the function to a crack next to it,
       * or zero if there is none: the same on all processes that give one.
       */
      std::array<double, dim> side{};
    };

    /** What there is to know about an active function. */
    struct Function
    {
      types::global_dof_index index    = numbers::invalid_dof_index;
      unsigned int            owner    = numbers::invalid_unsigned_int;
      FunctionClass           category = FunctionClass::standard;
      double                  fraction = 0.;
      std::array<double, dim> side{};

      /** Whether more than one process sees it. */
      bool shared = false;
    };

    using SupportTable = std::unordered_map<Key, Support, FunctionKeyHash<dim>>;
    using FunctionTable =
      std::unordered_map<Key, Function, FunctionKeyHash<dim>>;

    /**
     * Constructor. Nothing is numbered yet.
     *
     * @param triangulation a (distributed) grid of Cartesian cells
     * @param degree of the splines, from one to three
     */
    SplineSpace(const Triangulation<dim> &triangulation,
                const unsigned int        degree);

    /**
     * Number the functions in @p supports, those of all processes together.
     * Functions are standard if their total fraction is more than @p threshold.
     * One that was standard before stays so until its fraction is no more than
     * $1-$ @p hysteresis times that: otherwise, a body that moves changes its
     * space nearly all the time. Collective.
     *
     * Return whether anything has changed but fractions. If not, everybody can
     * keep what depends on numbers and classes; see also n_changes().
     */
    bool
    reinit(const SupportTable &supports,
           const double        threshold,
           const double        hysteresis = 0.);

    /** Return the standard functions that this process owns. */
    std::vector<Key>
    standard_functions() const;

    /**
     * Forget everything but which functions were standard, because the next
     * reinit() is going to ask for that: it numbers all functions anew. For
     * spaces that continue those of an earlier run, perhaps on another number
     * of processes, or on a grid that was distributed anew. Collective.
     *
     * @param standard_functions what standard_functions() has returned; each
     *   function must come from one process, no matter from which
     */
    void
    recall(const std::vector<Key> &standard_functions);

    /** How often reinit() has changed anything, or recall() was called. */
    unsigned int
    n_changes() const;

    /**
     * Return what is known about a function that this process sees, or a null
     * pointer if it does not see it.
     */
    const Function *
    find(const Key &key) const;

    /** Return the functions that this process sees. */
    const FunctionTable &
    functions() const;

    /** The same, for those who want them to outlive the next reinit(). */
    std::shared_ptr<const FunctionTable>
    share_functions() const;

    /**
     * Return what is known about any functions; those that are exterior are
     * missing in the result. Collective.
     */
    FunctionTable
    query(const std::vector<Key> &keys) const;

    /**
     * Return function @p i, in lexicographic order, of those that a cell sees
     * (in part 0).
     */
    Key
    cell_function(const typename CartesianLattice<dim>::Index &cell_index,
                  const unsigned int                           level,
                  const unsigned int                           i) const;

    /** The degree of the splines. */
    unsigned int
    degree() const;

    /** The number of functions that a cell sees. */
    unsigned int
    n_functions_per_cell() const;

    /** Total number of active functions. */
    types::global_dof_index
    n_functions() const;

    /** Number of independent functions: the size of a scalar problem. */
    types::global_dof_index
    n_independent() const;

    /** Number of deficient functions. */
    types::global_dof_index
    n_deficient() const;

    /** Number of twins. */
    types::global_dof_index
    n_twins() const;

    /** The independent functions that this process owns: a contiguous range. */
    const IndexSet &
    locally_owned_independent() const;

    /** All functions that this process owns, as a set of all indices. */
    const IndexSet &
    locally_owned() const;

    /** All functions that this process sees, as a set of all indices. */
    const IndexSet &
    locally_relevant() const;

    /** The lattice of the cells. */
    const CartesianLattice<dim> &
    lattice() const;

    /** The communicator of the triangulation. */
    const MPI_Comm &
    communicator() const;

  private:
    /** What reinit() may do to functions; the larger, the more. */
    enum class Change : int
    {
      fractions,
      sides,
      functions
    };

    /** A function as it is now, and as it was before, if it was known here. */
    struct Renewal
    {
      Function       *now;
      const Function *before;
    };

    /**
     * Decide about classes and owners, and list what has become of the
     * functions. Collective.
     */
    FunctionTable
    classify(const SupportTable   &supports,
             const double          threshold,
             const double          hysteresis,
             std::vector<Renewal> &renewals);

    /** What has changed at the functions of this process. */
    Change
    compare(const std::vector<Renewal> &renewals) const;

    /** Number the functions that this process owns. Collective. */
    void
    number(FunctionTable &functions);

    /** Publish own functions, and learn the numbers of others. Collective. */
    void
    tell_others(FunctionTable &functions);

    const MPI_Comm              mpi_communicator;
    const CartesianLattice<dim> cell_lattice;
    const unsigned int          p;
    SharedFunctions<dim>        shared_functions;

    std::shared_ptr<const FunctionTable> table;
    FunctionDirectory<dim, Function>     directory;
    unsigned int                         change_counter = 0;

    types::global_dof_index n_active_functions      = 0;
    types::global_dof_index n_independent_functions = 0;
    types::global_dof_index n_twin_functions        = 0;

    IndexSet owned_independent;
    IndexSet owned;
    IndexSet relevant;
  };
} // namespace EBSMPM

#endif
