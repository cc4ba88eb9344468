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

#include <ebsmpm/particles/point_view.h>

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
   * After those of PointView, the numbers are stored in the order reference
   * volume, history, damageable.
   */
  template <int dim>
  class MaterialPoint : public PointView<dim>
  {
  public:
    /**
     * How many numbers a point carries.
     */
    static constexpr unsigned int n_properties = PointView<dim>::n_common + 3;

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
     * The history $H$: the largest tensile energy density so far.
     */
    double &
    history();

    double
    history() const;

    /**
     * 1 if the point can be damaged, 0 otherwise.
     */
    double &
    damageable();

    double
    damageable() const;

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
    using PointView<dim>::n_common;
    using PointView<dim>::values;
  };



  // ---------------------------- inline functions ----------------------------



  template <int dim>
  inline MaterialPoint<dim>::MaterialPoint(const ArrayView<double> &properties)
    : PointView<dim>(properties.data())
  {
    AssertDimension(properties.size(), n_properties);
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::reference_volume()
  {
    return values[n_common];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::reference_volume() const
  {
    return values[n_common];
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::history()
  {
    return values[n_common + 1];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::history() const
  {
    return values[n_common + 1];
  }



  template <int dim>
  inline double &
  MaterialPoint<dim>::damageable()
  {
    return values[n_common + 2];
  }



  template <int dim>
  inline double
  MaterialPoint<dim>::damageable() const
  {
    return values[n_common + 2];
  }



  template <int dim>
  inline Tensor<1, dim>
  MaterialPoint<dim>::search_direction() const
  {
    return Tensor<1, dim>();
  }
} // namespace EBSMPM

#endif
