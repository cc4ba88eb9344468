// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/rigid_motions.h>

namespace EBSMPM
{
  namespace RigidMotions
  {
    template <int dim>
    std::array<Tensor<1, dim>, n<dim>>
    at(const Tensor<1, dim> &x)
    {
      std::array<Tensor<1, dim>, n<dim>> motions;
      for (unsigned int a = 0; a < dim; ++a)
        motions[a][a] = 1.;
      for (unsigned int a = 0, m = dim; a < dim; ++a)
        for (unsigned int b = a + 1; b < dim; ++b, ++m)
          {
            motions[m][a] = -x[b];
            motions[m][b] = x[a];
          }
      return motions;
    }



    template <int dim>
    std::vector<LA::Vector>
    coefficients(const SplineSpace<dim> &space, const IndexSet &rows)
    {
      std::vector<LA::Vector> modes(n<dim>,
                                    LA::Vector(rows, space.communicator()));
      const auto             &owned = space.locally_owned_independent();
      if (owned.n_elements() == 0)
        return modes;

      const auto first = owned.nth_index_in_set(0);
      for (const auto &entry : space.functions())
        if (owned.is_element(entry.second.index))
          {
            const auto motions = at<dim>(
              space.lattice().greville_point(entry.first, space.degree()));
            const unsigned int i = dim * (entry.second.index - first);
            for (unsigned int m = 0; m < n<dim>; ++m)
              for (unsigned int a = 0; a < dim; ++a)
                modes[m].begin()[i + a] = motions[m][a];
          }
      return modes;
    }



    template std::array<Tensor<1, 2>, n<2>>
    at<2>(const Tensor<1, 2> &);
    template std::array<Tensor<1, 3>, n<3>>
    at<3>(const Tensor<1, 3> &);
    template std::vector<LA::Vector>
    coefficients<2>(const SplineSpace<2> &, const IndexSet &);
    template std::vector<LA::Vector>
    coefficients<3>(const SplineSpace<3> &, const IndexSet &);
  } // namespace RigidMotions
} // namespace EBSMPM
