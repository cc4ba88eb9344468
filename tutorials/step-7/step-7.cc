/* -----------------------------------------------------------------------------
 *
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * Copyright (C) 2026 by the ebsmpm authors
 *
 * This file is part of the ebsmpm library.
 *
 * -----------------------------------------------------------------------------
 */


// A beam of 50 x 50 x 200 mm has a notch in the middle, half as deep as the
// beam and turned by 45 degrees against its axis. Its ends are twisted against
// each other. A crack starts at the bottom of the notch; as it runs down
// through the beam, it turns, so that its surface is not flat but twisted, and
// finally the beam falls into two pieces. This is a test that concrete has been
// put to, at twice the size, by Brokenshire (1996).
//
// Compared with step-6, what is new is the third dimension, and what comes with
// it: so many unknowns that one does not want to factorise, and so many points
// that one wants to share them. None of this needs a line of code here, since
// nothing in the library depends on the dimension or on the number of
// processes; the parameter file says it all. What this program adds is an
// answer to the question how much the crack is twisted, for which all processes
// have to put together what they know.
// @code
//   step-7 coarse.prm                         # cells of 5 mm
//   mpirun -n 4 step-7 step-7.prm             # cells of 2.5 mm
// @endcode
// See README.md for how long this takes, and for the results.

// @sect3{Include files}

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/solvers/parameters.h>
#include <ebsmpm/solvers/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/table_handler.h>

#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>

namespace Step7
{
  using namespace EBSMPM;

  // @sect3{The TwistObserver class}

  // The part of the beam below the notch is divided into layers. For each
  // layer, we want to know which way the crack looks.
  class TwistObserver
  {
  public:
    TwistObserver(const Simulation<3> &simulation,
                  const Parameters    &parameters);

    void
    observe(const double load, const StaggeredStep<3>::Report &report);

    void
    write(std::ostream &stream) const;

  private:
    static constexpr unsigned int n_layers = 5;

    const Simulation<3> &simulation;
    const double         noticed;
    TableHandler         table;
  };



  TwistObserver::TwistObserver(const Simulation<3> &simulation,
                               const Parameters    &parameters)
    : simulation(simulation)
    , noticed(parameters.partition.closure_damage)
  {}



  // @sect4{TwistObserver::observe()}

  // Each point next to the crack carries a unit vector $\mathbf m_p$ towards
  // it. The points on both sides have opposite ones, so they must not be added
  // up. But the tensors $\mathbf m_p\otimes\mathbf m_p$ can: the principal
  // direction of their sum is the mean normal of the crack. Two numbers say
  // where it points to: the angle between the axis of the beam and the part of
  // the normal in the horizontal plane ($45^\circ$ in the notch, $0^\circ$ for
  // a crack straight across the beam), and how far it is inclined against that
  // plane.
  //
  // A process has the points in its own cells only, and a layer reaches over
  // many processes. Hence we collect the sums of all layers in one array, and
  // let Utilities::MPI::sum() add up those of all processes: one message,
  // whatever the number of layers. After that, all processes know the result,
  // and compute the same angles.
  //
  // By the way, we have a look at how well the points are distributed. As the
  // halves move by less than a cell, the grid need not be distributed anew
  // during this simulation; it would be, see the parameter "Largest imbalance".
  void
  TwistObserver::observe(const double                    load,
                         const StaggeredStep<3>::Report &report)
  {
    constexpr unsigned int n_entries =
      SymmetricTensor<2, 3>::n_independent_components;
    std::vector<double> sums(n_layers * n_entries, 0.);
    for (const auto &particle : simulation.material_points().handler())
      {
        // Views of points want to be able to write; we do not.
        auto                   copy = particle;
        const MaterialPoint<3> point(copy.get_properties());
        const Point<3> X     = particle.get_location() - point.displacement();
        const int      layer = std::floor(-X[1] / 25. * n_layers);
        if (point.damage() < noticed || layer < 0 ||
            layer >= static_cast<int>(n_layers))
          continue;
        const Tensor<1, 3> m = point.side();
        const auto         M = symmetrize(outer_product(m, m));
        for (unsigned int i = 0; i < n_entries; ++i)
          sums[layer * n_entries + i] +=
            point.reference_volume() * M.access_raw_entry(i);
      }
    const MPI_Comm communicator = MPI_COMM_WORLD;
    Utilities::MPI::sum(sums, communicator, sums);
    const double n_points = simulation.material_points().n_locally_owned();
    const auto   balance  = Utilities::MPI::min_max_avg(n_points, communicator);

    table.add_value("u", load);
    table.add_value("torque", simulation.driven_force());
    table.add_value("pieces", report.n_pieces);
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        SymmetricTensor<2, 3> M;
        for (unsigned int i = 0; i < n_entries; ++i)
          M.access_raw_entry(i) = sums[layer * n_entries + i];
        double twist = 0., inclination = 0.;
        if (trace(M) > 0.)
          {
            const Tensor<1, 3> n = eigenvectors(M)[0].second;
            twist                = std::atan(n[0] / n[2]);
            inclination          = std::asin(std::abs(n[1]));
          }
        const std::string name = std::to_string(layer);
        table.add_value("twist" + name, 180. / numbers::PI * twist);
        table.add_value("incl" + name, 180. / numbers::PI * inclination);
      }
    table.add_value("imbalance", balance.max / balance.avg);
  }



  void
  TwistObserver::write(std::ostream &stream) const
  {
    table.write_text(stream);
  }



  // @sect3{The run}

  void
  run(const Parameters &parameters)
  {
    const bool is_first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    Simulation<3> simulation(parameters,
                             MPI_COMM_WORLD,
                             Overwrite::yes,
                             &std::cout);
    TwistObserver observer(simulation, parameters);

    // The file is written again after each step: one likes to look at a long
    // simulation before it is done.
    simulation.signals.step_done.connect(
      [&](const unsigned int,
          const double                    load,
          const StaggeredStep<3>::Report &report) {
        observer.observe(load, report);
        if (is_first)
          {
            std::ofstream file(parameters.output.directory + "/twist.txt");
            observer.write(file);
          }
      });
    simulation.run();
  }
} // namespace Step7



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
      AssertThrow(parameters.grid.dimension == 3,
                  ExcParameter("Background grid/Dimension", "2", "3"));
      Step7::run(parameters);
    }
  catch (const std::exception &exception)
    {
      std::cerr << exception.what() << std::endl;
      return 1;
    }
  return 0;
}
