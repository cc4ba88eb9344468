// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_dirichlet_conditions_h
#define ebsmpm_solvers_dirichlet_conditions_h

#include <ebsmpm/particles/cell_points.h>

#include <ebsmpm/assembly/point_state.h>

#include <ebsmpm/solvers/boundary_formulas.h>

#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * Prescribed displacements on the boundary points, component by component, as
   * functions of the position and the load.
   *
   * The values are given as text, one formula per boundary and component,
   * @code
   *   bottom.x = 0; bottom.y = 0; top.x = 0; top.y = u
   * @endcode
   * in the reference coordinates <tt>x, y(, z)</tt> and the load <tt>u</tt>.
   * Components that are not mentioned are free of traction. On a boundary that
   * is not parallel to the coordinates, the component along the outward normal
   * of the undeformed body can be given instead:
   * @code
   *   inclined.normal = 0
   * @endcode
   * is a plane of symmetry, or a boundary along which the body slides.
   */
  template <int dim>
  class DirichletConditions
  {
  public:
    /**
     * Read the conditions.
     *
     * @param text as described above
     * @param boundary_names the names of the boundaries; their position in the
     *   list is the boundary id
     *
     * Raises ExcInput for a name that does not exist, a formula that makes no
     * sense, or a boundary with both a normal and another component.
     */
    DirichletConditions(const std::string              &text,
                        const std::vector<std::string> &boundary_names);

    /**
     * Fill BoundaryState::prescribed and BoundaryState::projection for the load
     * @p load. Boundary ids, normals and displacements must be there already.
     */
    void
    apply(const double           load,
          const CellPoints<dim> &boundary_points,
          BoundaryState<dim>    &boundary) const;

    /**
     * Return $\partial\bar{\mathbf u}/\partial u$ at all boundary points, by
     * central differences; zero in directions that are not prescribed. This is
     * what a force that does work on the load u is made of, see
     * conjugate_force().
     */
    std::vector<Tensor<1, dim>>
    rates(const double              load,
          const CellPoints<dim>    &boundary_points,
          const BoundaryState<dim> &boundary) const;

    /** The formulas. */
    const BoundaryFormulas<dim> &
    formulas() const;

  private:
    /**
     * Call action(direction, value) for all that is prescribed at point @p q,
     * with unit vectors that are orthogonal to each other.
     */
    template <typename Action>
    void
    for_each_direction(const CellPoints<dim>    &boundary_points,
                       const BoundaryState<dim> &boundary,
                       const unsigned int        q,
                       const Action             &action) const;

    const BoundaryFormulas<dim> text_formulas;
  };
} // namespace EBSMPM

#endif
