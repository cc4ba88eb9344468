// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_point_view_h
#define ebsmpm_particles_point_view_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <deal.II/numerics/data_component_interpretation.h>

#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * What MaterialPoint and BoundaryPoint have in common: names for the first of
   * the numbers that a particle carries as its properties, in the order damage,
   * peak damage, frozen, displacement (dim), deformation gradient (dim*dim, row
   * by row), side (dim).
   *
   * A view does not own the numbers, costs nothing to create and may be passed
   * by value.
   */
  template <int dim>
  class PointView
  {
  public:
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

  protected:
    /**
     * How many numbers these are.
     */
    static constexpr unsigned int n_common = 3 + 2 * dim + dim * dim;

    /**
     * Constructor. @p values are the properties of the particle.
     */
    explicit PointView(double *const values);

    /**
     * Set $F=I$, and everything else to zero.
     */
    void
    initialize_common();

    /**
     * Return the names of these properties.
     */
    static std::vector<std::string>
    common_names();

    /**
     * Return which of them form vectors and tensors in output.
     */
    static std::vector<DataComponentInterpretation::DataComponentInterpretation>
    common_interpretations();

    /**
     * All properties of the particle.
     */
    double *const values;

  private:
    Tensor<1, dim>
    vector_at(const unsigned int first) const;

    void
    set_vector_at(const unsigned int first, const Tensor<1, dim> &vector);

    // Where the vectors and the tensor begin.
    static constexpr unsigned int first_displacement = 3;
    static constexpr unsigned int first_gradient     = 3 + dim;
    static constexpr unsigned int first_side         = 3 + dim + dim * dim;
  };



  // ---------------------------- inline functions ----------------------------



  template <int dim>
  inline PointView<dim>::PointView(double *const values)
    : values(values)
  {}



  template <int dim>
  inline double &
  PointView<dim>::damage()
  {
    return values[0];
  }



  template <int dim>
  inline double
  PointView<dim>::damage() const
  {
    return values[0];
  }



  template <int dim>
  inline double &
  PointView<dim>::peak_damage()
  {
    return values[1];
  }



  template <int dim>
  inline double
  PointView<dim>::peak_damage() const
  {
    return values[1];
  }



  template <int dim>
  inline double &
  PointView<dim>::label_frozen()
  {
    return values[2];
  }



  template <int dim>
  inline double
  PointView<dim>::label_frozen() const
  {
    return values[2];
  }



  template <int dim>
  inline Tensor<1, dim>
  PointView<dim>::displacement() const
  {
    return vector_at(first_displacement);
  }



  template <int dim>
  inline void
  PointView<dim>::set_displacement(const Tensor<1, dim> &displacement)
  {
    set_vector_at(first_displacement, displacement);
  }



  template <int dim>
  inline Tensor<2, dim>
  PointView<dim>::deformation_gradient() const
  {
    Tensor<2, dim> F;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] = values[first_gradient + i * dim + j];
    return F;
  }



  template <int dim>
  inline void
  PointView<dim>::set_deformation_gradient(const Tensor<2, dim> &gradient)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        values[first_gradient + i * dim + j] = gradient[i][j];
  }



  template <int dim>
  inline Tensor<1, dim>
  PointView<dim>::side() const
  {
    return vector_at(first_side);
  }



  template <int dim>
  inline void
  PointView<dim>::set_side(const Tensor<1, dim> &side)
  {
    set_vector_at(first_side, side);
  }



  template <int dim>
  inline Tensor<1, dim>
  PointView<dim>::vector_at(const unsigned int first) const
  {
    Tensor<1, dim> vector;
    for (unsigned int d = 0; d < dim; ++d)
      vector[d] = values[first + d];
    return vector;
  }



  template <int dim>
  inline void
  PointView<dim>::set_vector_at(const unsigned int    first,
                                const Tensor<1, dim> &vector)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[first + d] = vector[d];
  }
} // namespace EBSMPM

#endif
