// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/boolean_shapes.h>
#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/notch.h>
#include <ebsmpm/particles/primitive_shapes.h>

#include <algorithm>

namespace EBSMPM
{
  namespace Notch
  {
    namespace
    {
      // Directions in the plane with the given normal.
      std::vector<Tensor<1, 2>>
      directions_in_plane(const Tensor<1, 2> &n)
      {
        const Tensor<1, 2> t = Point<2>(-n[1], n[0]);
        return {t, -t};
      }



      std::vector<Tensor<1, 3>>
      directions_in_plane(const Tensor<1, 3> &n)
      {
        unsigned int smallest = 0;
        for (unsigned int d = 1; d < 3; ++d)
          if (std::abs(n[d]) < std::abs(n[smallest]))
            smallest = d;
        Tensor<1, 3> s = cross_product_3d(n, Point<3>::unit_vector(smallest));
        s /= s.norm();
        const Tensor<1, 3> t = cross_product_3d(n, s);

        std::vector<Tensor<1, 3>> directions;
        constexpr unsigned int    n_directions = 16;
        for (unsigned int i = 0; i < n_directions; ++i)
          {
            const double phi = 2. * numbers::PI * i / n_directions;
            directions.push_back(std::cos(phi) * s + std::sin(phi) * t);
          }
        return directions;
      }



      // Whether a point is on the side to which the normal of the plane points.
      template <int dim>
      bool
      is_above(const MaterialPoint<dim> &,
               const double distance,
               const Tensor<1, dim> &,
               const double tie)
      {
        return distance >= -tie;
      }



      // The same for boundary points. On a face of the slit, only the normal
      // tells.
      template <int dim>
      bool
      is_above(const BoundaryPoint<dim> &point,
               const double              distance,
               const Tensor<1, dim>     &n,
               const double              tie)
      {
        const double along = point.reference_normal() * n;
        if (std::abs(distance) <= tie && std::abs(along) > 1. - 1e-6)
          return along < 0.;
        return distance >= -tie;
      }



      // Label the points of one kind.
      template <int dim, typename View>
      void
      label(const Slit<dim> &slit, PointSet<dim, View> &points)
      {
        const Tensor<1, dim>              n = slit.normal / slit.normal.norm();
        const std::vector<Tensor<1, dim>> directions = directions_in_plane(n);
        const double                      tie        = 1e-10 * slit.label_width;
        const double                      reach =
          slit.label_reach > 0. ? slit.label_reach : slit.label_width;

        for (auto &particle : points.handler())
          {
            const Point<dim> &x        = particle.get_location();
            const double      distance = (x - slit.point) * n;
            if (std::abs(distance) > slit.label_width + tie)
              continue;

            // The foot of the perpendicular is on the slit, or not far ahead
            // of it. The region has no distance function, so look around.
            const Point<dim> foot    = x - distance * n;
            const bool       is_open = slit.open_region->contains(foot);
            bool             is_near = is_open;
            for (const double radius :
                 {0.25 * reach, 0.5 * reach, 0.75 * reach, reach})
              for (const Tensor<1, dim> &direction : directions)
                is_near = is_near ||
                          slit.open_region->contains(foot + radius * direction);
            if (!is_near)
              continue;

            View view(particle.get_properties());
            view.set_side(is_above(view, distance, n, tie) ? -n : n);
            view.label_frozen() = 1;
            bool is_broken =
              is_open && std::abs(distance) <= slit.damage_width + tie;
            if (slit.tip_margin > 0.)
              for (const Tensor<1, dim> &direction : directions)
                is_broken = is_broken && slit.open_region->contains(
                                           foot + slit.tip_margin * direction);
            if (is_broken)
              view.peak_damage() = 1;
          }
      }
    } // namespace



    template <int dim>
    void
    add_faces(const Slit<dim>                         &slit,
              const std::shared_ptr<const Shape<dim>> &body,
              const double                             spacing,
              const types::boundary_id                 lower_id,
              const types::boundary_id                 upper_id,
              BoundaryPoints<dim>                     &boundary_points)
    {
      // The surface of what is below the plane, which a plane without end would
      // not have: what of it lies in the plane is the lower face.
      const Tensor<1, dim>         n = slit.normal / slit.normal.norm();
      const IntersectionShape<dim> below(
        std::make_shared<HalfSpaceShape<dim>>(slit.point, n),
        std::make_shared<IntersectionShape<dim>>(body, slit.open_region));

      std::vector<BoundaryElement<dim>> elements;
      std::vector<types::boundary_id>   ids;
      for (BoundaryElement<dim> element : below.boundary_elements(spacing))
        {
          if (element.normal * n < 1. - 1e-6 ||
              std::abs((element.midpoint - slit.point) * n) > 1e-6 * spacing)
            continue;
          elements.push_back(element);
          ids.push_back(lower_id);
          element.normal = -n;
          elements.push_back(element);
          ids.push_back(upper_id);
        }
      AssertThrow(!elements.empty(),
                  ExcInput("The slit has no faces, as it is not open anywhere "
                           "in the body."));
      PointGenerator::insert_elements(elements, ids, boundary_points);
    }



    template <int dim>
    void
    label_slit(const Slit<dim>     &slit,
               MaterialPoints<dim> &points,
               BoundaryPoints<dim> &boundary_points)
    {
      AssertThrow(slit.normal.norm() > 0,
                  ExcInput("The normal of a slit must not be zero."));
      AssertThrow(slit.open_region != nullptr,
                  ExcInput("A slit needs a region in which it is open."));
      label(slit, points);
      label(slit, boundary_points);
    }



    template <int dim>
    void
    initial_history(const Shape<dim>    &shape,
                    const double         value,
                    MaterialPoints<dim> &points)
    {
      for (auto &particle : points.handler())
        if (shape.contains(particle.get_location()))
          {
            MaterialPoint<dim> point(particle.get_properties());
            point.history() = std::max(point.history(), value);
          }
    }



    template void
    add_faces<2>(const Slit<2> &,
                 const std::shared_ptr<const Shape<2>> &,
                 const double,
                 const types::boundary_id,
                 const types::boundary_id,
                 BoundaryPoints<2> &);
    template void
    add_faces<3>(const Slit<3> &,
                 const std::shared_ptr<const Shape<3>> &,
                 const double,
                 const types::boundary_id,
                 const types::boundary_id,
                 BoundaryPoints<3> &);

    template void
    label_slit<2>(const Slit<2> &, MaterialPoints<2> &, BoundaryPoints<2> &);
    template void
    label_slit<3>(const Slit<3> &, MaterialPoints<3> &, BoundaryPoints<3> &);

    template void
    initial_history<2>(const Shape<2> &, const double, MaterialPoints<2> &);
    template void
    initial_history<3>(const Shape<3> &, const double, MaterialPoints<3> &);
  } // namespace Notch
} // namespace EBSMPM
