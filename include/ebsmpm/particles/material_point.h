// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_material_point_h
#define ebsmpm_particles_material_point_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <deal.II/numerics/data_component_interpretation.h>

#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * The state of one material point: names for the numbers that a particle of
   * MaterialPoints carries as its properties.
   *
   * This is a view. It does not own the numbers, costs nothing to create and
   * may be passed by value:
   * @code
   *   for (auto &particle : points.handler())
   *     {
   *       MaterialPoint<dim> point(particle.get_properties());
   *       point.history() = std::max(point.history(), energy);
   *       point.set_deformation_gradient(f * point.deformation_gradient());
   *     }
   * @endcode
   * A new point has the volume given, $F=I$, is "damageable", and all else is
   * zero. Position, position in the cell, and number are those of the particle.
   *
   * The numbers are stored in the order reference volume, damage, history, peak
   * damage, frozen, damageable, displacement (dim), deformation gradient
   * (dim*dim, row by row), side (dim).
   */
  template <int dim>
  class MaterialPoint
  {
  public:
    /**
     * How many numbers a point carries.
     */
    static constexpr unsigned int n_properties = 6 + 2 * dim + dim * dim;

    /**
     * Constructor. @p properties are those of the particle.
     */
    explicit MaterialPoint(const ArrayView<double> &properties);

    /**
     * The volume $V_0$ of the point before any deformation; in 2d, the area.
     */
    double &
    reference_volume();

    double
    reference_volume() const;

    /**
     * The damage $d$.
     */
    double &
    damage();

    double
    damage() const;

    /**
     * The history $H$: the largest tensile energy density so far.
     */
    double &
    history();

    double
    history() const;

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
     * 1 if the point can be damaged, 0 otherwise.
     */
    double &
    damageable();

    double
    damageable() const;

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
     * Give all properties the values of a new point of the given volume.
     */
    void
    initialize(const double volume);

    /**
     * Where to look for the cell of a point, seen from the point itself. This
     * is the point itself; compare BoundaryPoint::search_direction().
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
  inline MaterialPoint<dim>::MaterialPoint(const ArrayView<double> &properties)
    : values(properties.data())
  {
    AssertDimension(properties.size(), n_properties);
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::reference_volume()
  {
    return values[0];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::reference_volume() const
  {
    return values[0];
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::damage()
  {
    return values[1];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::damage() const
  {
    return values[1];
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::history()
  {
    return values[2];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::history() const
  {
    return values[2];
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::peak_damage()
  {
    return values[3];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::peak_damage() const
  {
    return values[3];
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::label_frozen()
  {
    return values[4];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::label_frozen() const
  {
    return values[4];
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::damageable()
  {
    return values[5];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::damageable() const
  {
    return values[5];
  }



  template <int dim>
  inline Tensor<1, dim>
  MaterialPoint<dim>::displacement() const
  {
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = values[6 + d];
    return u;
  }



  template <int dim>
  inline void
  MaterialPoint<dim>::set_displacement(const Tensor<1, dim> &displacement)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[6 + d] = displacement[d];
  }



  template <int dim>
  inline Tensor<2, dim>
  MaterialPoint<dim>::deformation_gradient() const
  {
    Tensor<2, dim> F;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] = values[6 + dim + i * dim + j];
    return F;
  }



  template <int dim>
  inline void
  MaterialPoint<dim>::set_deformation_gradient(const Tensor<2, dim> &gradient)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        values[6 + dim + i * dim + j] = gradient[i][j];
  }



  template <int dim>
  inline Tensor<1, dim>
  MaterialPoint<dim>::side() const
  {
    Tensor<1, dim> m;
    for (unsigned int d = 0; d < dim; ++d)
      m[d] = values[6 + dim + dim * dim + d];
    return m;
  }



  template <int dim>
  inline void
  MaterialPoint<dim>::set_side(const Tensor<1, dim> &side)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[6 + dim + dim * dim + d] = side[d];
  }



  template <int dim>
  inline Tensor<1, dim>
  MaterialPoint<dim>::search_direction() const
  {
    return Tensor<1, dim>();
  }
} // namespace EBSMPM

#endif
