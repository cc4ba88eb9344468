// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/output/point_writer.h>

#include <deal.II/numerics/data_component_interpretation.h>

#include <sstream>

namespace EBSMPM
{
  template <int dim>
  void
  PointWriter<dim>::add_scalar(const std::string                       &name,
                               const std::function<double(Particle &)> &value)
  {
    fields.push_back({name,
                      DataComponentInterpretation::component_is_scalar,
                      [value](Particle &particle, float *result) {
                        *result = value(particle);
                      }});
  }



  template <int dim>
  void
  PointWriter<dim>::add_vector(
    const std::string                               &name,
    const std::function<Tensor<1, dim>(Particle &)> &value)
  {
    fields.push_back({name,
                      DataComponentInterpretation::component_is_part_of_vector,
                      [value](Particle &particle, float *result) {
                        const Tensor<1, dim> v = value(particle);
                        for (unsigned int d = 0; d < dim; ++d)
                          result[d] = v[d];
                      }});
  }



  template <int dim>
  void
  PointWriter<dim>::add_tensor(
    const std::string                               &name,
    const std::function<Tensor<2, dim>(Particle &)> &value)
  {
    fields.push_back({name,
                      DataComponentInterpretation::component_is_part_of_tensor,
                      [value](Particle &particle, float *result) {
                        const Tensor<2, dim> t = value(particle);
                        for (unsigned int d = 0; d < dim; ++d)
                          for (unsigned int e = 0; e < dim; ++e)
                            result[d * dim + e] = t[d][e];
                      }});
  }



  template <int dim>
  Patches<0, dim>
  PointWriter<dim>::build_patches(
    const Particles::ParticleHandler<dim> &handler,
    const MPI_Comm                         communicator) const
  {
    Patches<0, dim>           patches;
    std::vector<unsigned int> first_component;
    patches.declare("id", DataComponentInterpretation::component_is_scalar);
    for (const Field &field : fields)
      {
        first_component.push_back(patches.n_components());
        patches.declare(field.name, field.interpretation);
      }

    std::string                problem;
    std::vector<float>         values(patches.n_components());
    DataOutBase::Patch<0, dim> patch;
    patch.data.reinit(patches.n_components(), 1);

    for (auto particle = handler.begin(); particle != handler.end(); ++particle)
      {
        values[0] = particle->get_id();
        for (unsigned int f = 0; f < fields.size(); ++f)
          fields[f].values(*particle, &values[first_component[f]]);

        for (unsigned int c = 0; c < values.size(); ++c)
          {
            if (!Patches<0, dim>::is_finite(values[c]) && problem.empty())
              {
                std::ostringstream text;
                text << "The field '" << patches.component_name(c) << "' is "
                     << values[c] << " at point " << particle->get_id()
                     << " at (" << particle->get_location() << ").";
                problem = text.str();
              }
            patch.data(c, 0) = values[c];
          }

        patch.vertices[0] = particle->get_location();
        patches.add(patch);
      }

    problem = first_message(problem, communicator);
    AssertThrow(problem.empty(), ExcSolverFailure(problem));
    return patches;
  }



  template <int dim>
  void
  PointWriter<dim>::write(const Particles::ParticleHandler<dim> &handler,
                          VTUSeries                             &series,
                          const unsigned int                     step,
                          const double                           time) const
  {
    Patches<0, dim> patches = build_patches(handler, series.get_communicator());
    series.write(patches, step, time);
  }
} // namespace EBSMPM



template class EBSMPM::PointWriter<2>;
template class EBSMPM::PointWriter<3>;
