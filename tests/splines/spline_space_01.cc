// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// SplineSpace numbers the same functions with the same classes and fractions on
// any number of processes, some of which have no material; each function has
// one owner, the lowest rank that sees it, and one index that all agree on; and
// the independent functions come first. Also: what FunctionDirectory does.

#include <ebsmpm/splines/bspline_kernel.h>
#include <ebsmpm/splines/spline_space.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "../tests.h"

#include "support_setup.h"
#include "verdict.h"



/** A number for a key, the same everywhere. */
template <int dim>
double
number_of(const FunctionKey<dim> &key)
{
  return (FunctionKeyHash<dim>()(key) % 1000003) / 1000003.;
}



template <int dim>
void
test_space(const unsigned int degree, const bool refined)
{
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  std::vector<unsigned int>                 repetitions(dim, 3);
  Point<dim>                                lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      repetitions[d] = 3 + d;
      lower[d]       = -1.;
      upper[d]       = -1. + 0.5 * repetitions[d];
    }
  GridGenerator::subdivided_hyper_rectangle(triangulation,
                                            repetitions,
                                            lower,
                                            upper);
  triangulation.refine_global(dim == 2 ? 2 : 1);
  if (refined)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center()[0] < -0.4)
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }

  // A small ball in a corner, so that some processes have nothing of it.
  Point<dim> center;
  for (unsigned int d = 0; d < dim; ++d)
    center[d] = -0.5 + 0.02 * d;
  SplineSpace<dim> space(triangulation, degree);
  const auto       supports = ball_supports(triangulation, space, center, 0.37);
  space.reinit(supports, 0.1);

  const MPI_Comm     comm     = space.communicator();
  const unsigned int rank     = Utilities::MPI::this_mpi_process(comm);
  double             owned[4] = {0., 0., 0., 0.};
  unsigned int       errors   = 0;
  IndexSet           all(space.n_functions());
  for (const auto &entry : space.functions())
    {
      const auto &f = entry.second;
      all.add_index(f.index);
      errors += (f.owner > rank);
      errors +=
        (space.locally_owned().is_element(f.index) != (f.owner == rank));
      errors += (f.index < space.n_independent()) !=
                (f.category == SplineSpace<dim>::FunctionClass::standard);
      errors += (supports.count(entry.first) != 1);
      if (f.owner == rank)
        {
          const double x = number_of(entry.first);
          owned[0] += 1.;
          owned[1] += x;
          owned[2] += x * (1. + static_cast<int>(f.category));
          owned[3] += x * f.fraction;
        }
    }
  errors += (all != space.locally_relevant());
  errors += (space.functions().size() != supports.size());

  // What everybody knows about a function must be what its owner knows.
  std::vector<FunctionKey<dim>> keys;
  for (const auto &entry : space.functions())
    keys.push_back(entry.first);
  FunctionKey<dim> exterior;
  exterior.index[0] = -1000;
  keys.push_back(exterior);
  const auto answers = space.query(keys);
  errors += (answers.size() != space.functions().size());
  for (const auto &answer : answers)
    {
      const auto &mine = *space.find(answer.first);
      errors += (answer.second.index != mine.index ||
                 answer.second.owner != mine.owner ||
                 answer.second.category != mine.category ||
                 answer.second.fraction != mine.fraction);
    }

  // The indices of all processes together are all indices, each once.
  types::global_dof_index sum = 0;
  for (const auto i : space.locally_owned())
    sum += i;
  const types::global_dof_index n = space.n_functions();
  errors += (Utilities::MPI::sum(sum, comm) != n * (n - 1) / 2);
  errors +=
    (Utilities::MPI::sum(space.locally_owned().n_elements(), comm) != n);
  errors += (Utilities::MPI::sum(space.locally_owned_independent().n_elements(),
                                 comm) != space.n_independent());
  errors += !space.locally_owned_independent().is_contiguous();

  for (double &x : owned)
    x = Utilities::MPI::sum(x, comm);
  deallog << dim << "-D, degree " << degree << ": " << n << " functions, "
          << space.n_independent() << " independent, " << space.n_deficient()
          << " deficient, " << space.n_twins() << " twins, consistent "
          << verdict(Utilities::MPI::sum(errors, comm), 0.) << std::endl
          << "  keys " << owned[0] << ' ' << digits(owned[1], 10)
          << ", classes " << digits(owned[2], 10) << ", fractions "
          << digits(owned[3], 10) << std::endl;
}



void
test_directory()
{
  const MPI_Comm     comm    = MPI_COMM_WORLD;
  const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
  using Directory            = FunctionDirectory<2, double>;
  Directory directory(comm);

  // Function i is known to the ranks above i/10, and published by rank i mod N.
  const auto key = [](const int i) {
    FunctionKey<2> key;
    key.level = 2;
    key.index = {{i, -i}};
    return key;
  };
  Directory::Table              local;
  std::vector<Directory::Entry> mine;
  std::vector<FunctionKey<2>>   questions;
  for (unsigned int i = 0; i < 40; ++i)
    {
      if (rank >= i / 10)
        local[key(i)] = rank + 0.01 * i;
      if (i % n_ranks == rank && i % 3 != 0)
        mine.push_back({key(i), 100. + i});
      questions.push_back(key(i));
    }

  double     error = 0.;
  const auto sums  = directory.reduce(local, std::plus<double>());
  error += std::abs(1. * sums.size() - 1. * local.size());
  for (unsigned int i = 0; i < 40; ++i)
    if (rank >= i / 10)
      {
        double expected = 0.;
        for (unsigned int r = i / 10; r < n_ranks; ++r)
          expected += r + 0.01 * i;
        error = std::max(error, std::abs(sums.at(key(i)) - expected));
      }
  deallog << "reduce " << verdict(Utilities::MPI::max(error, comm), 1e-12);

  directory.publish(mine);
  const auto found = directory.query(questions);
  error            = 0.;
  for (unsigned int i = 0; i < 40; ++i)
    error += (i % 3 == 0) ? found.count(key(i)) :
                            std::abs(found.at(key(i)) - (100. + i));
  deallog << ", query " << verdict(Utilities::MPI::max(error, comm), 0.);

  // The part belongs to the key.
  error = directory.query({key(1).with_part(1)}).size();
  directory.clear();
  error += directory.query(questions).size();
  deallog << ", nothing else " << verdict(Utilities::MPI::max(error, comm), 0.)
          << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();

  test_directory();
  for (unsigned int degree = 1; degree <= 3; ++degree)
    {
      test_space<2>(degree, false);
      test_space<3>(degree, false);
    }
  test_space<2>(2, true);
}
