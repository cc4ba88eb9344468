// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// LinearSolver::renumber(): a preconditioner is used on when unknowns have got
// other numbers, on other processes, some of them are new and others no longer
// there. Without it, a new one is computed.

#include <ebsmpm/lac/linear_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/base/utilities.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include "../tests.h"

using namespace EBSMPM;



/** A chain of n springs that are held at both ends, softly along the chain. */
struct Chain
{
  Chain(const unsigned int n, const bool reversed)
    : n(n)
    , reversed(reversed)
    , owned(dealii::Utilities::create_evenly_distributed_partitioning(
        dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
        n))
  {
    DynamicSparsityPattern sparsity(n, n, owned);
    for (const auto i : owned)
      for (const auto j : neighbours(i))
        sparsity.add(i, j);
    matrix.reinit(owned, owned, sparsity, MPI_COMM_WORLD);
    for (const auto i : owned)
      for (const auto j : neighbours(i))
        matrix.set(i, j, i == j ? 2.01 + 0.001 * position(i) / n : -1.);
    matrix.compress(VectorOperation::insert);
  }

  /** Where an unknown is in the chain, from 0 to n-1. */
  unsigned int
  position(const unsigned int i) const
  {
    return reversed ? n - 1 - i : i;
  }

  std::vector<unsigned int>
  neighbours(const unsigned int i) const
  {
    std::vector<unsigned int> result(1, i);
    if (i > 0)
      result.push_back(i - 1);
    if (i + 1 < n)
      result.push_back(i + 1);
    return result;
  }

  const unsigned int n;
  const bool         reversed;
  const IndexSet     owned;
  LA::SparseMatrix   matrix;
};



void
solve(LinearSolver &solver, const Chain &chain, const std::string &what)
{
  LA::Vector exact(chain.owned, MPI_COMM_WORLD), x(exact), b(exact);
  for (const auto i : chain.owned)
    exact(i) = 1. + (chain.position(i) % 7);
  exact.compress(VectorOperation::insert);
  chain.matrix.vmult(b, exact);
  const auto report = solver.solve(chain.matrix, x, b);
  x -= exact;
  deallog << what << ": "
          << (x.l2_norm() < 1e-7 * exact.l2_norm() ? "solved" : "FAILED")
          << (report.iterations <= 2  ? ", at once" :
              report.iterations <= 12 ? ", in few iterations" :
                                        ", in many iterations")
          << (report.refreshed ? ", refreshed" : "") << std::endl;
}



/**
 * The longer chain has two unknowns more at each end, the shorter one lacks
 * two; otherwise, position k of one is position k + shift of the other.
 */
void
renumber(LinearSolver &solver,
         const Chain  &from,
         const Chain  &to,
         const int     shift)
{
  const auto partitioner =
    std::make_shared<Utilities::MPI::Partitioner>(to.owned, MPI_COMM_WORLD);
  LA::FieldVector rows(partitioner);
  for (const auto i : to.owned)
    {
      const int k = static_cast<int>(to.position(i)) - shift;
      if (k >= 0 && k < static_cast<int>(from.n))
        rows(i) = 1. + (from.reversed ? from.n - 1 - k : k);
    }
  solver.renumber(rows);
}



void
test(const std::string &method)
{
  deallog.push(method);
  LinearSolver::AdditionalData data;
  data.method = LinearSolver::method_from_name(method);

  const Chain chain(100, false), longer(104, true), shorter(96, true);
  {
    LinearSolver solver(data);
    solve(solver, chain, "first");
    renumber(solver, chain, longer, 2);
    solve(solver, longer, "reversed and longer");
    solve(solver, longer, "again");
    solver.invalidate();
    solve(solver, longer, "invalidated");
    deallog << "former rows are those of today: "
            << (solver.former_rows().size() == longer.n ? "yes" : "no")
            << std::endl;
  }
  {
    LinearSolver solver(data);
    solve(solver, chain, "first");
    renumber(solver, chain, shorter, -2);
    solve(solver, shorter, "reversed and shorter");
  }
  {
    LinearSolver solver(data);
    solve(solver, chain, "first");
    solve(solver, shorter, "not told");
  }
  deallog.pop();
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mpi_initlog();
  test("MUMPS");
  test("CG+AMG");
}
