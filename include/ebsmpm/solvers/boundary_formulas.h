// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_boundary_formulas_h
#define ebsmpm_solvers_boundary_formulas_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/types.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace EBSMPM
{
  /**
   * Formulas for data on the boundary, given as text, one for each boundary and
   * component: what DirichletConditions and TractionConditions have in common.
   *
   * The text is a list
   * @code
   *   bottom.x = 0; top.y = 2*u + x
   * @endcode
   * in the reference coordinates <tt>x, y(, z)</tt> and the load <tt>u</tt>.
   * Components are x, y(, z), and what acts along the normal, which the two
   * classes call differently.
   */
  template <int dim>
  class BoundaryFormulas
  {
  public:
    /** The number by which formula() knows what acts along the normal. */
    static constexpr unsigned int along_normal = dim;

    /**
     * Read the formulas.
     *
     * @param name what an entry is called in messages
     * @param text as described above
     * @param boundary_names the names of the boundaries; their position in the
     *   list is the boundary id
     * @param normal_name what entries call the component along the normal
     *
     * Raises ExcInput for a name that does not exist, or a formula that makes
     * no sense.
     */
    BoundaryFormulas(const std::string              &name,
                     const std::string              &text,
                     const std::vector<std::string> &boundary_names,
                     const std::string              &normal_name);

    /** Let the formulas take @p load as the value of u from now on. */
    void
    set_load(const double load) const;

    /** Return the formula for a component, or a null pointer. */
    const FunctionParser<dim> *
    formula(const types::boundary_id id, const unsigned int component) const;

  private:
    std::map<std::pair<types::boundary_id, unsigned int>,
             std::unique_ptr<FunctionParser<dim>>>
      formulas;
  };
} // namespace EBSMPM

#endif
