// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_traction_conditions_h
#define ebsmpm_solvers_traction_conditions_h

#include <ebsmpm/particles/cell_points.h>

#include <ebsmpm/assembly/point_state.h>

#include <ebsmpm/solvers/boundary_formulas.h>

#include <string>

namespace EBSMPM
{
  /**
   * Tractions on the boundary points (Neumann conditions), as functions of the
   * position and the load.
   *
   * The values are given as text, like those of DirichletConditions,
   * @code
   *   right.x = 10*u; slit.lower.pressure = u; slit.upper.pressure = u
   * @endcode
   * A component is a force per area into the direction of the axis; a pressure
   * $p$ is the traction $-p\mathbf N$. Everything refers to the undeformed
   * body, its areas and its normals (dead load): the force that acts on the
   * body does not change as it deforms, and there is nothing in the tangent. A
   * fluid under pressure follows the deformation; the difference is of the size
   * of the displacement gradient, so take this for small ones only.
   */
  template <int dim>
  class TractionConditions
  {
  public:
    /**
     * Read the conditions; see BoundaryFormulas for the arguments and for what
     * is wrong. Raises ExcInput as well if a component has a traction here and
     * a displacement in @p displacements, which can be given only where the
     * names are the same.
     */
    TractionConditions(const std::string              &text,
                       const std::vector<std::string> &boundary_names,
                       const BoundaryFormulas<dim>    &displacements);

    /**
     * Fill BoundaryState::traction for the load @p load. Boundary ids, normals
     * and displacements must be there already.
     */
    void
    apply(const double           load,
          const CellPoints<dim> &boundary_points,
          BoundaryState<dim>    &boundary) const;

  private:
    const BoundaryFormulas<dim> formulas;
  };
} // namespace EBSMPM

#endif
