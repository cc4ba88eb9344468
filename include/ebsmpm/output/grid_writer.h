// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_grid_writer_h
#define ebsmpm_output_grid_writer_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/output/patches.h>
#include <ebsmpm/output/vtu_series.h>

#include <deal.II/base/table.h>

#include <deal.II/grid/tria.h>

#include <functional>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * Writer of spline fields on the background grid, for graphics programs.
   *
   * A field is a name and a function that returns the coefficients of the
   * $(p+1)^\text{dim}$ B-splines that do not vanish on a cell, in the order of
   * the shape functions of FE_BSpline. A cell without material has no
   * coefficients, and is left out. PointWriter is the same for points.
   *
   * @code
   * GridWriter<dim> writer(degree);
   * writer.add_scalar("damage", [&](const auto &cell, auto &coefficients) {
   *   if (has_material(cell))
   *     for (unsigned int i = 0; i < n_functions_per_cell; ++i)
   *       coefficients.push_back(...);
   * });
   * VTUSeries series(directory, "grid", communicator, Overwrite::no);
   * writer.write(triangulation, series, step, time);
   * @endcode
   *
   * Where a crack runs through a cell, each side has coefficients of its own:
   * a function may return several sets, one behind the other, and the cell is
   * written once for each. Fields with only one set take it for all sides.
   *
   * Each cell is divided into $p^\text{dim}$ subcells on which graphics
   * programs interpolate linearly. The values are the tensor-product
   * polynomials themselves, so neither a DoFHandler on the whole background
   * grid nor FEValues is needed, and empty cells cost nothing; fields that live
   * on a DoFHandler anyway are better written by DataOut. Cells must be
   * parallelepipeds, as all cells of a Cartesian grid are.
   *
   * A coefficient that is not finite is never written: all ranks throw
   * ExcSolverFailure that names the field and the cell.
   */
  template <int dim>
  class GridWriter
  {
  public:
    using CellIterator = typename Triangulation<dim>::active_cell_iterator;

    /**
     * The type of functions that fill the coefficients on a cell. The vector is
     * empty when the function is called, and stays so on cells without
     * material.
     */
    using Coefficients =
      std::function<void(const CellIterator &, std::vector<double> &)>;

    /**
     * Constructor for B-splines of degree @p degree.
     */
    explicit GridWriter(const unsigned int degree);

    /**
     * Add a scalar field.
     */
    void
    add_scalar(const std::string &name, const Coefficients &coefficients);

    /**
     * Add a vector field. The coefficients are ordered as the unknowns are:
     * component $c$ of function $i$ is number $i\,\text{dim}+c$.
     */
    void
    add_vector(const std::string &name, const Coefficients &coefficients);

    /**
     * Return the patches of all locally owned cells on which every field has
     * coefficients. Collective. Throws ExcSolverFailure for a coefficient that
     * is not finite.
     */
    Patches<dim>
    build_patches(const Triangulation<dim> &triangulation) const;

    /**
     * Write the fields as the contents of @p step of @p series. Collective.
     */
    void
    write(const Triangulation<dim> &triangulation,
          VTUSeries                &series,
          const unsigned int        step,
          const double              time) const;

  private:
    struct Field
    {
      std::string  name;
      unsigned int n_components;
      Coefficients coefficients;
    };

    const unsigned int degree;

    /**
     * The B-splines at the corners of the subcells:
     * <code>shape_values[corner][function]</code>.
     */
    Table<2, double> shape_values;

    std::vector<Field> fields;
  };
} // namespace EBSMPM

#endif
