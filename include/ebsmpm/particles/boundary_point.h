// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_boundary_point_h
#define ebsmpm_particles_boundary_point_h

#include <ebsmpm/particles/point_view.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <deal.II/numerics/data_component_interpretation.h>

#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * The state of one boundary point: names for the numbers that a particle of
   * BoundaryPoints carries as its properties. A view like MaterialPoint.
   *
   * After those of PointView, the numbers are stored in the order reference
   * area, boundary id, reference normal (dim).
   */
  template <int dim>
  class BoundaryPoint : public PointView<dim>
  {
  public:
    /**
     * How many numbers a point carries.
     */
    static constexpr unsigned int n_properties =
      PointView<dim>::n_common + 2 + dim;

    /**
     * Constructor. @p properties are those of the particle.
     */
    explicit BoundaryPoint(const ArrayView<double> &properties);

    /**
     * The area $A_0$ of the point before any deformation; in 2d, the length.
     */
    double &
    reference_area();

    double
    reference_area() const;

    /**
     * The number of the part of the boundary to which the point belongs.
     */
    types::boundary_id
    boundary_id() const;

    void
    set_boundary_id(const types::boundary_id id);

    /**
     * The unit normal $N$ before any deformation. It points out of the body.
     */
    Tensor<1, dim>
    reference_normal() const;

    void
    set_reference_normal(const Tensor<1, dim> &normal);

    /**
     * The unit normal of the deformed body, $F^{-T}N/|F^{-T}N|$.
     */
    Tensor<1, dim>
    normal() const;

    /**
     * Give all properties the values of a new point.
     */
    void
    initialize(const double             area,
               const Tensor<1, dim>    &normal,
               const types::boundary_id id);

    /**
     * Where to look for the cell of a point, seen from the point itself. A
     * boundary that lies on a grid line belongs to two cells, and the point is
     * to go where the body is, so this is against the normal.
     */
    Tensor<1, dim>
    search_direction() const;

    /**
     * Return the names of all properties, as Particles::DataOut needs them.
     */
    static std::vector<std::string>
    component_names();

    /**
     * Return which properties form vectors and tensors in output.
     */
    static std::vector<DataComponentInterpretation::DataComponentInterpretation>
    component_interpretations();

  private:
    using PointView<dim>::n_common;
    using PointView<dim>::values;
  };



  // ---------------------------- inline functions ----------------------------



  template <int dim>
  inline BoundaryPoint<dim>::BoundaryPoint(const ArrayView<double> &properties)
    : PointView<dim>(properties.data())
  {
    AssertDimension(properties.size(), n_properties);
  }



  template <int dim>
  inline double &
  BoundaryPoint<dim>::reference_area()
  {
    return values[n_common];
  }



  template <int dim>
  inline double
  BoundaryPoint<dim>::reference_area() const
  {
    return values[n_common];
  }



  template <int dim>
  inline types::boundary_id
  BoundaryPoint<dim>::boundary_id() const
  {
    return static_cast<types::boundary_id>(values[n_common + 1]);
  }



  template <int dim>
  inline void
  BoundaryPoint<dim>::set_boundary_id(const types::boundary_id id)
  {
    values[n_common + 1] = id;
  }



  template <int dim>
  inline Tensor<1, dim>
  BoundaryPoint<dim>::reference_normal() const
  {
    Tensor<1, dim> N;
    for (unsigned int d = 0; d < dim; ++d)
      N[d] = values[n_common + 2 + d];
    return N;
  }



  template <int dim>
  inline void
  BoundaryPoint<dim>::set_reference_normal(const Tensor<1, dim> &normal)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[n_common + 2 + d] = normal[d];
  }



  template <int dim>
  inline Tensor<1, dim>
  BoundaryPoint<dim>::normal() const
  {
    const Tensor<1, dim> n =
      transpose(invert(this->deformation_gradient())) * reference_normal();
    return n / n.norm();
  }



  template <int dim>
  inline Tensor<1, dim>
  BoundaryPoint<dim>::search_direction() const
  {
    return -normal();
  }
} // namespace EBSMPM

#endif
