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

#include <ebsmpm/materials/elastic_constants.h>
#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/notch.h>
#include <ebsmpm/particles/shape_parser.h>

#include <ebsmpm/solvers/simulation.h>

#include <ebsmpm/output/grid_writer.h>
#include <ebsmpm/output/point_writer.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace EBSMPM
{
  namespace internal
  {
    namespace SimulationImplementation
    {
      /** Part of a cell that lips may overlap by without a warning. */
      constexpr double noteworthy_overlap = 0.01;



      /** The constants that formulas of shapes may contain. */
      std::map<std::string, double>
      constants(const Parameters &parameters)
      {
        return {{"h", parameters.cell_size()},
                {"l", parameters.length_scale()}};
      }



      template <int dim>
      PointGenerator::FillData<dim>
      fill_data(const Parameters &parameters)
      {
        PointGenerator::FillData<dim> data;
        data.n_points_per_direction = parameters.body.n_points;
        data.layout                 = parameters.body.layout == "Gauss" ?
                                        PointGenerator::Layout::gauss :
                                        PointGenerator::Layout::midpoint;
        for (const auto &entry :
             Utilities::split_string_list(parameters.body.regions, ';'))
          {
            const auto colon = entry.find(':');
            AssertThrow(colon != std::string::npos,
                        ExcParameter("Body/Regions",
                                     parameters.body.regions,
                                     "a list of 'number: shape', separated by "
                                     "semicolons"));
            const double n =
              parameters.number("Body/Regions", entry.substr(0, colon));
            AssertThrow(n >= 1. && n == std::floor(n),
                        ExcParameter("Body/Regions",
                                     parameters.body.regions,
                                     "made of positive numbers of points and "
                                     "shapes"));
            data.regions.push_back(
              {parse_shape<dim>(entry.substr(colon + 1), constants(parameters)),
               static_cast<unsigned int>(n)});
          }
        for (const auto &entry :
             Utilities::split_string_list(parameters.body.undamageable, ';'))
          data.undamageable.push_back(
            parse_shape<dim>(entry, constants(parameters)));
        return data;
      }
    } // namespace SimulationImplementation
  }   // namespace internal

  using namespace internal::SimulationImplementation;



  template <int dim>
  Simulation<dim>::Simulation(const Parameters &parameters,
                              const MPI_Comm    communicator,
                              const Overwrite   overwrite,
                              std::ostream     *screen)
    : parameters(parameters)
    , communicator(communicator)
    , overwrite(overwrite)
    , triangulation(communicator)
    , body(parse_shape<dim>(parameters.body.shape, constants(parameters)))
    , points(triangulation, mapping)
    , boundary_points(triangulation, mapping)
    , material(make_material<dim>(
        parameters.material.model,
        energy_split_from_name(parameters.material.split),
        ElasticConstants::bulk_modulus(parameters.material.young_modulus,
                                       parameters.material.poisson_ratio),
        ElasticConstants::shear_modulus(parameters.material.young_modulus,
                                        parameters.material.poisson_ratio)))
    , degradation(parameters.damage.residual_stiffness)
    , conditions(parameters.loading.conditions, parameters.boundary_names())
    , tractions(parameters.loading.tractions,
                parameters.boundary_names(),
                conditions.formulas())
    , checkpoints(parameters.output.directory + "/checkpoint", communicator)
    , pcout(screen != nullptr ? *screen : std::cout,
            screen != nullptr &&
              Utilities::MPI::this_mpi_process(communicator) == 0)
    // Without a communicator: sections are entered thousands of times, and with
    // one, all processes would wait for each other every time.
    , timer(pcout, TimerOutput::never, TimerOutput::wall_times)
  {
    penalty = parameters.nitsche.penalty > 0. ?
                parameters.nitsche.penalty :
                parameters.nitsche.penalty_factor *
                  material->nitsche_stiffness() / parameters.cell_size();
  }



  template <int dim>
  unsigned int
  Simulation<dim>::make_coarse_grid()
  {
    const double     h = parameters.cell_size();
    const Point<dim> lower =
      parameters.point<dim>("Background grid/Lower corner",
                            parameters.grid.lower_corner);
    const Point<dim> upper =
      parameters.point<dim>("Background grid/Upper corner",
                            parameters.grid.upper_corner);

    // Every process knows all coarse cells, so have few of these: as many
    // levels of refinement as leave a handful per direction. The grid becomes a
    // little larger than asked for; empty cells cost nothing.
    std::array<unsigned int, dim> n_cells;
    unsigned int                  smallest = numbers::invalid_unsigned_int;
    for (unsigned int d = 0; d < dim; ++d)
      {
        n_cells[d] = static_cast<unsigned int>(
          std::max(1., std::ceil((upper[d] - lower[d]) / h - 1e-6)));
        smallest = std::min(smallest, n_cells[d]);
      }
    unsigned int level = 0;
    while ((smallest >> (level + 1)) >= 4)
      ++level;

    std::vector<unsigned int> n_coarse(dim);
    Point<dim>                end = lower;
    for (unsigned int d = 0; d < dim; ++d)
      {
        n_coarse[d] = (n_cells[d] + (1U << level) - 1) >> level;
        end[d] += h * (n_coarse[d] << level);
      }
    GridGenerator::subdivided_hyper_rectangle(triangulation,
                                              n_coarse,
                                              lower,
                                              end);
    return level;
  }



  template <int dim>
  void
  Simulation<dim>::make_grid()
  {
    triangulation.refine_global(make_coarse_grid());
    if (parameters.grid.balance)
      {
        const auto data = fill_data<dim>(parameters);
        repartition_by_weight(
          triangulation,
          [&](const typename Triangulation<dim>::cell_iterator &cell) {
            return PointGenerator::count_points_in_cell<dim>(*body, data, cell);
          });
      }
  }



  template <int dim>
  void
  Simulation<dim>::make_points()
  {
    PointGenerator::fill<dim>(*body, fill_data<dim>(parameters), points);
    AssertThrow(points.n_global() > 0,
                ExcParameter("Body/Shape",
                             parameters.body.shape,
                             "a body of which some part is in the grid"));

    std::vector<PointGenerator::BoundarySelection> selections;
    for (const auto &boundary : parameters.boundaries())
      selections.push_back(
        {static_cast<types::boundary_id>(selections.size()), boundary.second});
    PointGenerator::boundary<dim>(
      *body,
      selections,
      parameters.number("Body/Boundary point spacing", parameters.body.spacing),
      boundary_points);
  }



  template <int dim>
  void
  Simulation<dim>::make_notch()
  {
    const auto &notch = parameters.notch;
    if (notch.type == "slit")
      {
        Notch::Slit<dim> slit;
        slit.point =
          parameters.point<dim>("Notch/Plane point", notch.plane_point);
        slit.normal =
          parameters.point<dim>("Notch/Plane normal", notch.plane_normal);
        AssertThrow(slit.normal.norm() > 0.,
                    ExcParameter("Notch/Plane normal",
                                 notch.plane_normal,
                                 "a vector that is not zero"));
        slit.open_region =
          parse_shape<dim>(notch.region, constants(parameters));
        slit.label_width =
          parameters.number("Notch/Label width", notch.label_width);
        slit.label_reach =
          parameters.number("Notch/Label reach", notch.label_reach);
        slit.damage_width =
          parameters.number("Notch/Damage width", notch.damage_width);
        slit.tip_margin =
          parameters.number("Notch/Tip margin", notch.tip_margin);
        if (parameters.has_faces())
          {
            const types::boundary_id lower_id = parameters.boundaries().size();
            Notch::add_faces<dim>(
              slit,
              body,
              parameters.number("Body/Boundary point spacing",
                                parameters.body.spacing),
              lower_id,
              lower_id + 1,
              boundary_points);
          }
        Notch::label_slit<dim>(slit, points, boundary_points);
      }
    else if (notch.type == "damage")
      Notch::initial_history<dim>(*parse_shape<dim>(notch.region,
                                                    constants(parameters)),
                                  notch.history_factor *
                                    parameters.damage.fracture_energy /
                                    (2. * parameters.length_scale()),
                                  points);
  }



  template <int dim>
  void
  Simulation<dim>::make_step()
  {
    step =
      std::make_unique<StaggeredStep<dim>>(points,
                                           boundary_points,
                                           *material,
                                           degradation,
                                           parameters.damage.fracture_energy,
                                           parameters.length_scale(),
                                           penalty,
                                           parameters.step_data<dim>(),
                                           &timer);
    std::vector<types::boundary_id> faces;
    for (unsigned int id = parameters.boundaries().size();
         id < parameters.boundary_names().size();
         ++id)
      faces.push_back(id);
    step->set_tractions(tractions, faces);
  }



  template <int dim>
  void
  Simulation<dim>::set_up()
  {
    TimerOutput::Scope scope(timer, "set-up");
    if (parameters.checkpoint.resume)
      read_checkpoint();
    else
      {
        make_grid();
        make_points();
        make_notch();
        make_step();
      }
    last_imbalance = imbalance();
  }



  template <int dim>
  void
  Simulation<dim>::write_step(const unsigned int                         n_step,
                              const double                               load,
                              const typename StaggeredStep<dim>::Report &report)
  {
    const auto  &reactions = step->reactions();
    const auto   energies  = step->energies();
    const double area      = step->crack_area();
    const auto  &space     = step->displacement_space();
    const auto   driven    = parameters.driven();

    std::vector<double> values;
    for (unsigned int id = 0; id < parameters.boundary_names().size(); ++id)
      {
        const auto found = reactions.find(id);
        for (unsigned int d = 0; d < dim; ++d)
          values.push_back(found == reactions.end() ? 0. : found->second[d]);
      }
    progress.last_force = driven.first == numbers::invalid_unsigned_int ?
                            report.conjugate_force :
                            values[dim * driven.first + driven.second];
    progress.peak_force =
      std::max(progress.peak_force, std::abs(progress.last_force));
    for (const double value : {energies.elastic,
                               area * parameters.damage.fracture_energy,
                               energies.penalty,
                               area,
                               1. * report.passes,
                               1. * report.newton_iterations,
                               1. * report.linear_iterations,
                               1. * report.refreshes,
                               1. * report.bisections,
                               report.damage_change,
                               report.residual,
                               1. * space.n_independent(),
                               1. * space.n_deficient(),
                               1. * space.n_twins(),
                               step->extension_report().max_lebesgue,
                               1. * report.n_pieces,
                               1. * report.n_free_pieces,
                               report.opening.smallest,
                               report.conjugate_force,
                               report.opened_volume,
                               progress.wall_time + wall_clock.wall_time()})
      values.push_back(value);
    history->write(n_step, load, progress.last_force, values);

    std::ostringstream text;
    text << "step " << std::setw(5) << n_step << "  load " << std::setw(11)
         << load << "  force " << std::setw(13) << progress.last_force
         << "  passes " << std::setw(3) << report.passes << "  newton "
         << std::setw(3) << report.newton_iterations << "  linear "
         << std::setw(4) << report.linear_iterations << "  new " << std::setw(2)
         << report.refreshes << "  twins " << std::setw(5) << space.n_twins()
         << (report.indefinite ? "  (indefinite tangent)" : "")
         << (report.smoothed ? "  (branches held)" : "");
    if (report.n_pieces > 1)
      text << "  (" << report.n_pieces << " pieces, " << report.n_free_pieces
           << " free)";
    if (report.n_junctions > 0)
      text << "  (" << report.n_junctions << " functions at a junction)";
    if (report.opening.smallest < -noteworthy_overlap * parameters.cell_size())
      text << "  (lips overlap by " << -report.opening.smallest << ")";
    text << '\n';
    print(text.str());
  }



  template <int dim>
  void
  Simulation<dim>::write_fields(const unsigned int n_step, const double load)
  {
    TimerOutput::Scope scope(timer, "output");

    PointWriter<dim> point_writer;
    using Particle  = typename PointWriter<dim>::Particle;
    const auto view = [](Particle &particle) {
      return MaterialPoint<dim>(particle.get_properties());
    };
    point_writer.add_vector("displacement", [view](Particle &p) {
      return view(p).displacement();
    });
    point_writer.add_scalar("damage",
                            [view](Particle &p) { return view(p).damage(); });
    point_writer.add_scalar("history",
                            [view](Particle &p) { return view(p).history(); });
    point_writer.add_vector("side",
                            [view](Particle &p) { return view(p).side(); });
    point_writer.add_scalar("J", [view](Particle &p) {
      return determinant(view(p).deformation_gradient());
    });
    point_writer.add_scalar("volume", [view](Particle &p) {
      return view(p).reference_volume();
    });
    point_writer.write(points.handler(), *point_series, n_step, load);

    // On the grid, there are the increment and the damage of the step, as the
    // points do not yet know them.
    GridWriter<dim> grid_writer(parameters.grid.degree);
    using Cell = typename GridWriter<dim>::CellIterator;
    grid_writer.add_scalar("damage",
                           [&](const Cell &cell, std::vector<double> &c) {
                             step->cell_damage(cell, c);
                           });
    grid_writer.write(triangulation, *grid_series, n_step, load);
  }



  template <int dim>
  const MaterialPoints<dim> &
  Simulation<dim>::material_points() const
  {
    return points;
  }



  template <int dim>
  double
  Simulation<dim>::driven_force() const
  {
    return progress.last_force;
  }



  template <int dim>
  std::pair<double, double>
  Simulation<dim>::table_entry(const double load) const
  {
    const auto table = parameters.increments();
    for (const auto &entry : table)
      if (load < entry.first * (1. - 1e-12))
        return {entry.second, entry.first};
    return {0., table.back().first};
  }



  template <int dim>
  bool
  Simulation<dim>::is_broken() const
  {
    return parameters.loading.stop_below > 0. &&
           std::abs(progress.last_force) <
             parameters.loading.stop_below * progress.peak_force;
  }



  template <int dim>
  bool
  Simulation<dim>::advance(const double increment)
  {
    const unsigned int n_step  = progress.step + 1;
    const double       load    = progress.load + increment;
    const double       minimum = parameters.loading.minimum_increment;
    AssertThrow(increment >= minimum,
                ExcStepFailure(n_step, increment, failure));

    typename StaggeredStep<dim>::Report report;
    try
      {
        report = step->solve(conditions,
                             load,
                             progress.last_increment > 0. ?
                               increment / progress.last_increment :
                               0.);
      }
    catch (const ExcSolverFailure &exception)
      {
        std::ostringstream message;
        exception.print_info(message);
        failure          = Utilities::trim(message.str());
        progress.allowed = 0.5 * increment;

        std::ostringstream text;
        text << "step " << std::setw(5) << n_step << "  load " << std::setw(11)
             << load << "  failed: " << failure << " Trying increment "
             << progress.allowed << ".\n";
        print(text.str());
        AssertThrow(progress.allowed >= minimum,
                    ExcStepFailure(n_step, increment, failure));
        return false;
      }

    progress.step           = n_step;
    progress.load           = load;
    progress.last_increment = increment;
    write_step(n_step, load, report);
    step->accept();
    balance(n_step);
    signals.step_done(n_step, load, report);
    if (report.passes <= parameters.loading.easy_passes &&
        progress.allowed < std::numeric_limits<double>::max())
      progress.allowed = 2. * progress.allowed;
    return true;
  }



  template <int dim>
  void
  Simulation<dim>::run()
  {
    // A new run does not begin if it must not write; one that is continued does
    // not write before it is known that it can be.
    if (!parameters.checkpoint.resume)
      open_files();
    set_up();
    if (parameters.checkpoint.resume)
      reopen_files();
    write_header();

    unsigned int last_fields     = progress.step;
    unsigned int last_checkpoint = progress.step;
    const auto   write_results   = [&](const bool at_end) {
      const auto is_due = [&](const unsigned int interval,
                              const unsigned int last_step) {
        return interval > 0 && progress.step != last_step &&
               (at_end || progress.step % interval == 0);
      };
      if (is_due(parameters.output.interval, last_fields))
        {
          write_fields(progress.step, progress.load);
          last_fields = progress.step;
        }
      if (is_due(parameters.checkpoint.interval, last_checkpoint))
        {
          write_checkpoint();
          last_checkpoint = progress.step;
        }
    };
    for (auto entry = table_entry(progress.load);
         entry.first > 0. && !is_broken();
         entry = table_entry(progress.load))
      {
        // Up to the end of the interval, without a sliver before it.
        double increment = std::min(entry.first, progress.allowed);
        if (progress.load + increment > entry.second - 1e-6 * increment)
          increment = entry.second - progress.load;
        if (advance(increment))
          write_results(false);
      }
    write_results(true);

    timer.print_summary();
    if (log_file)
      log_file << "finished after " << wall_clock.wall_time() << " s\n";
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace EBSMPM
