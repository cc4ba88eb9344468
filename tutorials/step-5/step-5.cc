/* -----------------------------------------------------------------------------
 *
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * Copyright (C) 2026 by the ebsmpm authors
 *
 * This file is part of the ebsmpm library.
 *
 * -----------------------------------------------------------------------------
 */

// A square sheet of one millimetre has a notch from its left edge to its
// centre. Its lower edge is held, its upper edge is pulled upwards, and at some
// load a crack runs from the notch to the right edge. In a phase-field model,
// this crack is a band of broken material, a few cells wide, which still
// transmits a small force however far the halves are moved apart. Here, it
// turns into a real one: the two sides of the ridge of the damage read
// different coefficients of the same B-splines, the halves separate, and the
// force is zero to the last digit that matters.
//
// The program is the first benchmark of Sugai et al. (section 4.(1)). It puts
// together, by hand, what the program <code>ebsmpm</code> does for any
// parameter file, so that you can do the same in a program of your own. Call it
// with one of the two parameter files next to it,
// @code
//   step-5 coarse.prm       # some seconds
//   step-5 step-5.prm       # the resolution of the paper, several minutes
// @endcode
// See README.md for the equations and the results.

// @sect3{Include files}

// From the library, we need points and what creates them, a material, the
// conditions on the boundary, and the load step that brings all of it together:
#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/degradation.h>
#include <ebsmpm/materials/elastic_constants.h>
#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/particles/boundary_points.h>
#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/material_points.h>
#include <ebsmpm/particles/notch.h>
#include <ebsmpm/particles/shape_parser.h>

#include <ebsmpm/solvers/dirichlet_conditions.h>
#include <ebsmpm/solvers/parameters.h>
#include <ebsmpm/solvers/staggered_step.h>

#include <ebsmpm/output/files.h>
#include <ebsmpm/output/history.h>
#include <ebsmpm/output/point_fields.h>
#include <ebsmpm/output/vtu_series.h>

// From deal.II, there is little left to ask for: a distributed grid, and the
// parameters.
#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <iostream>
#include <memory>

namespace Step5
{
  using namespace EBSMPM;

  // @sect3{The TensionTest class}

  // The functions are in the order in which run() calls them. There is no
  // system matrix and no solution vector among the members: all history lives
  // on the points, and what lives on the grid is made anew in each load step,
  // inside of StaggeredStep.
  template <int dim>
  class TensionTest
  {
  public:
    TensionTest(const Parameters &parameters);

    void
    run();

  private:
    void
    make_grid();
    void
    make_points();
    void
    make_notch();
    void
    make_step();
    double
    load_increment(const double load) const;
    void
    output(const unsigned int                         n,
           const double                               load,
           const typename StaggeredStep<dim>::Report &report);

    const Parameters &parameters;
    const MPI_Comm    communicator;

    parallel::distributed::Triangulation<dim> triangulation;
    const MappingCartesian<dim>               mapping;
    std::unique_ptr<MaterialPoints<dim>>      points;
    std::unique_ptr<BoundaryPoints<dim>>      boundary_points;

    std::unique_ptr<Material<dim>>            material;
    const Degradation                         degradation;
    std::unique_ptr<DirichletConditions<dim>> conditions;
    std::unique_ptr<StaggeredStep<dim>>       step;

    std::unique_ptr<HistoryWriter> history;
    std::unique_ptr<VTUSeries>     series;
    ConditionalOStream             pcout;
  };



  template <int dim>
  TensionTest<dim>::TensionTest(const Parameters &parameters)
    : parameters(parameters)
    , communicator(MPI_COMM_WORLD)
    , triangulation(communicator)
    , degradation(parameters.damage.residual_stiffness)
    , pcout(std::cout, Utilities::MPI::this_mpi_process(communicator) == 0)
  {}



  // @sect4{TensionTest::make_grid()}

  // The background grid has nothing to do with the specimen: it is a lattice
  // of equal boxes that must be large enough for the specimen to stay inside
  // while it moves. B-splines reach over several cells; the lattice position
  // of a cell is all that their numbering needs. We refine a coarse grid of few
  // cells, because each process knows all of these; the upper corner moves
  // outwards until the number of cells fits.
  template <int dim>
  void
  TensionTest<dim>::make_grid()
  {
    constexpr unsigned int n_refinements = 3;

    const double     h = parameters.cell_size();
    const Point<dim> lower =
      parameters.point<dim>("Background grid/Lower corner",
                            parameters.grid.lower_corner);
    Point<dim> upper = parameters.point<dim>("Background grid/Upper corner",
                                             parameters.grid.upper_corner);

    const double              coarse_h = h * (1U << n_refinements);
    std::vector<unsigned int> repetitions(dim);
    for (unsigned int d = 0; d < dim; ++d)
      {
        repetitions[d] = static_cast<unsigned int>(
          std::ceil((upper[d] - lower[d]) / coarse_h - 1e-6));
        upper[d] = lower[d] + repetitions[d] * coarse_h;
      }
    GridGenerator::subdivided_hyper_rectangle(triangulation,
                                              repetitions,
                                              lower,
                                              upper);
    triangulation.refine_global(n_refinements);
  }



  // @sect4{TensionTest::make_points()}

  // The specimen is described by a formula, and filled with points cell by
  // cell. Its boundary gets points as well, where something is prescribed: they
  // carry an area and a normal, and Nitsche's method is a sum over them.
  template <int dim>
  void
  TensionTest<dim>::make_points()
  {
    points = std::make_unique<MaterialPoints<dim>>(triangulation, mapping);
    boundary_points =
      std::make_unique<BoundaryPoints<dim>>(triangulation, mapping);

    const auto body = parse_shape<dim>(parameters.body.shape,
                                       {{"h", parameters.cell_size()},
                                        {"l", parameters.length_scale()}});

    PointGenerator::FillData<dim> data;
    data.n_points_per_direction = parameters.body.n_points;
    data.layout                 = parameters.body.layout == "Gauss" ?
                                    PointGenerator::Layout::gauss :
                                    PointGenerator::Layout::midpoint;
    AssertThrow(parameters.body.regions.empty() &&
                  parameters.body.undamageable.empty(),
                ExcInput("This program has the same number of points in all "
                         "cells, and all of them can be damaged: leave "
                         "'Body/Regions' and 'Body/Undamageable' empty, or use "
                         "the program ebsmpm."));
    PointGenerator::fill<dim>(*body, data, *points);

    std::vector<PointGenerator::BoundarySelection> selections;
    std::vector<std::string>                       names;
    for (const auto &boundary : parameters.boundaries())
      {
        selections.push_back(
          {static_cast<types::boundary_id>(names.size()), boundary.second});
        names.push_back(boundary.first);
      }
    PointGenerator::boundary<dim>(
      *body,
      selections,
      parameters.number("Body/Boundary point spacing", parameters.body.spacing),
      *boundary_points);
    conditions =
      std::make_unique<DirichletConditions<dim>>(parameters.loading.conditions,
                                                 names);
  }



  // @sect4{TensionTest::make_notch()}

  // In step-5.prm, the notch is a gap in the body, and there is nothing to do.
  // In coarse.prm, it is a slit: the points next to it know from the start on
  // which side they are, which is what points next to a growing crack find
  // out. Or there is a band of material that is damaged from the start: its
  // history field is a thousand times what breaks the material.
  template <int dim>
  void
  TensionTest<dim>::make_notch()
  {
    const auto &notch = parameters.notch;
    if (notch.type == "none")
      return;

    const auto region = parse_shape<dim>(notch.region,
                                         {{"h", parameters.cell_size()},
                                          {"l", parameters.length_scale()}});
    if (notch.type == "damage")
      {
        Notch::initial_history<dim>(*region,
                                    notch.history_factor *
                                      parameters.damage.fracture_energy /
                                      (2. * parameters.length_scale()),
                                    *points);
        return;
      }

    Notch::Slit<dim> slit;
    slit.point = parameters.point<dim>("Notch/Plane point", notch.plane_point);
    slit.normal =
      parameters.point<dim>("Notch/Plane normal", notch.plane_normal);
    slit.open_region = region;
    slit.label_width =
      parameters.number("Notch/Label width", notch.label_width);
    slit.damage_width =
      parameters.number("Notch/Damage width", notch.damage_width);
    Notch::label_slit<dim>(slit, *points, *boundary_points);
  }



  // @sect4{TensionTest::make_step()}

  // A load step needs the points, the material and the penalty of Nitsche's
  // method, whose natural unit is the stiffness of uniaxial strain over the
  // cell size.
  template <int dim>
  void
  TensionTest<dim>::make_step()
  {
    const double E  = parameters.material.young_modulus;
    const double nu = parameters.material.poisson_ratio;
    material =
      make_material<dim>(parameters.material.model,
                         energy_split_from_name(parameters.material.split),
                         ElasticConstants::bulk_modulus(E, nu),
                         ElasticConstants::shear_modulus(E, nu));
    const double penalty = parameters.nitsche.penalty > 0. ?
                             parameters.nitsche.penalty :
                             parameters.nitsche.penalty_factor *
                               material->nitsche_stiffness() /
                               parameters.cell_size();
    step =
      std::make_unique<StaggeredStep<dim>>(*points,
                                           *boundary_points,
                                           *material,
                                           degradation,
                                           parameters.damage.fracture_energy,
                                           parameters.length_scale(),
                                           penalty,
                                           parameters.step_data<dim>());
  }



  // @sect4{TensionTest::load_increment()}

  // The table of increments says how far to go next; we stop exactly at its
  // entries. Zero means that the end is reached.
  template <int dim>
  double
  TensionTest<dim>::load_increment(const double load) const
  {
    for (const auto &entry : parameters.increments())
      if (load < entry.first * (1. - 1e-12))
        return (load + entry.second > entry.first - 1e-6 * entry.second) ?
                 entry.first - load :
                 entry.second;
    return 0.;
  }



  // @sect4{TensionTest::output()}

  // A line per step, of the force and of the number of functions: while the
  // crack opens, twins appear, but no unknowns.
  template <int dim>
  void
  TensionTest<dim>::output(const unsigned int                         n,
                           const double                               load,
                           const typename StaggeredStep<dim>::Report &report)
  {
    const auto   driven = parameters.driven();
    const double force  = step->reactions().at(driven.first)[driven.second];
    const auto  &space  = step->displacement_space();
    history->write(n,
                   load,
                   force,
                   {1. * report.passes,
                    1. * space.n_independent(),
                    1. * space.n_twins(),
                    step->crack_area()});
    pcout << "step " << n << ", load " << load << ", force " << force
          << ", passes " << report.passes << ", unknown functions "
          << space.n_independent() << ", twins " << space.n_twins()
          << std::endl;
  }



  // @sect4{TensionTest::run()}

  // Load steps until the end of the table. A step that fails has not touched
  // the points, so that there is nothing to restore: we try again with half of
  // the increment.
  template <int dim>
  void
  TensionTest<dim>::run()
  {
    make_directory(parameters.output.directory, communicator);
    history = std::make_unique<HistoryWriter>(
      parameters.output.directory + "/history.csv",
      std::vector<std::string>{
        "passes", "independent_functions", "twin_functions", "crack_length"},
      communicator,
      Overwrite::yes);
    series = std::make_unique<VTUSeries>(parameters.output.directory,
                                         "points",
                                         communicator,
                                         Overwrite::yes);
    make_grid();
    make_points();
    make_notch();
    make_step();
    pcout << points->n_global() << " material points, "
          << boundary_points->n_global() << " boundary points" << std::endl;

    const auto writer = make_material_point_writer<dim>();

    unsigned int n        = 0;
    double       load     = 0.;
    double       previous = 0.;
    double       factor   = 1.;
    for (double full = load_increment(load); full > 0.;
         full        = load_increment(load))
      {
               const double increment = factor * full;
               try
          {
                   const auto report =
                     step->solve(*conditions,
                          load + increment,
                          previous > 0. ? increment / previous : 0.);
                   output(n + 1, load + increment, report);
                   ++n;
                   load += increment;
                   previous = increment;
          }
               catch (const ExcSolverFailure &)
          {
                   AssertThrow(increment >= parameters.loading.minimum_increment,
                        ExcStepFailure(n + 1,
                                       increment,
                                       "the increment became too small."));
                   factor *= 0.5;
                   continue;
          }
        step->accept();
               factor = std::min(1., 2. * factor);
               if (parameters.output.interval > 0 &&
            n % parameters.output.interval == 0)
          writer.write(points->handler(), *series, n, load);
      }
  }
} // namespace Step5



// @sect3{The main() function}

// As in all programs that use MPI; the parameters are those of the program
// <code>ebsmpm</code>.
int
main(int argc, char *argv[])
{
  using namespace EBSMPM;
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try
    {
      AssertThrow(argc <= 2,
                  ExcInput("The only argument is a file of parameters, here "
                           "there are " +
                           std::to_string(argc - 1) + " arguments."));
      Parameters parameters;
      ParameterAcceptor::initialize(argc > 1 ? argv[1] : "coarse.prm");
      parameters.check();
      AssertThrow(parameters.grid.dimension == 2,
                  ExcParameter("Background grid/Dimension", "3", "2"));
      Step5::TensionTest<2>(parameters).run();
    }
  catch (const std::exception &exception)
    {
      std::cerr << exception.what() << std::endl;
      return 1;
    }
  return 0;
}
