// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// A load step on a body under uniaxial strain, where everything is known: the
// reactions and energies of an elastic step, the damage of an iterated one,
// the balance of work and energy, and a step that fails without leaving a
// trace.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/solvers/staggered_step.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include <memory>

#include "../tests.h"

#include "../assembly/bodies.h"
#include "../splines/verdict.h"



const std::vector<std::string> boundaries = {"left", "right", "bottom", "top"};
const std::string              uniaxial =
  "bottom.x = 0; bottom.y = 0; top.x = 0; top.y = u; left.x = 0; right.x = 0";
constexpr double Gc = 2.7e-3, l = 0.015, k_residual = 1e-4;



/** The unit square, whole cells of the grid, with Gauss points. */
struct Specimen
{
  Specimen()
    : triangulation(MPI_COMM_WORLD)
  {
    const double h = 0.25;
    GridGenerator::subdivided_hyper_cube(triangulation, 8, -2 * h, 6 * h);
    points = std::make_unique<MaterialPoints<2>>(triangulation, mapping);
    boundary_points =
      std::make_unique<BoundaryPoints<2>>(triangulation, mapping);

    const BoxBody<2> box(Point<2>(0., 0.), Point<2>(1., 1.));
    std::vector<MaterialPoints<2>::Record> records;
    std::vector<BoundaryPoints<2>::Record> boundary_records;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const Point<2> a = cell->vertex(0), b = cell->vertex(3);
          for (const auto &p : box.interior(a, b, 3))
            {
              MaterialPoints<2>::Record record;
              record.location = p.x;
              record.cell     = cell;
              record.volume   = p.volume;
              records.push_back(record);
            }
          for (const auto &p : box.boundary(a, b, 3))
            {
              BoundaryPoints<2>::Record record;
              record.location    = p.x;
              record.cell        = cell;
              record.area        = p.area;
              record.normal      = p.normal;
              record.boundary_id = p.id;
              boundary_records.push_back(record);
            }
        }
    points->insert(records);
    boundary_points->insert(boundary_records);
  }

  /** All properties and positions of all points. */
  std::vector<double>
  everything() const
  {
    std::vector<double> result;
    const auto          add = [&](const auto &handler) {
      for (const auto &particle : handler)
        {
          for (unsigned int d = 0; d < 2; ++d)
            result.push_back(particle.get_location()[d]);
          for (const double x : particle.get_properties())
            result.push_back(x);
        }
    };
    add(points->handler());
    add(boundary_points->handler());
    return result;
  }

  parallel::distributed::Triangulation<2> triangulation;
  MappingCartesian<2>                     mapping;
  std::unique_ptr<MaterialPoints<2>>      points;
  std::unique_ptr<BoundaryPoints<2>>      boundary_points;
};



/** Is the relative error small? */
std::string
close_to(const double value, const double expected, const double tolerance)
{
  return verdict(std::abs(value - expected) /
                   std::max(std::abs(expected), 1e-300),
                 tolerance);
}



Tensor<2, 2>
stretch(const double u)
{
  Tensor<2, 2> F = unit_symmetric_tensor<2>();
  F[1][1] += u;
  return F;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  const auto                   material = make_material<2>("neo-Hookean",
                                         EnergySplit::volumetric_deviatoric,
                                         175.,
                                         80.77);
  const Degradation            degradation(k_residual);
  const DirichletConditions<2> conditions(uniaxial, boundaries);

  {
    Specimen                         body;
    StaggeredStep<2>::AdditionalData data;
    data.damage           = false;
    data.newton.tolerance = 1e-12;
    StaggeredStep<2> step(*body.points,
                          *body.boundary_points,
                          *material,
                          degradation,
                          Gc,
                          l,
                          1e5,
                          data);

    const auto force = [](const StaggeredStep<2> &s) {
      return s.reactions().at(3)[1];
    };

    // The work of the reaction, by Simpson's rule. Nothing is accepted before
    // the end: points that have moved are no Gauss points of the grid.
    double work = 0., force_before = 0.;
    for (unsigned int n = 1; n <= 4; ++n)
      {
        step.solve(conditions, 0.005 * (n - 0.5));
        const double force_between = force(step);
        step.solve(conditions, 0.005 * n);
        const double force_after = force(step);
        work += 0.005 / 6. * (force_before + 4. * force_between + force_after);
        force_before = force_after;

        Tensor<2, 2> P;
        material->stress(stretch(0.005 * n), 1., P, EnergyBranch::by_state);
        double psi, psi_intact;
        material->energies(stretch(0.005 * n), psi, psi_intact);
        const auto energies = step.energies();
        deallog << "elastic, u = " << 0.005 * n << ": force "
                << close_to(force_after, P[1][1], 1e-9) << ", opposite "
                << close_to(step.reactions().at(2)[1], -P[1][1], 1e-9)
                << ", sideways "
                << close_to(step.reactions().at(1)[0], P[0][0], 1e-9)
                << ", energy "
                << close_to(energies.elastic, psi + psi_intact, 1e-9)
                << ", work " << close_to(work, energies.elastic, 1e-6)
                << std::endl;
      }
    step.accept();
    Tensor<2, 2> P;
    material->stress(stretch(0.02), 1., P, EnergyBranch::by_state);
    step.solve(conditions, 0.02);
    deallog << "again, after the points have moved: force "
            << close_to(force(step), P[1][1], 1e-3) << std::endl;

    // From rest, without a guess, in one step that is not small at all.
    {
      Specimen         fresh;
      StaggeredStep<2> large(*fresh.points,
                             *fresh.boundary_points,
                             *material,
                             degradation,
                             Gc,
                             l,
                             1e5,
                             data);
      for (const double u : {0.0375, 0.3, -0.1})
        {
          const auto report = large.solve(conditions, u);
          material->stress(stretch(u), 1., P, EnergyBranch::by_state);
          deallog << "from rest to u = " << u << ": force "
                  << close_to(force(large), P[1][1], 1e-9) << ", iterations "
                  << (report.newton_iterations <= 4 ? "few" : "MANY")
                  << (report.indefinite ? ", INDEFINITE" : "") << std::endl;
        }
    }

    // A load that turns the body inside out.
    const auto before = body.everything();
    step.solve(conditions, 0.025);
    const double once   = force(step);
    bool         failed = false;
    try
      {
        step.solve(conditions, -1.5);
      }
    catch (const ExcSolverFailure &)
      {
        failed = true;
      }
    const auto after = body.everything();
    step.solve(conditions, 0.025);
    deallog << "absurd load: " << (failed ? "failed" : "solved") << ", points "
            << (before == after ? "untouched" : "CHANGED") << ", again "
            << close_to(force(step), once, 1e-10) << std::endl;
  }

  {
    // With damage, iterated: strain is prescribed, so H is known.
    Specimen                         body;
    StaggeredStep<2>::AdditionalData data;
    data.max_passes             = 60;
    data.tolerance              = 1e-7;
    data.newton.tolerance       = 1e-11;
    data.intermediate_tolerance = 1e-11;
    StaggeredStep<2> step(*body.points,
                          *body.boundary_points,
                          *material,
                          degradation,
                          Gc,
                          l,
                          1e5,
                          data);
    for (const double u : {0.005, 0.01455, 0.03, 0.02})
      {
        // After a step to 0.03 was accepted, the last one is an unloading, at
        // which H stays.
        const bool   unloading = (u == 0.02);
        const double tolerance = (unloading ? 1e-3 : 1e-5);
        if (unloading)
          step.accept();
        step.solve(conditions, u);

        double H, psi, psi_intact;
        material->energies(stretch(unloading ? 0.03 : u), H, psi_intact);
        material->energies(stretch(u), psi, psi_intact);
        const double d = H / (H + Gc / (2. * l));
        const double g = degradation.value(d);
        Tensor<2, 2> P;
        material->stress(stretch(u), g, P, EnergyBranch::by_state);
        double error = 0.;
        for (const double damage : step.material_state().damage)
          error = std::max(error, std::abs(damage - d));
        deallog
          << "damage, u = " << u << ": d = " << d << ' '
          << verdict(Utilities::MPI::max(error, MPI_COMM_WORLD), tolerance)
          << ", P = " << P[1][1] << ' '
          << close_to(step.reactions().at(3)[1], P[1][1], tolerance)
          << ", elastic energy "
          << close_to(step.energies().elastic, g * psi + psi_intact, tolerance)
          << ", crack area "
          << close_to(step.crack_area(), d * d / (2. * l), tolerance)
          << std::endl;
      }
  }
}
