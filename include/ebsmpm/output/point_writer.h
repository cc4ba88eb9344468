// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_point_writer_h
#define ebsmpm_output_point_writer_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/output/patches.h>
#include <ebsmpm/output/vtu_series.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/tensor.h>

#include <deal.II/particles/particle_handler.h>

#include <functional>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * Writer of points with named fields, for graphics programs.
   *
   * Works for everything that is kept in a ParticleHandler. A field is a name
   * and a function of the particle, so that derived quantities, such as
   * $J=\det F$, cost nothing but a line, and that nothing has to be written
   * that nobody looks at. make_material_point_writer() and
   * make_boundary_point_writer() know the fields of our own points;
   * Particles::DataOut would write all properties as they are stored.
   *
   * @code
   * PointWriter<dim> writer;
   * writer.add_scalar("J", [](auto &particle) {
   *   return determinant(
   *     MaterialPoint<dim>(particle.get_properties()).deformation_gradient());
   * });
   * VTUSeries series(directory, "points", communicator, Overwrite::no);
   * writer.write(points.handler(), series, step, time);
   * @endcode
   *
   * The positions are those of the particles, that is, the current ones. All
   * files also have the particles' <tt>id</tt>, exact up to $2^{24}$ because
   * deal.II writes single precision.
   *
   * A value that is not finite is never written: all ranks throw
   * ExcSolverFailure that names the field and the point. The cost is one copy
   * of the fields in single precision.
   */
  template <int dim>
  class PointWriter
  {
  public:
    /**
     * What the functions of fields are called with. It is not const because the
     * views on properties can also write; the functions must not.
     */
    using Particle = Particles::ParticleAccessor<dim>;

    /**
     * Add a scalar field.
     */
    void
    add_scalar(const std::string                       &name,
               const std::function<double(Particle &)> &value);

    /**
     * Add a vector field.
     */
    void
    add_vector(const std::string                               &name,
               const std::function<Tensor<1, dim>(Particle &)> &value);

    /**
     * Add a tensor field.
     */
    void
    add_tensor(const std::string                               &name,
               const std::function<Tensor<2, dim>(Particle &)> &value);

    /**
     * Return the patches of all locally owned particles. Collective. Throws
     * ExcSolverFailure for a value that is not finite.
     */
    Patches<0, dim>
    build_patches(const Particles::ParticleHandler<dim> &handler,
                  const MPI_Comm                         communicator) const;

    /**
     * Write all particles as the contents of @p step of @p series. Collective.
     */
    void
    write(const Particles::ParticleHandler<dim> &handler,
          VTUSeries                             &series,
          const unsigned int                     step,
          const double                           time) const;

  private:
    struct Field
    {
      std::string                              name;
      typename Patches<0, dim>::Interpretation interpretation;

      /**
       * Writes the components of the field into the array that begins with its
       * second argument.
       */
      std::function<void(Particle &, float *)> values;
    };

    std::vector<Field> fields;
  };
} // namespace EBSMPM

#endif
