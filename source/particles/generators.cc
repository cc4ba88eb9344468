// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/compat.h>
#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/expression.h>
#include <ebsmpm/particles/generators.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <sstream>

namespace EBSMPM
{
  namespace PointGenerator
  {
    namespace
    {
      // The layouts of points on the reference cell that are needed, each
      // computed once.
      template <int dim>
      class Layouts
      {
      public:
        explicit Layouts(const FillData<dim> &data)
          : data(data)
          , standard(make(data.n_points_per_direction))
        {
          for (const Region<dim> &region : data.regions)
            refined.push_back(make(region.n_points_per_direction));
        }



        const Quadrature<dim> &
        at(const Point<dim> &cell_center) const
        {
          for (unsigned int r = 0; r < refined.size(); ++r)
            if (data.regions[r].shape->contains(cell_center))
              return refined[r];
          return standard;
        }

      private:
        Quadrature<dim>
        make(const unsigned int n) const
        {
          AssertThrow(n > 0,
                      ExcInput("The number of points per cell and direction "
                               "must be positive."));
          if (data.layout == Layout::gauss)
            return QGauss<dim>(n);
          return QIterated<dim>(QMidpoint<1>(), n);
        }



        const FillData<dim>         &data;
        const Quadrature<dim>        standard;
        std::vector<Quadrature<dim>> refined;
      };



      // Call action(location, volume) for all points of a cell that are in the
      // body.
      template <int dim, typename Action>
      void
      for_each_point(
        const Shape<dim>                                        &shape,
        const BoundingBox<dim>                                  &shape_box,
        const Layouts<dim>                                      &layouts,
        const typename Triangulation<dim>::active_cell_iterator &cell,
        const Action                                            &action)
      {
        const Point<dim> &lower = cell->vertex(0);
        const Point<dim> &upper =
          cell->vertex(GeometryInfo<dim>::vertices_per_cell - 1);
        Point<dim> center;
        double     volume = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (upper[d] < shape_box.lower_bound(d) ||
                lower[d] > shape_box.upper_bound(d))
              return;
            center[d] = 0.5 * (lower[d] + upper[d]);
            volume *= upper[d] - lower[d];
          }

        const Quadrature<dim> &layout = layouts.at(center);
        for (unsigned int q = 0; q < layout.size(); ++q)
          {
            Point<dim> p;
            for (unsigned int d = 0; d < dim; ++d)
              p[d] = lower[d] + layout.point(q)[d] * (upper[d] - lower[d]);
            if (shape.contains(p))
              action(p, volume * layout.weight(q));
          }
      }
    } // namespace



    template <int dim>
    unsigned int
    count_points_in_cell(
      const Shape<dim>                                        &shape,
      const FillData<dim>                                     &data,
      const typename Triangulation<dim>::active_cell_iterator &cell)
    {
      unsigned int n = 0;
      for_each_point<dim>(shape,
                          shape.bounding_box(),
                          Layouts<dim>(data),
                          cell,
                          [&n](const Point<dim> &, const double) { ++n; });
      return n;
    }



    template <int dim>
    void
    fill(const Shape<dim>    &shape,
         const FillData<dim> &data,
         MaterialPoints<dim> &points)
    {
      const BoundingBox<dim> shape_box = shape.bounding_box();
      const Layouts<dim>     layouts(data);

      std::vector<typename MaterialPoints<dim>::Record> records;
      for (const auto &cell : points.triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          for_each_point<dim>(
            shape,
            shape_box,
            layouts,
            cell,
            [&](const Point<dim> &p, const double volume) {
              bool damageable = true;
              for (const auto &region : data.undamageable)
                damageable = damageable && !region->contains(p);
              records.push_back({p, cell, volume, damageable});
            });
      points.insert(records);
    }



    template <int dim>
    void
    insert_elements(const std::vector<BoundaryElement<dim>> &elements,
                    const std::vector<types::boundary_id>   &boundary_ids,
                    BoundaryPoints<dim>                     &points)
    {
      AssertDimension(elements.size(), boundary_ids.size());
      CellLocator<dim> &locator = points.locator();
      locator.update();
      const typename Triangulation<dim>::active_cell_iterator nowhere(
        points.triangulation().end());

      std::vector<typename BoundaryPoints<dim>::Record> records;
      std::vector<unsigned int>                         is_placed;
      for (unsigned int e = 0; e < elements.size(); ++e)
        {
          const BoundaryElement<dim> &element = elements[e];

          const auto cell = locator.find_owned(
            points.search_position(element.midpoint, -element.normal));
          if (cell != nowhere)
            records.push_back({element.midpoint,
                               cell,
                               element.area,
                               element.normal,
                               boundary_ids[e]});
          is_placed.push_back(cell != nowhere);
        }

      const MPI_Comm comm = get_mpi_communicator(points.triangulation());
      if (Utilities::MPI::sum(records.size(), comm) != elements.size())
        {
          Utilities::MPI::max(is_placed, comm, is_placed);
          const unsigned int first =
            std::find(is_placed.begin(), is_placed.end(), 0u) -
            is_placed.begin();
          Assert(first < elements.size(), ExcInternalError());
          std::ostringstream position;
          for (unsigned int d = 0; d < dim; ++d)
            position << (d > 0 ? ", " : "") << elements[first].midpoint[d];
          AssertThrow(false,
                      ExcPointOutsideGrid(position.str(),
                                          locator.describe_grid()));
        }
      points.insert(records);
    }



    template <int dim>
    void
    boundary(const Shape<dim>                     &shape,
             const std::vector<BoundarySelection> &selections,
             const double                          spacing,
             BoundaryPoints<dim>                  &points)
    {
      const std::vector<std::string> variables =
        (dim == 2 ? std::vector<std::string>{"x", "y", "nx", "ny"} :
                    std::vector<std::string>{"x", "y", "z", "nx", "ny", "nz"});
      std::vector<Expression> conditions;
      for (const BoundarySelection &selection : selections)
        conditions.emplace_back(selection.condition, variables);

      std::vector<BoundaryElement<dim>> selected;
      std::vector<types::boundary_id>   boundary_ids;
      std::vector<double>               values(2 * dim);
      for (const BoundaryElement<dim> &element :
           shape.boundary_elements(spacing))
        {
          for (unsigned int d = 0; d < dim; ++d)
            {
              values[d]       = element.midpoint[d];
              values[dim + d] = element.normal[d];
            }
          unsigned int s = 0;
          while (s < conditions.size() &&
                 conditions[s].value(make_array_view(values)) == 0)
            ++s;
          if (s == conditions.size())
            continue;
          selected.push_back(element);
          boundary_ids.push_back(selections[s].boundary_id);
        }
      insert_elements(selected, boundary_ids, points);
    }



    template unsigned int
    count_points_in_cell<2>(
      const Shape<2> &,
      const FillData<2> &,
      const typename Triangulation<2>::active_cell_iterator &);
    template unsigned int
    count_points_in_cell<3>(
      const Shape<3> &,
      const FillData<3> &,
      const typename Triangulation<3>::active_cell_iterator &);

    template void
    fill<2>(const Shape<2> &, const FillData<2> &, MaterialPoints<2> &);
    template void
    fill<3>(const Shape<3> &, const FillData<3> &, MaterialPoints<3> &);

    template void
    insert_elements<2>(const std::vector<BoundaryElement<2>> &,
                       const std::vector<types::boundary_id> &,
                       BoundaryPoints<2> &);
    template void
    insert_elements<3>(const std::vector<BoundaryElement<3>> &,
                       const std::vector<types::boundary_id> &,
                       BoundaryPoints<3> &);

    template void
    boundary<2>(const Shape<2> &,
                const std::vector<BoundarySelection> &,
                const double,
                BoundaryPoints<2> &);
    template void
    boundary<3>(const Shape<3> &,
                const std::vector<BoundarySelection> &,
                const double,
                BoundaryPoints<3> &);
  } // namespace PointGenerator
} // namespace EBSMPM
