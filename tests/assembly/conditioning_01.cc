// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The condition number of the elastic stiffness of a square, one edge of which
// cuts the first row of cells so that only a fraction of them is occupied. With
// the extension, it stays within a factor of 15 over all fractions from 1 to
// 1e-6; without, it grows without bound.

#include <ebsmpm/materials/linear_elastic.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include "../tests.h"
#include "point_setup.h"



struct Spectrum
{
  double       condition_number;
  unsigned int n_negative;
  unsigned int size;
};

Spectrum
compute_spectrum(const unsigned int degree,
                 const double       fraction,
                 const double       threshold)
{
  const unsigned int                      n = 8;
  const double                            h = 1. / n;
  parallel::distributed::Triangulation<2> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, n, 0., 1.);
  BodyOnGrid<2> body(triangulation,
                     BoxBody<2>(Point<2>(h * (1. - fraction), 0.),
                                Point<2>(1., 1.)),
                     degree,
                     degree + 1);
  body.make_space(threshold);

  const LinearElastic<2> material(1.25, 1., EnergySplit::none);
  const Degradation      degradation(1e-4);
  DisplacementSystem<2>  system(material,
                               degradation,
                               (degree == 3 ? 40. : 20.) *
                                 material.nitsche_stiffness() / h);
  body.reinit(system);
  LA::FieldVector u = system.make_vector(), residual = u;
  system.assemble_tangent(body.state, body.boundary, u, residual);

  LAPACKFullMatrix<double> matrix(u.size(), u.size());
  for (const auto &entry : system.matrix())
    matrix(entry.row(), entry.column()) = entry.value();
  Vector<double>     eigenvalues;
  FullMatrix<double> eigenvectors;
  matrix.compute_eigenvalues_symmetric(
    -1e15, 1e15, 0., eigenvalues, eigenvectors);
  AssertThrow(eigenvalues.size() == u.size(), ExcInternalError());

  Spectrum spectrum = {0., 0, static_cast<unsigned int>(u.size())};
  double   smallest = 1e300, largest = 0.;
  for (const double lambda : eigenvalues)
    {
      smallest = std::min(smallest, std::abs(lambda));
      largest  = std::max(largest, std::abs(lambda));
      // Those that are zero but for roundoff have no sign.
      spectrum.n_negative += lambda < -1e-13 * eigenvalues(u.size() - 1);
    }
  spectrum.condition_number = largest / smallest;
  return spectrum;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  initlog();

  for (unsigned int degree = 1; degree <= 3; ++degree)
    {
      deallog << "degree " << degree << std::endl;
      double smallest = 1e300, largest = 0.;
      bool   always_positive = true;
      for (const double fraction :
           {1., 0.5, 0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
        {
          const Spectrum with    = compute_spectrum(degree, fraction, 0.1);
          const Spectrum without = compute_spectrum(degree, fraction, 0.);
          deallog << "  fraction " << digits(fraction, 1) << ": "
                  << with.size << " unknowns "
                  << digits(with.condition_number, 3) << ", without "
                  << without.size << ' '
                  << (without.condition_number > 1e9 ?
                        "above 1e9" :
                        digits(without.condition_number, 3))
                  << std::endl;
          smallest = std::min(smallest, with.condition_number);
          largest  = std::max(largest, with.condition_number);
          always_positive &= with.n_negative == 0;
        }
      deallog << "  within a factor of 15: " << verdict(largest / smallest, 15.)
              << ", positive definite: " << (always_positive ? "OK" : "FAILED")
              << std::endl;
    }
}
