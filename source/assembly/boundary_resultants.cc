// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/assembly/boundary_resultants.h>

#include <algorithm>

namespace EBSMPM
{
  namespace BoundaryResultants
  {
    template <int dim>
    std::map<types::boundary_id, Tensor<1, dim>>
    reactions(const BoundaryState<dim>              &boundary,
              const std::vector<Tensor<1, dim>>     &flux,
              const std::vector<types::boundary_id> &ids,
              const MPI_Comm                         communicator)
    {
      std::map<types::boundary_id, Tensor<1, dim>> result;
      for (const auto id : ids)
        result[id] = Tensor<1, dim>();
      for (unsigned int q = 0; q < flux.size(); ++q)
        result.at(boundary.boundary_id[q]) +=
          boundary.area[q] * (boundary.projection[q] * flux[q]);
      for (auto &entry : result)
        entry.second = Utilities::MPI::sum(entry.second, communicator);
      return result;
    }



    template <int dim>
    double
    conjugate_force(const BoundaryState<dim>          &boundary,
                    const std::vector<Tensor<1, dim>> &flux,
                    const std::vector<Tensor<1, dim>> &rates,
                    const MPI_Comm                     communicator)
    {
      double sum = 0.;
      for (unsigned int q = 0; q < rates.size(); ++q)
        sum += boundary.area[q] * (flux[q] * rates[q]);
      return Utilities::MPI::sum(sum, communicator);
    }



    template <int dim>
    double
    traction_work(const BoundaryState<dim>                       &boundary,
                  const typename DisplacementSystem<dim>::Update &update,
                  const MPI_Comm                                  communicator)
    {
      double sum = 0.;
      for (unsigned int q = 0; q < boundary.area.size(); ++q)
        sum += boundary.area[q] *
               (boundary.traction[q] *
                (boundary.displacement[q] + update.displacement_increment[q]));
      return Utilities::MPI::sum(sum, communicator);
    }



    template <int dim>
    double
    opened_volume(const BoundaryState<dim>                       &boundary,
                  const typename DisplacementSystem<dim>::Update &update,
                  const std::vector<types::boundary_id>          &ids,
                  const MPI_Comm                                  communicator)
    {
      double sum = 0.;
      for (unsigned int q = 0; q < boundary.area.size(); ++q)
        if (std::find(ids.begin(), ids.end(), boundary.boundary_id[q]) !=
            ids.end())
          sum -= boundary.area[q] *
                 (boundary.normal[q] * (boundary.displacement[q] +
                                        update.displacement_increment[q]));
      return Utilities::MPI::sum(sum, communicator);
    }



    template std::map<types::boundary_id, Tensor<1, 2>>
    reactions<2>(const BoundaryState<2> &,
                 const std::vector<Tensor<1, 2>> &,
                 const std::vector<types::boundary_id> &,
                 const MPI_Comm);

    template double
    conjugate_force<2>(const BoundaryState<2> &,
                       const std::vector<Tensor<1, 2>> &,
                       const std::vector<Tensor<1, 2>> &,
                       const MPI_Comm);
    template std::map<types::boundary_id, Tensor<1, 3>>
    reactions<3>(const BoundaryState<3> &,
                 const std::vector<Tensor<1, 3>> &,
                 const std::vector<types::boundary_id> &,
                 const MPI_Comm);

    template double
    conjugate_force<3>(const BoundaryState<3> &,
                       const std::vector<Tensor<1, 3>> &,
                       const std::vector<Tensor<1, 3>> &,
                       const MPI_Comm);

    template double
    traction_work<2>(const BoundaryState<2> &,
                     const typename DisplacementSystem<2>::Update &,
                     const MPI_Comm);
    template double
    traction_work<3>(const BoundaryState<3> &,
                     const typename DisplacementSystem<3>::Update &,
                     const MPI_Comm);

    template double
    opened_volume<2>(const BoundaryState<2> &,
                     const typename DisplacementSystem<2>::Update &,
                     const std::vector<types::boundary_id> &,
                     const MPI_Comm);
    template double
    opened_volume<3>(const BoundaryState<3> &,
                     const typename DisplacementSystem<3>::Update &,
                     const std::vector<types::boundary_id> &,
                     const MPI_Comm);
  } // namespace BoundaryResultants
} // namespace EBSMPM
