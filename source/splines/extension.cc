// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/compat.h>

#include <ebsmpm/splines/extension.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace EBSMPM
{
  namespace internal
  {
    namespace ExtensionImplementation
    {
      /**
       * How far the window of candidates reaches beyond the blocks that contain
       * or touch the function: the first attempt, and the following ones.
       * Beyond the last, a block of lower degree nearby is the better choice.
       */
      const std::array<int, 2> reaches = {{2, 4}};



      /**
       * The weights of the Lagrange polynomials on the nodes $0,\ldots,q$ at
       * the integer position @p x.
       */
      std::array<double, 4>
      lagrange_weights(const int q, const int x)
      {
        std::array<double, 4> weights{};
        for (int i = 0; i <= q; ++i)
          {
            weights[i] = 1.;
            for (int m = 0; m <= q; ++m)
              if (m != i)
                weights[i] *= static_cast<double>(x - m) / (i - m);
          }
        return weights;
      }



      double
      lebesgue(const int q, const int x)
      {
        double sum = 0.;
        for (const double w : lagrange_weights(q, x))
          sum += std::abs(w);
        return sum;
      }



      /**
       * The functions around a dependent one, as a box of flags and indices in
       * which blocks are looked for.
       */
      template <int dim>
      class Window
      {
      public:
        using Space = SplineSpace<dim>;
        using Key   = FunctionKey<dim>;
        using Index = typename CartesianLattice<dim>::Index;

        /** A block of functions, as the offset of its lower corner from J. */
        struct Block
        {
          Index  offset{};
          double lebesgue = std::numeric_limits<double>::max();
          int    distance = std::numeric_limits<int>::max();
          bool   found    = false;
        };

        Window(const Key &center, const int radius)
          : center(center)
          , radius(radius)
          , width(2 * radius + 1)
          , n(Utilities::pow(static_cast<unsigned int>(width), dim))
        {}

        /** Number of functions in the window. */
        unsigned int
        size() const
        {
          return n;
        }

        /** Where the i-th function of the window is, relative to J. */
        Index
        offset(const unsigned int i) const
        {
          Index result;
          for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= width)
            result[d] = static_cast<int>(rest % width) - radius;
          return result;
        }

        /** The i-th function in the window. */
        Key
        key(const unsigned int i) const
        {
          Key         result = center;
          const Index from_J = offset(i);
          result.part        = 0;
          for (unsigned int d = 0; d < dim; ++d)
            result.index[d] += from_J[d];
          return result;
        }

        /**
         * Find the best complete block of degree @p q among the functions
         * flagged in @p admissible.
         */
        Block
        best_block(const std::vector<char> &admissible, const int q) const
        {
          Block              best;
          const int          n_corners = width - q;
          const unsigned int n_blocks =
            Utilities::pow(static_cast<unsigned int>(std::max(n_corners, 0)),
                           dim);
          for (unsigned int b = 0; b < n_blocks; ++b)
            {
              // Everything relative to the centre of the window, where J is.
              Block block;
              block.lebesgue = 1.;
              block.distance = 0;
              for (unsigned int d = 0, rest = b; d < dim;
                   ++d, rest /= n_corners)
                {
                  block.offset[d] = static_cast<int>(rest % n_corners) - radius;
                  block.lebesgue *= lebesgue(q, -block.offset[d]);
                  const int twice_distance = 2 * block.offset[d] + q;
                  block.distance += twice_distance * twice_distance;
                }

              // Lexicographic order of the blocks is the order of their keys,
              // so that the first among equals stays.
              const bool better =
                block.lebesgue < best.lebesgue * (1. - 1e-9) ||
                (block.lebesgue < best.lebesgue * (1. + 1e-9) &&
                 block.distance < best.distance);
              if (better && is_complete(block.offset, q, admissible))
                {
                  best       = block;
                  best.found = true;
                }
            }
          return best;
        }

        /** The position in the window of the i-th function of a block. */
        unsigned int
        position(const Index &offset, const int q, const unsigned int i) const
        {
          unsigned int result = 0, stride = 1;
          for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= q + 1)
            {
              result += stride * (offset[d] + radius + rest % (q + 1));
              stride *= width;
            }
          return result;
        }

      private:
        bool
        is_complete(const Index             &offset,
                    const int                q,
                    const std::vector<char> &admissible) const
        {
          const unsigned int n_in_block =
            Utilities::pow(static_cast<unsigned int>(q + 1), dim);
          for (unsigned int i = 0; i < n_in_block; ++i)
            if (!admissible[position(offset, q, i)])
              return false;
          return true;
        }

        const Key          center;
        const int          radius;
        const int          width;
        const unsigned int n;
      };



      /**
       * How many cells a function may lie ahead and still be on this side of
       * the crack. It is no projection that simple angles have, for the same
       * functions must be found whatever round-off there is in side vectors.
       */
      constexpr double slack = 0.4;



      /**
       * Whether a function is on the side of a crack that @p wanted, a unit
       * vector or zero, points from, to the crack: if its own side vector
       * points there, too, or, in lack of one, if it does not lie ahead.
       *
       * @param offset of the function from the one that depends on it
       */
      template <std::size_t dim>
      bool
      is_on_side(const std::array<double, dim>       &side,
                 const std::array<std::int32_t, dim> &offset,
                 const std::array<double, dim>       &wanted)
      {
        double parallel = 0., ahead = 0., length = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            parallel += side[d] * wanted[d];
            ahead += offset[d] * wanted[d];
            length += std::abs(side[d]);
          }
        return length > 0. ? parallel >= 0. : ahead <= slack;
      }



      template <int dim>
      std::string
      position_of(const SplineSpace<dim> &space, const FunctionKey<dim> &key)
      {
        std::ostringstream out;
        out << space.lattice().greville_point(key, space.degree());
        return out.str();
      }
    } // namespace ExtensionImplementation
  }   // namespace internal



  template <int dim>
  ExtensionReport
  make_extension_constraints(const SplineSpace<dim>    &space,
                             AffineConstraints<double> &constraints)
  {
    using namespace internal::ExtensionImplementation;
    using Space = SplineSpace<dim>;
    using Key   = FunctionKey<dim>;

    const int p = space.degree();

    // The lines found so far. They go into 'constraints' at the end, when we
    // know which functions of other processes they refer to.
    std::vector<
      std::pair<types::global_dof_index,
                std::vector<std::pair<types::global_dof_index, double>>>>
      lines;

    // The dependent functions, in an order that is always the same.
    std::vector<Key> pending;
    for (const auto &entry : space.functions())
      if (entry.second.category != Space::FunctionClass::standard)
        pending.push_back(entry.first);
    std::sort(pending.begin(), pending.end());

    types::global_dof_index n_lower_degree = 0, n_nearest = 0, n_wrong_side = 0;
    double                  max_lebesgue = 1.;

    // What we know of functions that this process does not see itself.
    typename Space::FunctionTable remote;

    // Try to find a block for function J: of the highest degree down to
    // 'lowest_degree', and on the right side unless that is to be ignored.
    const auto try_to_constrain = [&](const Key &J,
                                      const int  reach,
                                      const int  lowest_degree,
                                      const bool ignore_side) {
      const Window<dim>               window(J, p + reach);
      const typename Space::Function &function = *space.find(J);

      auto wanted = function.side;
      if (function.category == Space::FunctionClass::twin)
        for (double &component : wanted)
          component *= -1.;

      std::vector<char>                    admissible(window.size(), 0);
      std::vector<types::global_dof_index> indices(window.size());
      for (unsigned int i = 0; i < window.size(); ++i)
        {
          const Key                       key   = window.key(i);
          const typename Space::Function *known = space.find(key);
          if (known == nullptr)
            {
              const auto found = remote.find(key);
              if (found != remote.end())
                known = &found->second;
            }
          if (known != nullptr &&
              known->category == Space::FunctionClass::standard &&
              (ignore_side ||
               is_on_side(known->side, window.offset(i), wanted)))
            {
              admissible[i] = 1;
              indices[i]    = known->index;
            }
        }

      for (int q = p; q >= lowest_degree; --q)
        {
          const auto block = window.best_block(admissible, q);
          if (!block.found)
            continue;

          lines.emplace_back();
          lines.back().first = function.index;
          const unsigned int n_in_block =
            Utilities::pow(static_cast<unsigned int>(q + 1), dim);
          for (unsigned int i = 0; i < n_in_block; ++i)
            {
              double weight = 1.;
              for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= q + 1)
                weight *= lagrange_weights(q, -block.offset[d])[rest % (q + 1)];
              if (weight != 0.)
                lines.back().second.emplace_back(
                  indices[window.position(block.offset, q, i)], weight);
            }

          // Count every function once, on its owner.
          max_lebesgue = std::max(max_lebesgue, block.lebesgue);
          if (space.locally_owned().is_element(function.index))
            {
              n_lower_degree += (q < p);
              n_nearest += (q == 0);
              n_wrong_side += ignore_side;
            }
          return true;
        }
      return false;
    };

    // Look for complete blocks in wider and wider windows, then for blocks of
    // lower degree in the widest one, then forget about sides. All processes go
    // through the same attempts, because each begins with a collective query.
    struct Attempt
    {
      int  reach;
      int  lowest_degree;
      bool ignore_side;
    };
    const std::array<Attempt, 4> attempts    = {{{reaches[0], p, false},
                                                 {reaches[1], p, false},
                                                 {reaches[1], 0, false},
                                                 {reaches[1], 0, true}}};
    int                          known_reach = -1;
    for (const auto &attempt : attempts)
      {
        if (Utilities::MPI::max(static_cast<unsigned int>(pending.size()),
                                space.communicator()) == 0)
          break;

        if (attempt.reach > known_reach)
          {
            std::vector<Key> unknown;
            for (const auto &J : pending)
              {
                const Window<dim> window(J, p + attempt.reach);
                for (unsigned int i = 0; i < window.size(); ++i)
                  if (space.find(window.key(i)) == nullptr)
                    unknown.push_back(window.key(i));
              }
            std::sort(unknown.begin(), unknown.end());
            unknown.erase(std::unique(unknown.begin(), unknown.end()),
                          unknown.end());
            remote      = space.query(unknown);
            known_reach = attempt.reach;
          }

        std::vector<Key> still_pending;
        for (const auto &J : pending)
          if (!try_to_constrain(
                J, attempt.reach, attempt.lowest_degree, attempt.ignore_side))
            still_pending.push_back(J);
        pending = still_pending;
      }

    // Everybody throws if anybody has to, with the same position.
    const int failing_rank =
      Utilities::MPI::max(pending.empty() ?
                            -1 :
                            static_cast<int>(Utilities::MPI::this_mpi_process(
                              space.communicator())),
                          space.communicator());
    if (failing_rank >= 0)
      {
        const std::string position =
          Utilities::MPI::broadcast(space.communicator(),
                                    pending.empty() ?
                                      std::string() :
                                      position_of(space, pending.front()),
                                    failing_rank);
        AssertThrow(false, ExcNoStandardFunction(position));
      }

    std::vector<types::global_dof_index> entries;
    for (const auto &line : lines)
      for (const auto &entry : line.second)
        entries.push_back(entry.first);
    std::sort(entries.begin(), entries.end());
    IndexSet relevant = space.locally_relevant();
    relevant.add_indices(entries.begin(), entries.end());

    reinit_constraints(constraints, space.locally_owned(), relevant);
    for (const auto &line : lines)
      {
        constraints.add_line(line.first);
        constraints.add_entries(line.first, line.second);
      }
    constraints.close();

    ExtensionReport report;
    report.n_lower_degree =
      Utilities::MPI::sum(n_lower_degree, space.communicator());
    report.n_nearest = Utilities::MPI::sum(n_nearest, space.communicator());
    report.n_wrong_side =
      Utilities::MPI::sum(n_wrong_side, space.communicator());
    report.max_lebesgue =
      Utilities::MPI::max(max_lebesgue, space.communicator());
    return report;
  }



  template ExtensionReport
  make_extension_constraints<1>(const SplineSpace<1> &,
                                AffineConstraints<double> &);
  template ExtensionReport
  make_extension_constraints<2>(const SplineSpace<2> &,
                                AffineConstraints<double> &);
  template ExtensionReport
  make_extension_constraints<3>(const SplineSpace<3> &,
                                AffineConstraints<double> &);
} // namespace EBSMPM
