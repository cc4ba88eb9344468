// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/lac/types.h>

#include <ebsmpm/assembly/connected_pieces.h>
#include <ebsmpm/assembly/rigid_motions.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace EBSMPM
{
  namespace internal
  {
    namespace ConnectedPiecesImplementation
    {
      /**
       * Part of the trace of $M_{mn}$ below which an eigenvalue counts as zero:
       * the square of the ratio of the smallest support to the size of a piece.
       */
      constexpr double free_tolerance = 1e-8;



      /**
       * Return an orthonormal basis of the null space of a symmetric matrix, in
       * columns.
       */
      FullMatrix<double>
      null_space(const FullMatrix<double> &matrix)
      {
        FullMatrix<double> basis;
        const double       trace = matrix.trace();
        if (trace == 0.)
          {
            basis = IdentityMatrix(matrix.m());
            return basis;
          }
        LAPACKFullMatrix<double> scaled(matrix.m());
        scaled = matrix;
        scaled /= trace;
        Vector<double> eigenvalues;
        scaled.compute_eigenvalues_symmetric(
          -1., free_tolerance, 1e-14, eigenvalues, basis);
        return basis;
      }
    } // namespace ConnectedPiecesImplementation
  }   // namespace internal

  using namespace internal::ConnectedPiecesImplementation;



  template <int dim>
  void
  ConnectedPieces<dim>::reinit(
    const CellPoints<dim>                                    &points,
    const std::vector<double>                                &volumes,
    const PointGroups<dim>                                   &groups,
    const CellPoints<dim>                                    &boundary_points,
    const BoundaryState<dim>                                 &boundary,
    const PointGroups<dim>                                   &boundary_groups,
    const std::shared_ptr<const Utilities::MPI::Partitioner> &functions)
  {
    clear();
    const MPI_Comm communicator = functions->get_mpi_communicator();

    // There are few pieces, so that everybody may know them all.
    const std::vector<double> labels =
      connect({&groups, &boundary_groups}, functions);
    std::vector<double> all_labels  = labels;
    const auto          make_unique = [](std::vector<double> &list) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    make_unique(all_labels);
    std::vector<double> merged;
    for (const auto &list :
         Utilities::MPI::all_gather(communicator, all_labels))
      merged.insert(merged.end(), list.begin(), list.end());
    make_unique(merged);

    const auto piece_of_group = pieces_of_groups(groups, labels, merged);
    std::vector<double> sums(merged.size() * (dim + 2), 0.);
    for (unsigned int g = 0; g < groups.groups().size(); ++g)
      {
        const auto &group = groups.groups()[g];
        double     *sum   = sums.data() + piece_of_group[g] * (dim + 2);
        for (unsigned int k = group.begin; k < group.end; ++k)
          {
            const unsigned int q = groups.point(k);
            const Point<dim>  &x = points.location(q);
            sum[0] += volumes[q];
            for (unsigned int d = 0; d < dim; ++d)
              sum[1 + d] += volumes[q] * x[d];
            sum[dim + 1] += volumes[q] * x.square();
          }
      }
    Utilities::MPI::sum(sums, communicator, sums);
    moments.resize(merged.size());
    for (unsigned int i = 0; i < merged.size(); ++i)
      {
        const double *sum = sums.data() + i * (dim + 2);
        moments[i].volume = sum[0];
        if (sum[0] == 0.)
          continue;
        for (unsigned int d = 0; d < dim; ++d)
          moments[i].centre[d] = sum[1 + d] / sum[0];
        // A single point has no extent; any unit of length will do for it.
        const double square = sum[dim + 1] / sum[0];
        const double spread = square - moments[i].centre.square();
        if (spread > 1e-12 * square)
          moments[i].radius = std::sqrt(spread);
      }

    piece_list.resize(merged.size());
    for (unsigned int i = 0; i < merged.size(); ++i)
      piece_list[i].volume = moments[i].volume;
    find_free_motions(boundary_points,
                      boundary,
                      boundary_groups,
                      pieces_of_groups(boundary_groups, labels, merged),
                      communicator);
    if (n_free() > 0)
      piece_numbers = piece_of_group;
    std::stable_sort(piece_list.begin(),
                     piece_list.end(),
                     [](const Piece &a, const Piece &b) {
                       return a.volume > b.volume;
                     });
  }



  template <int dim>
  std::vector<double>
  ConnectedPieces<dim>::connect(
    const std::vector<const PointGroups<dim> *>              &all_groups,
    const std::shared_ptr<const Utilities::MPI::Partitioner> &functions)
  {
    const unsigned int n =
      functions->locally_owned_size() + functions->n_ghost_indices();
    std::vector<unsigned int> rank(n, 0), parent(n);
    std::iota(parent.begin(), parent.end(), 0U);
    boost::disjoint_sets<unsigned int *, unsigned int *> sets(rank.data(),
                                                              parent.data());
    for (const auto *groups : all_groups)
      for (const auto &group : groups->groups())
        for (unsigned int i = 1; i < group.n_functions; ++i)
          sets.union_set(groups->functions(group)[0],
                         groups->functions(group)[i]);

    std::vector<double> smallest(n, std::numeric_limits<double>::max());
    for (unsigned int i = 0; i < n; ++i)
      {
        double &label = smallest[sets.find_set(i)];
        label         = std::min<double>(label, functions->local_to_global(i));
      }

    // Across processes, the smallest index wins; a piece that winds to and fro
    // between processes takes several rounds.
    LA::FieldVector exchange(functions);
    bool            changed = true;
    while (changed)
      {
        exchange.zero_out_ghost_values();
        for (unsigned int i = 0; i < n; ++i)
          exchange.local_element(i) = smallest[sets.find_set(i)];
        exchange.compress(VectorOperation::min);
        exchange.update_ghost_values();
        changed = false;
        for (unsigned int i = 0; i < n; ++i)
          {
            double &label = smallest[sets.find_set(i)];
            if (exchange.local_element(i) < label)
              {
                label   = exchange.local_element(i);
                changed = true;
              }
          }
        changed = Utilities::MPI::max(changed ? 1U : 0U,
                                      functions->get_mpi_communicator()) > 0;
      }

    std::vector<double> labels(n);
    for (unsigned int i = 0; i < n; ++i)
      labels[i] = smallest[sets.find_set(i)];
    return labels;
  }



  template <int dim>
  std::vector<unsigned int>
  ConnectedPieces<dim>::pieces_of_groups(const PointGroups<dim>    &groups,
                                         const std::vector<double> &labels,
                                         const std::vector<double> &all_labels)
  {
    std::vector<unsigned int> result;
    result.reserve(groups.groups().size());
    for (const auto &group : groups.groups())
      result.push_back(std::lower_bound(all_labels.begin(),
                                        all_labels.end(),
                                        labels[groups.functions(group)[0]]) -
                       all_labels.begin());
    return result;
  }



  template <int dim>
  void
  ConnectedPieces<dim>::find_free_motions(
    const CellPoints<dim>           &boundary_points,
    const BoundaryState<dim>        &boundary,
    const PointGroups<dim>          &boundary_groups,
    const std::vector<unsigned int> &piece_of_group,
    const MPI_Comm                  &communicator)
  {
    constexpr unsigned int n_motions = RigidMotions::n<dim>;
    constexpr unsigned int size      = n_motions * n_motions;
    std::vector<double>    sums(moments.size() * size, 0.);
    for (unsigned int g = 0; g < boundary_groups.groups().size(); ++g)
      {
        const auto        &group  = boundary_groups.groups()[g];
        const unsigned int piece  = piece_of_group[g];
        const Moments     &moment = moments[piece];
        double            *sum    = sums.data() + piece * size;
        for (unsigned int k = group.begin; k < group.end; ++k)
          {
            const unsigned int q       = boundary_groups.point(k);
            const auto         motions = RigidMotions::at<dim>(
              (boundary_points.location(q) - moment.centre) / moment.radius);
            for (unsigned int m = 0; m < n_motions; ++m)
              {
                const Tensor<1, dim> prevented =
                  boundary.projection[q] * motions[m];
                for (unsigned int n = 0; n < n_motions; ++n)
                  sum[m * n_motions + n] +=
                    boundary.area[q] * (prevented * motions[n]);
              }
          }
      }
    Utilities::MPI::sum(sums, communicator, sums);
    for (unsigned int i = 0; i < piece_list.size(); ++i)
      {
        moments[i].free_motions = null_space(
          FullMatrix<double>(n_motions, n_motions, sums.data() + i * size));
        piece_list[i].n_free_motions = moments[i].free_motions.n();
      }
  }



  template <int dim>
  void
  ConnectedPieces<dim>::clear()
  {
    piece_list.clear();
    moments.clear();
    piece_numbers.clear();
  }



  template <int dim>
  const std::vector<typename ConnectedPieces<dim>::Piece> &
  ConnectedPieces<dim>::pieces() const
  {
    return piece_list;
  }



  template <int dim>
  unsigned int
  ConnectedPieces<dim>::n_free() const
  {
    return std::count_if(piece_list.begin(),
                         piece_list.end(),
                         [](const Piece &piece) {
                           return piece.n_free_motions > 0;
                         });
  }



  template <int dim>
  bool
  ConnectedPieces<dim>::is_free(const unsigned int g) const
  {
    return !piece_numbers.empty() &&
           moments[piece_numbers[g]].free_motions.n() > 0;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  ConnectedPieces<dim>::free_directions(const unsigned int g,
                                        const Point<dim>  &x) const
  {
    const Moments &piece = moments[piece_numbers[g]];
    const auto     motions =
      RigidMotions::at<dim>((x - piece.centre) / piece.radius);
    SymmetricTensor<2, dim> result;
    for (unsigned int i = 0; i < piece.free_motions.n(); ++i)
      {
        Tensor<1, dim> motion;
        for (unsigned int m = 0; m < motions.size(); ++m)
          motion += piece.free_motions(m, i) * motions[m];
        result += symmetrize(outer_product(motion, motion));
      }
    return result;
  }



  template class ConnectedPieces<2>;
  template class ConnectedPieces<3>;
} // namespace EBSMPM
