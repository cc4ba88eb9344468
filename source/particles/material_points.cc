// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/compat.h>

#include <ebsmpm/particles/material_points.h>

namespace EBSMPM
{
  template <int dim>
  void
  MaterialPoints<dim>::insert(const std::vector<Record> &records)
  {
    std::vector<typename PointSet<dim, MaterialPoint<dim>>::NewPoint> points;
    points.reserve(records.size());
    for (const Record &record : records)
      points.push_back({record.location, record.cell});

    this->create(points,
                 [&records](const unsigned int i, MaterialPoint<dim> &point) {
                   point.initialize(records[i].volume);
                   point.damageable() = records[i].damageable;
                 });
  }



  template <int dim>
  double
  MaterialPoints<dim>::total_volume() const
  {
    double volume = 0;
    for (auto &particle : this->handler())
      volume +=
        MaterialPoint<dim>(particle.get_properties()).reference_volume();
    return Utilities::MPI::sum(volume,
                               get_mpi_communicator(this->triangulation()));
  }



  template class MaterialPoints<2>;
  template class MaterialPoints<3>;
} // namespace EBSMPM
