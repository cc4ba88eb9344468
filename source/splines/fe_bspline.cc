// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/fe_bspline.h>

#include <deal.II/base/tensor_product_polynomials.h>
#include <deal.II/base/utilities.h>

namespace EBSMPM
{
  namespace internal
  {
    namespace FE_BSplineImplementation
    {
      template <int dim>
      FiniteElementData<dim>
      fe_data(const unsigned int degree)
      {
        std::vector<unsigned int> dofs_per_object(dim + 1, 0U);
        dofs_per_object[dim] = Utilities::fixed_power<dim>(degree + 1);
        return FiniteElementData<dim>(dofs_per_object,
                                      1,
                                      degree,
                                      FiniteElementData<dim>::L2);
      }
    } // namespace FE_BSplineImplementation
  }   // namespace internal



  template <int dim, int spacedim>
  FE_BSpline<dim, spacedim>::FE_BSpline(const unsigned int degree)
    : FE_Poly<dim, spacedim>(
        AnisotropicPolynomials<dim>(
          std::vector<std::vector<Polynomials::Polynomial<double>>>(
            dim,
            univariate_pieces(degree))),
        internal::FE_BSplineImplementation::fe_data<dim>(degree),
        std::vector<bool>(Utilities::fixed_power<dim>(degree + 1), true),
        std::vector<ComponentMask>(Utilities::fixed_power<dim>(degree + 1),
                                   ComponentMask(1, true)))
  {}



  template <int dim, int spacedim>
  std::string
  FE_BSpline<dim, spacedim>::get_name() const
  {
    return "FE_BSpline<" + Utilities::dim_string(dim, spacedim) + ">(" +
           std::to_string(this->degree) + ")";
  }



  template <int dim, int spacedim>
  std::unique_ptr<FiniteElement<dim, spacedim>>
  FE_BSpline<dim, spacedim>::clone() const
  {
    return std::make_unique<FE_BSpline<dim, spacedim>>(*this);
  }



  template <int dim, int spacedim>
  std::vector<Polynomials::Polynomial<double>>
  FE_BSpline<dim, spacedim>::univariate_pieces(const unsigned int degree)
  {
    using Polynomial = Polynomials::Polynomial<double>;

    // The Cox-de Boor recursion on the knots 0,1,2,..., span by span: the
    // piece of the degree-p spline on [k,k+1], in the coordinate x=t-k, is
    //   (k+x)/p * piece_{p-1,k}(x) + (p+1-k-x)/p * piece_{p-1,k-1}(x).
    std::vector<Polynomial> pieces(1, Polynomial(std::vector<double>{1.}));
    for (unsigned int p = 1; p <= degree; ++p)
      {
        std::vector<Polynomial> next;
        for (unsigned int k = 0; k <= p; ++k)
          {
            Polynomial sum(std::vector<double>(p + 1, 0.));
            if (k < p)
              {
                Polynomial rising(std::vector<double>{1. * k / p, 1. / p});
                sum += (rising *= pieces[k]);
              }
            if (k > 0)
              {
                Polynomial falling(
                  std::vector<double>{(p + 1. - k) / p, -1. / p});
                sum += (falling *= pieces[k - 1]);
              }
            next.push_back(sum);
          }
        pieces = next;
      }

    // The spline starting furthest to the left shows its last piece here.
    return {pieces.rbegin(), pieces.rend()};
  }



  template class FE_BSpline<1>;
  template class FE_BSpline<2>;
  template class FE_BSpline<3>;
} // namespace EBSMPM
