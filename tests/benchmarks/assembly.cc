// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Times of what happens in a load step: assembly for displacement and damage,
// linear solves, spaces, sorting and numbering of the points, and the crack
// partition, on a block of quadratic B-splines with a fixed number of points
// per cell. Sizes double; the last column is the exponent of the growth of the
// time with the number of points.
//
// Three columns compare with dgemm, in this process: the time that it takes for
// the products with gradients, as a part of the time measured. These are cG,
// and the half of G^T(cG) that symmetry leaves; on the boundary, the same with
// values and gradients; the gradients of the increment, and the residual.
// "calls" is the time of dgemm when it is called for each of them, with the
// matrices of a cell: the bound for an assembly that is written with BLAS-3.
// One half of a product is as many calls as there are panels of rows, each
// beginning at the diagonal, of the height that is fastest. "speed" is the time
// of as many operations, at the speed that dgemm has in full products of
// matrices of a cell, and "peak" at that for large ones; one half cannot be had
// from it as fast as that.
//
// Arguments: dimension (2), points per direction (3), the number of cells per
// direction of the smallest block (16), and the number of sizes (4).

#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/particles/generators.h>
#include <ebsmpm/particles/material_points.h>
#include <ebsmpm/particles/shape_parser.h>

#include <ebsmpm/fracture/crack_partition.h>

#include <ebsmpm/assembly/damage_system.h>

#include <ebsmpm/solvers/newton_solver.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <map>
#include <vector>

#include "../assembly/point_setup.h"



/** The shortest of several measurements, in seconds, of the slowest process. */
template <typename Function>
double
seconds(const Function &function, const unsigned int n_repetitions = 5)
{
  double result = std::numeric_limits<double>::max();
  for (unsigned int i = 0; i < n_repetitions; ++i)
    {
      MPI_Barrier(MPI_COMM_WORLD);
      Timer timer(MPI_COMM_WORLD, true);
      function();
      timer.stop();
      result = std::min(result, timer.wall_time());
    }
  return result;
}



/**
 * A product of matrices, with dgemm, in the form that is fastest for matrices
 * that are small: both have their inner dimension as columns, which lie in one
 * piece.
 */
class MatrixProduct
{
public:
  MatrixProduct(const unsigned int n_inner,
                const unsigned int n_rows,
                const unsigned int n_columns)
    : A(n_rows, n_inner)
    , B(n_columns, n_inner)
    , C(n_rows, n_columns)
    , n_flops(2. * n_inner * n_rows * n_columns)
  {
    for (unsigned int i = 0; i < n_inner; ++i)
      {
        for (unsigned int j = 0; j < n_rows; ++j)
          A(j, i) = 1. / (1. + i + j);
        for (unsigned int j = 0; j < n_columns; ++j)
          B(j, i) = 1. / (1. + i * j);
      }
  }

  void
  multiply()
  {
    A.mTmult(C, B);
  }

private:
  LAPACKFullMatrix<double> A, B, C;

public:
  const double n_flops;
};



/** Some products, one after the other. */
class MatrixProducts
{
public:
  void
  add(const unsigned int n_inner,
      const unsigned int n_rows,
      const unsigned int n_columns)
  {
    products.emplace_back(n_inner, n_rows, n_columns);
    n_flops += products.back().n_flops;
  }

  /** How long they take, as a mean over many repetitions. */
  double
  time()
  {
    const unsigned int n_repetitions = std::ceil(1e7 / n_flops);
    return seconds(
             [&]() {
               for (unsigned int i = 0; i < n_repetitions; ++i)
                 for (MatrixProduct &product : products)
                   product.multiply();
             },
             1) /
           n_repetitions;
  }

  double n_flops = 0.;

private:
  std::vector<MatrixProduct> products;
};



/**
 * What is multiplied in each cell, side or point: different ways to do it, the
 * last one being a single product; which part of the operations of that is
 * needed; and the number of times that it is done.
 */
struct CellProduct
{
  std::vector<MatrixProducts> ways;
  double                      part;
  double                      n_times;
};



/** Prints lines, and remembers them for the growth with the size. */
class Report
{
public:
  Report()
    : out(std::cout, Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
  {
    large_product.add(384, 384, 384);
  }

  /**
   * Measure something in turn with dgemm: machines change their speed. What
   * takes long is disturbed more often than a small product is, so the best of
   * many is taken of both.
   */
  template <typename Function>
  void
  compare(const std::string       &what,
          const double             n_points,
          std::vector<CellProduct> products,
          const Function          &function)
  {
    const double infinity = std::numeric_limits<double>::max();
    double       time = infinity, large_time = infinity;

    std::vector<std::vector<double>> times;
    for (const CellProduct &product : products)
      times.emplace_back(product.ways.size(), infinity);
    for (unsigned int i = 0; i < 24; ++i)
      {
        time       = std::min(time, seconds(function, 1));
        large_time = std::min(large_time, large_product.time());
        for (unsigned int k = 0; k < products.size(); ++k)
          for (unsigned int w = 0; w < products[k].ways.size(); ++w)
            times[k][w] = std::min(times[k][w], products[k].ways[w].time());
      }

    double of_calls = 0., of_speed = 0., of_peak = 0.;
    for (unsigned int k = 0; k < products.size(); ++k)
      {
        const double n_times = products[k].n_times;
        const double n_parts = products[k].part * n_times;
        of_calls +=
          n_times * *std::min_element(times[k].begin(), times[k].end());
        of_speed += n_parts * times[k].back();
        of_peak += n_parts * products[k].ways.back().n_flops /
                   large_product.n_flops * large_time;
      }
    const double all_time =
      Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) * time;
    print(what,
          n_points,
          time,
          {{of_calls / all_time, of_speed / all_time, of_peak / all_time}});
  }

  /** Print a line; fractions of dgemm that are zero are unknown. */
  void
  print(const std::string          &what,
        const double                n_points,
        const double                time,
        const std::array<double, 3> fractions = {{0., 0., 0.}})
  {
    out << "  " << std::left << std::setw(24) << what << std::right
        << std::setprecision(3) << std::setw(10) << 1e3 * time << " ms"
        << std::setw(10) << 1e-6 * n_points / time << " M/s";
    for (const double fraction : fractions)
      if (fraction > 0.)
        out << std::setw(9) << 100. * fraction << " %";
      else
        out << std::setw(11) << "";
    const auto found = previous.find(what);
    if (found != previous.end())
      out << std::setw(9)
          << std::log(time / found->second.second) /
               std::log(n_points / found->second.first);
    out << std::endl;
    previous[what] = {n_points, time};
  }

private:
  MatrixProducts                                   large_product;
  std::map<std::string, std::pair<double, double>> previous;

public:
  ConditionalOStream out;
};



/**
 * Time the sorting of points into cells, when all of them have moved by three
 * tenths of a cell in all directions, to and fro: half of them or more are in
 * another cell then.
 */
template <int dim>
double
sorting_time(const Triangulation<dim> &triangulation,
             const double              h,
             const unsigned int        n_per_direction)
{
  const MappingCartesian<dim>   mapping;
  MaterialPoints<dim>           points(triangulation, mapping);
  PointGenerator::FillData<dim> data;
  data.n_points_per_direction = n_per_direction;
  PointGenerator::fill(*parse_shape<dim>(dim == 2 ? "box(0,0, 1,1)" :
                                                    "box(0,0,0, 1,1,1)"),
                       data,
                       points);
  double shift = 0.3 * h;
  return seconds([&]() {
    for (auto &particle : points.handler())
      {
        Point<dim> location = particle.get_location();
        for (unsigned int d = 0; d < dim; ++d)
          location[d] += shift;
        particle.set_location(location);
      }
    points.sort();
    shift = -shift;
  });
}



template <int dim>
void
run(const unsigned int n_cells,
    const unsigned int n_per_direction,
    Report            &table)
{
  // A frame of two empty cells around the block.
  const double                              h = 1. / n_cells;
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation,
                                       n_cells + 4,
                                       -2. * h,
                                       1. + 2. * h);
  Point<dim> upper;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = 1.;
  BodyOnGrid<dim> body(triangulation,
                       BoxBody<dim>(Point<dim>(), upper),
                       2,
                       n_per_direction);

  const auto              material = make_material<dim>("neo-Hookean",
                                           EnergySplit::volumetric_deviatoric,
                                           175.,
                                           80.77);
  const Degradation       degradation(1e-4);
  DisplacementSystem<dim> u_system(*material, degradation, 1e6);
  DamageSystem<dim>       d_system(2.7e-3, 2.5 * h);

  const double n_points =
    Utilities::MPI::sum(double(body.points.n_points()), MPI_COMM_WORLD);
  table.out << dim << "-D, " << n_cells << " cells per direction, " << n_points
            << " points, " << Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)
            << " processes" << std::endl;

  table.print("sorting of points",
              n_points,
              sorting_time(triangulation, h, n_per_direction));
  table.print("numbering of points", n_points, seconds([&]() {
                body.points.reinit(body.material_handler, body.space.lattice());
              }));
  table.print("space and constraints", n_points, seconds([&]() {
                body.make_space(0.1);
              }));
  table.print("groups, new matrix",
              n_points,
              seconds([&]() { body.reinit(u_system); }, 1));
  table.print("groups, same matrix", n_points, seconds([&]() {
                body.reinit(u_system);
              }));
  body.reinit(d_system);

  // A crack through half of the block, between two rows of functions.
  for (unsigned int q = 0; q < body.points.n_points(); ++q)
    {
      const Point<dim> &x = body.points.location(q);
      const double      y = x[dim - 1] - 0.5 - 0.01 * h;
      const double r = x[0] < 0.5 ? std::abs(y) : std::hypot(x[0] - 0.5, y);
      body.state.damage[q]  = std::exp(-r / (2.5 * h));
      body.state.history[q] = 0.;
    }

  // Of the symmetric matrix of a cell, the diagonal and what is above it; and
  // for each point, how its rows, gradients and on the boundary values, too,
  // are combined: with the moduli of each pair of components, or with the
  // deformation gradient.
  struct Points
  {
    double       all;
    unsigned int in_cell;
  };
  const Points of_body     = {n_points, Utilities::pow(n_per_direction, dim)};
  const Points of_boundary = {
    Utilities::MPI::sum(double(body.boundary_points.n_points()),
                        MPI_COMM_WORLD),
    Utilities::pow(n_per_direction, dim - 1)};
  const unsigned int n_functions    = Utilities::pow(3, dim);
  const auto         single_product = [](const double       n_times,
                                 const unsigned int n_inner,
                                 const unsigned int n_rows,
                                 const unsigned int n_columns) {
    CellProduct result = {{{}}, 1., n_times};
    result.ways[0].add(n_inner, n_rows, n_columns);
    return result;
  };
  const auto symmetric_product = [&](const Points      &points,
                                     const unsigned int n_rows,
                                     const unsigned int n_components) {
    const unsigned int size = n_components * n_functions;
    CellProduct result = {{}, 0.5 + 0.5 / size, points.all / points.in_cell};
    for (unsigned int height = 1; height <= n_functions; ++height)
      {
        result.ways.emplace_back();
        for (unsigned int i = 0; i < n_functions; i += height)
          result.ways.back().add(n_rows * points.in_cell,
                                 n_components * n_components *
                                   (n_functions - i),
                                 std::min(height, n_functions - i));
      }
    return result;
  };
  const auto combination = [&](const Points      &points,
                               const unsigned int n_rows,
                               const unsigned int n_results) {
    return single_product(points.all, n_rows, n_results, n_functions);
  };
  const auto gradients = [&](const Points &points) {
    return single_product(points.all / points.in_cell,
                          n_functions,
                          dim,
                          dim * points.in_cell);
  };
  const auto residuals = [&](const Points &points) {
    return single_product(points.all / points.in_cell,
                          dim * points.in_cell,
                          dim,
                          n_functions);
  };

  LA::FieldVector x = u_system.make_vector(), residual = x, update = x;
  body.scatter_coefficients(x, dim);
  x *= 1e-3 * h;
  table.print("residual", n_points, seconds([&]() {
                u_system.assemble_residual(body.state,
                                           body.boundary,
                                           x,
                                           residual);
              }));
  table.compare("tangent and residual",
                n_points,
                {symmetric_product(of_body, dim, dim),
                 combination(of_body, dim, dim * dim * dim),
                 gradients(of_body),
                 residuals(of_body),
                 symmetric_product(of_boundary, dim + 1, dim),
                 combination(of_boundary, dim + 1, (dim + 1) * dim * dim)},
                [&]() {
                  u_system.assemble_tangent(body.state,
                                            body.boundary,
                                            x,
                                            residual);
                });

  LinearSolver solver;
  solver.set_block_size(dim);
  const double linear = seconds(
    [&]() {
      solver.invalidate();
      solve_linear_system(solver, u_system.matrix(), residual, 1e-4, update);
    },
    1);
  table.print(
    "Newton iteration",
    n_points,
    seconds(
      [&]() {
        u_system.assemble_tangent(body.state, body.boundary, x, residual);
        solve_linear_system(solver, u_system.matrix(), residual, 1e-4, update);
        u_system.assemble_residual(body.state, body.boundary, x, residual);
      },
      1));
  table.print("factorisation and solve", n_points, linear);
  std::vector<double> psi;
  table.print("driving energy", n_points, seconds([&]() {
                u_system.driving_energy(u_system.update_points(body.state, x),
                                        psi);
              }));

  LA::FieldVector right_hand_side = d_system.make_vector();
  table.compare(
    "damage matrix",
    n_points,
    {symmetric_product(of_body, dim + 1, 1), combination(of_body, dim, dim)},
    [&]() {
      d_system.assemble(body.state, body.boundary, {}, right_hand_side);
    });

  // The crack partition. A second update finds frozen labels.
  CrackPartition<dim> partition(body.space);
  CrackLabels<dim>    labels, boundary_labels;
  labels.resize(body.points.n_points());
  boundary_labels.resize(body.boundary_points.n_points());
  table.print("crack partition",
              n_points,
              seconds(
                [&]() {
                  partition.update(body.points,
                                   body.boundary_points,
                                   body.state.volume,
                                   body.state.damage,
                                   labels,
                                   boundary_labels);
                },
                2));

  Utilities::System::MemoryStats memory;
  Utilities::System::get_memory_stats(memory);
  const double bytes =
    1024. * Utilities::MPI::sum(double(memory.VmHWM), MPI_COMM_WORLD);
  const double matrix_bytes =
    Utilities::MPI::sum(double(u_system.matrix().memory_consumption()),
                        MPI_COMM_WORLD);
  table.out << "  at most " << bytes / n_points << " bytes per point, "
            << bytes / x.size()
            << " per unknown, program and factorisation included; "
            << matrix_bytes / x.size() << " per unknown for the matrix"
            << std::endl;
}



int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const auto argument = [&](const int i, const unsigned int default_value) {
    return argc > i ? static_cast<unsigned int>(std::atoi(argv[i])) :
                      default_value;
  };
  const unsigned int dim     = argument(1, 2);
  const unsigned int n       = argument(2, 3);
  const unsigned int n_cells = argument(3, 16);
  const unsigned int n_sizes = argument(4, 4);

  Report table;
  table.out << "  what                          time"
            << "         points     calls      speed       peak   growth"
            << std::endl;
  for (unsigned int size = 0, cells = n_cells; size < n_sizes;
       ++size, cells *= 2)
    if (dim == 2)
      run<2>(cells, n, table);
    else
      run<3>(cells, n, table);
}
