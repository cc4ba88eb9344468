// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_splines_fe_bspline_h
#define ebsmpm_splines_fe_bspline_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/polynomial.h>

#include <deal.II/fe/fe_poly.h>

#include <memory>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * The restriction of uniform tensor-product B-splines to one cell.
   *
   * On a uniform knot line, the $p+1$ cardinal B-splines of degree $p$ that do
   * not vanish on a knot span look the same on every span. This class offers
   * these $(p+1)^\text{dim}$ polynomials as shape functions on the reference
   * cell, in lexicographic order: for $p=2$ and $x\in[0,1]$,
   * @f[
   *   N_0 = \tfrac12 (1-x)^2, \quad
   *   N_1 = \tfrac12 + x (1-x), \quad
   *   N_2 = \tfrac12 x^2.
   * @f]
   *
   * The functions reach over $p+1$ cells per direction, which a DoFHandler
   * cannot number; SplineSpace does that. All shape functions are therefore
   * attached to the cell interior, as in FE_DGQ, and an ordinary DoFHandler on
   * this element holds the coefficients cell by cell. That is how a spline
   * field reaches DataOut or VectorTools: copy the coefficients that
   * SplineSpace sees on a cell into the degrees of freedom of the cell.
   *
   * @code
   * DoFHandler<dim> dof_handler(triangulation);
   * dof_handler.distribute_dofs(FE_BSpline<dim>(2));
   * @endcode
   *
   * No shape function takes the value one anywhere for $p\ge 2$, so there are
   * no support points and nothing interpolates. The polynomials are handed to
   * the base class as AnisotropicPolynomials: deal.II's tensor-product fast
   * paths look for a shape function that reaches one and would go wrong.
   *
   * The restriction of equation (12) of Sugai et al. to a cell.
   */
  template <int dim, int spacedim = dim>
  class FE_BSpline : public FE_Poly<dim, spacedim>
  {
  public:
    /**
     * Constructor for B-splines of degree @p degree, of continuity
     * $C^{p-1}$.
     */
    explicit FE_BSpline(const unsigned int degree);

    /**
     * Return <tt>FE_BSpline<dim>(degree)</tt>.
     */
    virtual std::string
    get_name() const override;

    virtual std::unique_ptr<FiniteElement<dim, spacedim>>
    clone() const override;

    /**
     * Return the pieces of the cardinal B-spline on one knot span, the one that
     * starts furthest to the left coming first.
     */
    static std::vector<Polynomials::Polynomial<double>>
    univariate_pieces(const unsigned int degree);
  };
} // namespace EBSMPM

#endif
