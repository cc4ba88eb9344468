// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/particles/boundary_point.h>
#include <ebsmpm/particles/material_point.h>

#include <ebsmpm/output/point_fields.h>

namespace EBSMPM
{
  template <int dim>
  PointWriter<dim>
  make_material_point_writer()
  {
    using Particle  = typename PointWriter<dim>::Particle;
    const auto view = [](Particle &particle) {
      return MaterialPoint<dim>(particle.get_properties());
    };

    PointWriter<dim> writer;
    writer.add_scalar("damage",
                      [view](Particle &p) { return view(p).damage(); });
    writer.add_scalar("history",
                      [view](Particle &p) { return view(p).history(); });
    writer.add_scalar("peak_damage",
                      [view](Particle &p) { return view(p).peak_damage(); });
    writer.add_scalar("J", [view](Particle &p) {
      return determinant(view(p).deformation_gradient());
    });
    writer.add_scalar("reference_volume", [view](Particle &p) {
      return view(p).reference_volume();
    });
    writer.add_scalar("damageable",
                      [view](Particle &p) { return view(p).damageable(); });
    writer.add_scalar("label_frozen",
                      [view](Particle &p) { return view(p).label_frozen(); });
    writer.add_vector("displacement",
                      [view](Particle &p) { return view(p).displacement(); });
    writer.add_vector("side", [view](Particle &p) { return view(p).side(); });
    return writer;
  }



  template <int dim>
  PointWriter<dim>
  make_boundary_point_writer()
  {
    using Particle  = typename PointWriter<dim>::Particle;
    const auto view = [](Particle &particle) {
      return BoundaryPoint<dim>(particle.get_properties());
    };

    PointWriter<dim> writer;
    writer.add_scalar("damage",
                      [view](Particle &p) { return view(p).damage(); });
    writer.add_scalar("peak_damage",
                      [view](Particle &p) { return view(p).peak_damage(); });
    writer.add_scalar("reference_area",
                      [view](Particle &p) { return view(p).reference_area(); });
    writer.add_scalar("boundary_id",
                      [view](Particle &p) { return view(p).boundary_id(); });
    writer.add_scalar("label_frozen",
                      [view](Particle &p) { return view(p).label_frozen(); });
    writer.add_vector("displacement",
                      [view](Particle &p) { return view(p).displacement(); });
    writer.add_vector("side", [view](Particle &p) { return view(p).side(); });
    writer.add_vector("normal",
                      [view](Particle &p) { return view(p).normal(); });
    return writer;
  }
} // namespace EBSMPM



template EBSMPM::PointWriter<2>
EBSMPM::make_material_point_writer();
template EBSMPM::PointWriter<3>
EBSMPM::make_material_point_writer();
template EBSMPM::PointWriter<2>
EBSMPM::make_boundary_point_writer();
template EBSMPM::PointWriter<3>
EBSMPM::make_boundary_point_writer();
