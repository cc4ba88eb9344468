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
// 1e-6; without, it grows without bound. And: which penalty factors of
// Nitsche's method make the stiffness positive definite.

#include <ebsmpm/materials/linear_elastic.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include "../tests.h"

#include "point_setup.h"



/** Cells per unit length. */
constexpr unsigned int n = 8;



struct Spectrum
{
  double       condition_number;
  unsigned int n_negative;
  unsigned int size;
};

Spectrum
compute_spectrum(const Body<2>     &shape,
                 const unsigned int degree,
                 const double       threshold,
                 const double       penalty_factor)
{
  const double                            h = 1. / n;
  parallel::distributed::Triangulation<2> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 2 * n, -1., 1.);
  BodyOnGrid<2> body(triangulation, shape, degree, degree + 1);
  body.make_space(threshold);

  const LinearElastic<2> material(1.25, 1., EnergySplit::none);
  const Degradation      degradation(1e-4);
  DisplacementSystem<2>  system(
    material, degradation, penalty_factor * material.nitsche_stiffness() / h);
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
          const BoxBody<2> body(Point<2>((1. - fraction) / n, 0.),
                                Point<2>(1., 1.));
          const Spectrum   with    = compute_spectrum(body, degree, 0.1, 20.);
          const Spectrum   without = compute_spectrum(body, degree, 0., 20.);
          deallog << "  fraction " << digits(fraction, 1) << ": " << with.size
                  << " unknowns " << digits(with.condition_number, 3)
                  << ", without " << without.size << ' '
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

      // Which penalty factors make it positive definite? The worst of these
      // bodies and of squares that are turned in several ways.
      deallog << "  negative eigenvalues";
      for (const double factor : {2., 5., 10., 20., 40.})
        {
          unsigned int n_negative = 0;
          for (unsigned int i = 0; i < 12; ++i)
            {
              const BoxBody<2> aligned(Point<2>((1. - i / 13.) / n, 0.),
                                       Point<2>(1., 1.));
              const auto       turned =
                PolygonBody::rotated_square(0.13 * i,
                                            Point<2>(0.011 * i, 0.003 * i));
              for (const Body<2> *body :
                   {static_cast<const Body<2> *>(&aligned),
                    static_cast<const Body<2> *>(&turned)})
                n_negative = std::max(
                  n_negative,
                  compute_spectrum(*body, degree, 0.1, factor).n_negative);
            }
          deallog << ", factor " << static_cast<int>(factor) << ": "
                  << (n_negative > 0 ? "some" : "none");
        }
      deallog << std::endl;
    }
}
