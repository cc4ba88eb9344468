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

#include <ebsmpm/base/config.h>

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
   * The numbers are stored in the order reference area, boundary id, damage,
   * peak damage, frozen, reference normal (dim), displacement (dim),
   * deformation gradient (dim*dim, row by row), side (dim).
   */
  template <int dim>
  class BoundaryPoint
  {
  public:
    /**
     * How many numbers a point carries.
     */
    static constexpr unsigned int n_properties = 5 + 3 * dim + dim * dim;

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
     * The damage $d$ at the point.
     */
    double &
    damage();

    double
    damage() const;

    /**
     * The largest damage so far, or 1 next to a slit.
     */
    double &
    peak_damage();

    double
    peak_damage() const;

    /**
     * 1 if side() is settled once and for all, 0 otherwise.
     */
    double &
    label_frozen();

    double
    label_frozen() const;

    /**
     * The unit normal $N$ before any deformation. It points out of the body.
     */
    Tensor<1, dim>
    reference_normal() const;

    void
    set_reference_normal(const Tensor<1, dim> &normal);

    /**
     * The total displacement $u$.
     */
    Tensor<1, dim>
    displacement() const;

    void
    set_displacement(const Tensor<1, dim> &displacement);

    /**
     * The deformation gradient $F$, without the trivial row and column in 2d.
     */
    Tensor<2, dim>
    deformation_gradient() const;

    void
    set_deformation_gradient(const Tensor<2, dim> &gradient);

    /**
     * The unit vector that points towards the crack next to the point; zero if
     * there is none.
     */
    Tensor<1, dim>
    side() const;

    void
    set_side(const Tensor<1, dim> &side);

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
    double *const values;
  };



  // ---------------------------- inline functions ----------------------------



  template <int dim>
  inline BoundaryPoint<dim>::BoundaryPoint(const ArrayView<double> &properties)
    : values(properties.data())
  {
    AssertDimension(properties.size(), n_properties);
  }



  template <int dim>
  inline double &
  BoundaryPoint<dim>::reference_area()
  {
    return values[0];
  }



  template <int dim>
  inline double
  BoundaryPoint<dim>::reference_area() const
  {
    return values[0];
  }



  template <int dim>
  inline types::boundary_id
  BoundaryPoint<dim>::boundary_id() const
  {
    return static_cast<types::boundary_id>(values[1]);
  }



  template <int dim>
  inline void
  BoundaryPoint<dim>::set_boundary_id(const types::boundary_id id)
  {
    values[1] = id;
  }



  template <int dim>
  inline double &
  BoundaryPoint<dim>::damage()
  {
    return values[2];
  }



  template <int dim>
  inline double
  BoundaryPoint<dim>::damage() const
  {
    return values[2];
  }



  template <int dim>
  inline double &
  BoundaryPoint<dim>::peak_damage()
  {
    return values[3];
  }



  template <int dim>
  inline double
  BoundaryPoint<dim>::peak_damage() const
  {
    return values[3];
  }



  template <int dim>
  inline double &
  BoundaryPoint<dim>::label_frozen()
  {
    return values[4];
  }



  template <int dim>
  inline double
  BoundaryPoint<dim>::label_frozen() const
  {
    return values[4];
  }



  template <int dim>
  inline Tensor<1, dim>
  BoundaryPoint<dim>::reference_normal() const
  {
    Tensor<1, dim> N;
    for (unsigned int d = 0; d < dim; ++d)
      N[d] = values[5 + d];
    return N;
  }



  template <int dim>
  inline void
  BoundaryPoint<dim>::set_reference_normal(const Tensor<1, dim> &normal)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[5 + d] = normal[d];
  }



  template <int dim>
  inline Tensor<1, dim>
  BoundaryPoint<dim>::displacement() const
  {
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = values[5 + dim + d];
    return u;
  }



  template <int dim>
  inline void
  BoundaryPoint<dim>::set_displacement(const Tensor<1, dim> &displacement)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[5 + dim + d] = displacement[d];
  }



  template <int dim>
  inline Tensor<2, dim>
  BoundaryPoint<dim>::deformation_gradient() const
  {
    Tensor<2, dim> F;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] = values[5 + 2 * dim + i * dim + j];
    return F;
  }



  template <int dim>
  inline void
  BoundaryPoint<dim>::set_deformation_gradient(const Tensor<2, dim> &gradient)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        values[5 + 2 * dim + i * dim + j] = gradient[i][j];
  }



  template <int dim>
  inline Tensor<1, dim>
  BoundaryPoint<dim>::side() const
  {
    Tensor<1, dim> m;
    for (unsigned int d = 0; d < dim; ++d)
      m[d] = values[5 + 2 * dim + dim * dim + d];
    return m;
  }



  template <int dim>
  inline void
  BoundaryPoint<dim>::set_side(const Tensor<1, dim> &side)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[5 + 2 * dim + dim * dim + d] = side[d];
  }



  template <int dim>
  inline Tensor<1, dim>
  BoundaryPoint<dim>::normal() const
  {
    const Tensor<1, dim> n =
      transpose(invert(deformation_gradient())) * reference_normal();
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
