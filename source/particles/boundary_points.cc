// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/compat.h>

#include <ebsmpm/particles/boundary_points.h>

namespace EBSMPM
{
  template <int dim>
  void
  BoundaryPoints<dim>::insert(const std::vector<Record> &records)
  {
    std::vector<typename PointSet<dim, BoundaryPoint<dim>>::NewPoint> points;
    points.reserve(records.size());
    for (const Record &record : records)
      points.push_back({record.location, record.cell});

    this->create(points,
                 [&records](const unsigned int i, BoundaryPoint<dim> &point) {
                   point.initialize(records[i].area,
                                    records[i].normal,
                                    records[i].boundary_id);
                 });
  }



  template <int dim>
  double
  BoundaryPoints<dim>::total_area(const types::boundary_id boundary_id) const
  {
    double area = 0;
    for (auto &particle : this->handler())
      {
        const BoundaryPoint<dim> point(particle.get_properties());
        if (point.boundary_id() == boundary_id)
          area += point.reference_area();
      }
    return Utilities::MPI::sum(area,
                               get_mpi_communicator(this->triangulation()));
  }



  template class BoundaryPoints<2>;
  template class BoundaryPoints<3>;
} // namespace EBSMPM
