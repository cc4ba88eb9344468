/* -----------------------------------------------------------------------------
 *
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * Copyright (C) 2026 by the ebsmpm authors
 *
 * This file is part of the ebsmpm library.
 *
 * -----------------------------------------------------------------------------
 */

// An L-shaped panel stands on its leg and is pulled upwards at the end of its
// arm, by two per cent of its height. A crack starts at the inner corner, runs
// on a curve into the panel, and opens so wide that one could look through it.
// This is the second benchmark of Sugai et al. (section 4.(2)), and the
// difference between the two variants is one for the eye: in a diffusive crack,
// material points that no longer carry anything are stretched across the
// opening, while a discrete one leaves a gap without points.
//
// In step-5, we put a simulation together by hand. Here we take the class that
// is behind the program <code>ebsmpm</code> as it is, run it twice, and connect
// to its signal an observer of our own: one that follows the tip of the crack,
// and counts the points that bridge the crack as well as the empty places that
// the crack leaves behind.
// @code
//   step-6 coarse.prm       # cells of 10 mm: half a minute per variant
//   step-6 step-6.prm       # cells of 5 mm, as in the paper: some minutes
// @endcode
// See README.md for the results.

// @sect3{Include files}

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/solvers/parameters.h>
#include <ebsmpm/solvers/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/table_handler.h>

#include <deal.II/particles/particle_handler.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <set>

namespace Step6
{
  using namespace EBSMPM;

  // @sect3{The CrackObserver class}

  // What we want to know about the crack after each load step. The inner
  // corner, where it starts, and the part of the panel in which we look for it,
  // are those of the undeformed panel.
  class CrackObserver
  {
  public:
    CrackObserver(const Simulation<2> &simulation,
                  const Parameters    &parameters);

    void
    observe(const unsigned int n, const double load);

    void
    write(std::ostream &stream) const;

  private:
    const Simulation<2> &simulation;
    const double         broken;
    const double         spacing;
    TableHandler         table;
  };



  CrackObserver::CrackObserver(const Simulation<2> &simulation,
                               const Parameters    &parameters)
    : simulation(simulation)
    , broken(parameters.partition.damage_threshold)
    , spacing(parameters.cell_size() / 5.)
  {}



  // @sect4{CrackObserver::observe()}

  // The state is on the material points, each of which is a deal.II particle
  // with properties; MaterialPoint gives them names. A process has the points
  // in its own cells only, hence the sums over all of them.
  //
  // The tip is the point that is farthest from the corner among those with more
  // damage than what makes a crack discrete. A point whose volume is more than
  // doubled bridges the crack: no sound material gets there. To find the gap,
  // we divide each cell of the grid into squares a fifth of a cell wide, which
  // is more than the distance of points where the crack runs. In the
  // neighbourhood of the corner, all squares have points at first: we count in
  // how many there still are any. A square is part of one cell, and hence known
  // to one process only.
  void
  CrackObserver::observe(const unsigned int n, const double load)
  {
    const Point<2> corner(250., 250.);
    const auto     square = [&](const double x) {
      return static_cast<int>(std::floor(x / spacing));
    };
    const std::array<int, 2> lower = {{square(110.), square(260.)}};
    const std::array<int, 2> upper = {{square(240.), square(390.)}};

    double                       length     = 0.;
    unsigned int                 n_bridging = 0;
    std::set<std::array<int, 2>> occupied;
    for (const auto &particle : simulation.material_points().handler())
      {
        // Views of points want to be able to write; we do not.
        auto                   copy = particle;
        const MaterialPoint<2> point(copy.get_properties());
        const Point<2>        &x = particle.get_location();
        if (point.damage() > broken)
          length = std::max(length, corner.distance(x - point.displacement()));
        if (determinant(point.deformation_gradient()) > 2.)
          ++n_bridging;
        const std::array<int, 2> place = {{square(x[0]), square(x[1])}};
        if (place[0] >= lower[0] && place[0] < upper[0] &&
            place[1] >= lower[1] && place[1] < upper[1])
          occupied.insert(place);
      }

    const MPI_Comm communicator = MPI_COMM_WORLD;
    length                      = Utilities::MPI::max(length, communicator);
    n_bridging                  = Utilities::MPI::sum(n_bridging, communicator);
    const unsigned int n_occupied =
      Utilities::MPI::sum(static_cast<unsigned int>(occupied.size()),
                          communicator);
    const unsigned int n_squares =
      (upper[0] - lower[0]) * (upper[1] - lower[1]);

    table.add_value("step", n);
    table.add_value("u", load);
    table.add_value("force", simulation.driven_force());
    table.add_value("crack", length);
    table.add_value("bridging", n_bridging);
    table.add_value("empty", n_squares - n_occupied);
  }



  void
  CrackObserver::write(std::ostream &stream) const
  {
    table.write_text(stream);
  }



  // @sect3{Two runs}

  // The parameters of the program <code>ebsmpm</code>; what differs between the
  // two variants is a flag and the folder for the results.
  void
  run(Parameters &parameters, const bool discrete)
  {
    const std::string folder    = parameters.output.directory;
    parameters.partition.enable = discrete;
    parameters.output.directory =
      folder + (discrete ? "/PF-MPM-DFG" : "/PF-MPM");

    const bool is_first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    Simulation<2> simulation(parameters,
                             MPI_COMM_WORLD,
                             Overwrite::yes,
                             &std::cout);
    CrackObserver observer(simulation, parameters);
    simulation.signals.step_done.connect(
      [&](const unsigned int n,
          const double       load,
          const StaggeredStep<2>::Report &) { observer.observe(n, load); });
    simulation.run();

    if (is_first)
      {
        std::ofstream file(parameters.output.directory + "/crack.txt");
        observer.write(file);
      }
    parameters.output.directory = folder;
  }
} // namespace Step6



// @sect3{The main() function}

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
      for (const bool discrete : {false, true})
        Step6::run(parameters, discrete);
    }
  catch (const std::exception &exception)
    {
      std::cerr << exception.what() << std::endl;
      return 1;
    }
  return 0;
}
