// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------


// Newton's method on problems of one unknown, or of several copies of it, each
// of which is an excuse of the load steps for not converging: a stiff kink, a
// residual that jumps over its root, states that do not exist, a tangent with
// the wrong sign, a start that is far away.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/solvers/line_search.h>
#include <ebsmpm/solvers/newton_solver.h>

#include <deal.II/base/index_set.h>

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string>

#include "../tests.h"



/** Residual and tangent, entry by entry. */
struct Scalar
{
  std::function<double(const double)> residual;
  std::function<double(const double)> tangent;
};



/** The functions as a problem with a diagonal matrix. */
class Diagonal
{
public:
  explicit Diagonal(const Scalar &functions_)
    : functions(functions_)
    , rows(complete_index_set(n))
  {
    LA::SparsityPattern pattern(rows, MPI_COMM_WORLD);
    for (unsigned int i = 0; i < n; ++i)
      pattern.add(i, i);
    pattern.compress();
    matrix.reinit(pattern);

    problem.residual = [this](const LA::FieldVector &x, LA::FieldVector &r) {
      for (unsigned int i = 0; i < n; ++i)
        r(i) = functions.residual(x(i));
      ++n_residuals;
    };
    problem.tangent = [this](const LA::FieldVector &x, LA::FieldVector &r) {
      assemble(functions.tangent, x, r);
    };
    problem.matrix = [this]() -> const LA::SparseMatrix & { return matrix; };
  }

  /** Use another tangent in the first iteration. */
  void
  set_predictor(const std::function<double(const double)> &predictor)
  {
    problem.predictor = [this, predictor](const LA::FieldVector &x,
                                          LA::FieldVector       &r) {
      deallog << "  predictor" << std::endl;
      assemble(predictor, x, r);
    };
  }

  /** Go on with other functions once the iteration goes in circles. */
  void
  set_smooth(const std::function<Scalar(const double)> &hold)
  {
    problem.smooth = [this, hold](const LA::FieldVector &x) {
      functions = hold(x(0));
    };
  }

  void
  solve(const std::string         &name,
        const double               start,
        const std::vector<double> &solutions)
  {
    deallog << name << std::endl;
    LA::FieldVector x(rows, MPI_COMM_WORLD);
    x = start;
    LinearSolver linear_solver;
    n_residuals = n_tangents = 0;
    try
      {
        const auto report =
          NewtonSolver().solve(problem, linear_solver, 1., 1e-11, x);
        bool found = false;
        for (const double solution : solutions)
          found = found || std::abs(x(0) - solution) < 1e-9;
        bool same = true;
        for (unsigned int i = 1; i < n; ++i)
          same = same && x(i) == x(0);
        deallog << "  x = " << x(0) << (found ? "" : " WRONG")
                << (same ? "" : " NOT THE SAME IN ALL ENTRIES")
                << ", iterations " << report.iterations << ", residuals "
                << n_residuals << ", with tangent " << n_tangents
                << ", bisections " << report.bisections
                << (report.indefinite ? ", indefinite" : "")
                << (report.indefinite_at_end ? ", also at the end" : "")
                << (report.smoothed ? ", smoothed" : "") << std::endl;
        residuals = report.residuals;
      }
    catch (const ExcSolverFailure &exception)
      {
        std::ostringstream message;
        exception.print_info(message);
        std::string text = message.str();
        text.erase(0, text.find_first_not_of(" \n"));
        text.erase(std::min(text.find(":"), text.find_last_not_of(" \n") + 1));
        deallog << "  " << text << std::endl;
      }
  }

  /** Is every residual less than C times the square of the last one? */
  std::string
  order(const double C) const
  {
    for (unsigned int k = 1; k < residuals.size(); ++k)
      if (residuals[k] >
          std::max(C * residuals[k - 1] * residuals[k - 1], 1e-13))
        return "NOT quadratic";
    return "quadratic";
  }

private:
  void
  assemble(const std::function<double(const double)> &derivative,
           const LA::FieldVector                     &x,
           LA::FieldVector                           &r)
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        r(i) = functions.residual(x(i));
        matrix.set(i, i, derivative(x(i)));
      }
    matrix.compress(VectorOperation::insert);
    ++n_tangents;
  }

  static constexpr unsigned int n = 4;

  Scalar                functions;
  const IndexSet        rows;
  LA::SparseMatrix      matrix;
  NewtonSolver::Problem problem;
  unsigned int          n_residuals = 0;
  unsigned int          n_tangents  = 0;
  std::vector<double>   residuals;
};



/** The line search alone, where the residual is a number, along the line. */
void
search(const std::string                         &name,
       const std::function<double(const double)> &residual,
       const unsigned int                         max_bisections = 8)
{
  const auto evaluate = [&](const double step) {
    LineSearch::Trial trial;
    trial.step  = step;
    trial.slope = residual(step);
    trial.norm  = std::abs(trial.slope);
    return trial;
  };
  LineSearch line(max_bisections, evaluate);
  const auto start = evaluate(0.);
  const auto best  = line.search(start, 1.5 * start.norm, 1e-6);
  deallog << "line search, " << name << ": ";
  if (std::isfinite(best.norm))
    deallog << "step " << best.step << ", residual " << best.norm << " of "
            << start.norm;
  else
    deallog << "no step";
  deallog << ", " << line.n_trials() << " trials" << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  initlog();

  {
    const double infinity = std::numeric_limits<double>::infinity();
    search("full step", [](const double s) { return s - 0.9; });
    search("too short", [](const double s) { return 0.1 * s - 0.9; });
    search("increase that is allowed",
           [](const double s) { return 2.4 * s - 1.; });
    search("kink",
           [](const double s) { return (s < 0.1 ? 10. : 1e3) * (s - 0.1); });
    search(
      "jump", [](const double s) { return s < 0.7 ? -1. : 2. + s; }, 4);
    search("limit",
           [=](const double s) { return s < 0.3 ? s - 0.4 : infinity; });
    search("next to a limit",
           [=](const double s) { return s < 1e-4 ? s - 0.4 : infinity; });
    search("uphill", [](const double s) { return 1. - 2. * s + 10. * s * s; });
  }

  {
    Diagonal smooth(Scalar{[](const double x) { return x + x * x * x - 0.3; },
                           [](const double x) { return 1. + 3. * x * x; }});
    smooth.solve("smooth", 0., {0.2784179903218099});
    deallog << "  " << smooth.order(1.) << std::endl;
  }

  // Soft on one side of zero and stiff on the other, and the root on the
  // stiff one: from the soft side, the full step goes a thousand times too far.
  {
    const double k = 1e3;
    Diagonal     kink(
      Scalar{[=](const double x) { return (x < 0. ? x : k * x) - 0.1; },
             [=](const double x) { return x < 0. ? 1. : k; }});
    kink.solve("kink, from the soft side", -1., {1e-4});
    kink.solve("kink, from the stiff side", 1., {1e-4});
  }

  // There is no root: the residual jumps from -1 to +1 at zero. On either
  // branch, held, there is one.
  {
    const auto branch = [](const double sign) {
      return Scalar{[=](const double x) { return x + sign; },
                    [](const double) { return 1.; }};
    };
    const Scalar jumping{[](const double x) { return x + (x < 0. ? -1. : 1.); },
                         [](const double) { return 1.; }};
    Diagonal     jump(jumping);
    jump.solve("no root", 0.7, {});
    jump.set_smooth([&](const double x) { return branch(x < 0. ? -1. : 1.); });
    jump.solve("no root, but branches to hold", 0.7, {-1., 1.});
  }

  // The residual does not exist beyond a limit; the full step leads there.
  {
    const auto limited = [](const double limit) {
      return [limit](const double x) {
        AssertThrow(x < limit, ExcSolverFailure("beyond the limit"));
        return x < 0.5 ? 0.5 * x - 1. : 9.5 * x - 5.5;
      };
    };
    const auto tangent = [](const double x) { return x < 0.5 ? 0.5 : 9.5; };
    Diagonal(Scalar{limited(0.8), tangent}).solve("limit", 0., {11. / 19.});
    Diagonal(Scalar{limited(-0.1), tangent})
      .solve("limit at the start", 0., {});
    Diagonal(Scalar{limited(1e-4), tangent}).solve("limit next to it", 0., {});
  }

  // Two stable states and an unstable one between them.
  {
    Diagonal wells(Scalar{[](const double x) { return x * x * x - x; },
                          [](const double x) { return 3. * x * x - 1.; }});
    wells.solve("next to the unstable state", 0.1, {0.});
    wells.solve("next to a stable state", 0.8, {1.});
  }

  // Far from the root the tangent misleads, the predictor knows better.
  {
    Diagonal far(
      Scalar{[](const double x) { return std::atan(x - 5.); },
             [](const double x) { return 1. / (1. + (x - 5.) * (x - 5.)); }});
    far.set_predictor([](const double) { return 0.27; });
    far.solve("far away, with a predictor", 0., {5.});
  }

  // What never converges says so.
  Diagonal(Scalar{[](const double x) { return 1. + x * x; },
                  [](const double x) { return 2. * x; }})
    .solve("no root at all", 0.5, {});
}
