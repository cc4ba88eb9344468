// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_rigid_motions_h
#define ebsmpm_assembly_rigid_motions_h

#include <ebsmpm/lac/types.h>

#include <ebsmpm/splines/spline_space.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace EBSMPM
{
  /**
   * The displacements that do not deform a body: translations first, then
   * infinitesimal rotations in the planes of two axes.
   */
  namespace RigidMotions
  {
    /** Their number. */
    template <int dim>
    constexpr unsigned int n = dim *(dim + 1) / 2;

    /** The displacement of a place @p x by each of them. */
    template <int dim>
    std::array<Tensor<1, dim>, n<dim>>
    at(const Tensor<1, dim> &x);

    /**
     * Their coefficients, exactly those as functions reproduce linear
     * polynomials with the values at Greville points: the near null space of
     * the displacement's tangent.
     *
     * @param space of the displacement
     * @param rows the unknowns of this process, <tt>dim*function+component</tt>
     */
    template <int dim>
    std::vector<LA::Vector>
    coefficients(const SplineSpace<dim> &space, const IndexSet &rows);
  } // namespace RigidMotions
} // namespace EBSMPM

#endif
