// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/splines/bspline_kernel.h>

#include <ebsmpm/assembly/supports.h>

#include <algorithm>

namespace EBSMPM
{
  template <int dim>
  void
  add_supports(const CellPoints<dim>                                 &points,
               const std::vector<double>                             &volumes,
               const std::vector<typename PointGroups<dim>::Pattern> &patterns,
               const SplineSpace<dim>                                &space,
               typename SplineSpace<dim>::SupportTable               &supports)
  {
    Assert(volumes.empty() || volumes.size() == points.n_points(),
           ExcDimensionMismatch(volumes.size(), points.n_points()));
    Assert(patterns.empty() || patterns.size() == points.n_points(),
           ExcDimensionMismatch(patterns.size(), points.n_points()));

    const BSplineKernel<dim> kernel(space.degree());
    const unsigned int       n = kernel.n_functions();

    // Sum up cell by cell, part 0 and twins, and look up functions only once
    // per cell.
    std::array<double, BSplineKernel<dim>::max_n_functions>                B;
    std::array<std::array<double, BSplineKernel<dim>::max_n_functions>, 2> sums;
    std::array<std::array<bool, BSplineKernel<dim>::max_n_functions>, 2>   read;

    for (const auto &cell : points.cells())
      {
        for (unsigned int part = 0; part < 2; ++part)
          {
            sums[part].fill(0.);
            read[part].fill(false);
          }
        for (unsigned int q = cell.begin; q < cell.end; ++q)
          {
            if (!volumes.empty())
              kernel.values(points.unit_point(q), B.data());
            for (unsigned int i = 0; i < n; ++i)
              {
                const unsigned int part =
                  patterns.empty() ? 0 : (patterns[q] >> i) & 1;
                read[part][i] = true;
                if (!volumes.empty())
                  sums[part][i] += B[i] * volumes[q];
              }
          }

        // The integral of a function over its support is the volume of a cell.
        double               measure = 1.;
        const Tensor<1, dim> h       = space.lattice().cell_extents(cell.level);
        for (unsigned int d = 0; d < dim; ++d)
          measure *= h[d];
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int part = 0; part < 2; ++part)
            if (read[part][i])
              supports[space.cell_function(cell.index, cell.level, i)
                         .with_part(part)]
                .fraction += sums[part][i] / measure;
      }
  }



  template void
  add_supports<2>(const CellPoints<2> &,
                  const std::vector<double> &,
                  const std::vector<typename PointGroups<2>::Pattern> &,
                  const SplineSpace<2> &,
                  typename SplineSpace<2>::SupportTable &);
  template void
  add_supports<3>(const CellPoints<3> &,
                  const std::vector<double> &,
                  const std::vector<typename PointGroups<3>::Pattern> &,
                  const SplineSpace<3> &,
                  typename SplineSpace<3>::SupportTable &);
} // namespace EBSMPM
