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

#include <ebsmpm/splines/fe_bspline.h>

#include <ebsmpm/output/grid_writer.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/utilities.h>

#include <deal.II/grid/filtered_iterator.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace EBSMPM
{
  template <int dim>
  GridWriter<dim>::GridWriter(const unsigned int degree)
    : degree(degree)
  {
    const std::vector<Polynomials::Polynomial<double>> pieces =
      FE_BSpline<dim>::univariate_pieces(degree);
    const unsigned int n_1d = degree + 1;
    const unsigned int n    = Utilities::fixed_power<dim>(n_1d);

    // With as many subdivisions as the degree, there are as many corners as
    // functions, and both are in lexicographic order.
    shape_values.reinit(n, n);
    for (unsigned int corner = 0; corner < n; ++corner)
      for (unsigned int i = 0; i < n; ++i)
        {
          double value = 1;
          for (unsigned int d = 0, stride = 1; d < dim; ++d, stride *= n_1d)
            value *= pieces[i / stride % n_1d].value((corner / stride % n_1d) /
                                                     double(degree));
          shape_values(corner, i) = value;
        }
  }



  template <int dim>
  void
  GridWriter<dim>::add_scalar(const std::string  &name,
                              const Coefficients &coefficients)
  {
    fields.push_back({name, 1, coefficients});
  }



  template <int dim>
  void
  GridWriter<dim>::add_vector(const std::string  &name,
                              const Coefficients &coefficients)
  {
    fields.push_back({name, dim, coefficients});
  }



  template <int dim>
  Patches<dim>
  GridWriter<dim>::build_patches(const Triangulation<dim> &triangulation) const
  {
    Patches<dim> patches;
    for (const Field &field : fields)
      patches.declare(
        field.name,
        field.n_components == 1 ?
          DataComponentInterpretation::component_is_scalar :
          DataComponentInterpretation::component_is_part_of_vector);

    std::string                      problem;
    const unsigned int               n = shape_values.n_rows();
    std::vector<std::vector<double>> coefficients(fields.size());
    DataOutBase::Patch<dim>          patch;
    patch.n_subdivisions = degree;
    patch.reference_cell = ReferenceCells::get_hypercube<dim>();
    patch.data.reinit(patches.n_components(), n);
    patch.neighbors.fill(DataOutBase::Patch<dim>::no_neighbor);

    for (const auto &cell : triangulation.active_cell_iterators() |
                              IteratorFilters::LocallyOwnedCell())
      {
        unsigned int n_sides      = 1;
        bool         has_material = true;
        for (unsigned int f = 0; f < fields.size() && has_material; ++f)
          {
            coefficients[f].clear();
            fields[f].coefficients(cell, coefficients[f]);

            const unsigned int n_set = n * fields[f].n_components;
            Assert(coefficients[f].size() % n_set == 0,
                   ExcMessage("The number of coefficients of '" +
                              fields[f].name + "' is not a multiple of " +
                              std::to_string(n_set) + "."));
            n_sides =
              std::max<unsigned int>(n_sides, coefficients[f].size() / n_set);
            has_material = !coefficients[f].empty();

            for (const double c : coefficients[f])
              if (!Patches<dim>::is_finite(c) && problem.empty())
                {
                  std::ostringstream text;
                  text << "A coefficient of '" << fields[f].name << "' is " << c
                       << " in the cell at (" << cell->center() << ").";
                  problem = text.str();
                }
          }
        if (!has_material)
          continue;

        for (const unsigned int v : cell->vertex_indices())
          patch.vertices[v] = cell->vertex(v);

        for (unsigned int side = 0; side < n_sides; ++side)
          {
            unsigned int row = 0;
            for (unsigned int f = 0; f < fields.size(); ++f)
              {
                const unsigned int n_components = fields[f].n_components;
                const unsigned int n_set        = n * n_components;
                Assert(coefficients[f].size() == n_set ||
                         coefficients[f].size() == n_sides * n_set,
                       ExcMessage("The fields disagree about the number of "
                                  "sides of a cell."));
                const double *const set =
                  coefficients[f].data() +
                  (coefficients[f].size() == n_set ? 0 : side * n_set);

                for (unsigned int c = 0; c < n_components; ++c, ++row)
                  for (unsigned int corner = 0; corner < n; ++corner)
                    {
                      double value = 0;
                      for (unsigned int i = 0; i < n; ++i)
                        value +=
                          shape_values(corner, i) * set[i * n_components + c];
                      patch.data(row, corner) = value;
                    }
              }
            patches.add(patch);
          }
      }

    problem = first_message(problem, get_mpi_communicator(triangulation));
    AssertThrow(problem.empty(), ExcSolverFailure(problem));
    return patches;
  }



  template <int dim>
  void
  GridWriter<dim>::write(const Triangulation<dim> &triangulation,
                         VTUSeries                &series,
                         const unsigned int        step,
                         const double              time) const
  {
    Patches<dim> patches = build_patches(triangulation);
    series.write(patches, step, time);
  }
} // namespace EBSMPM



template class EBSMPM::GridWriter<2>;
template class EBSMPM::GridWriter<3>;
