// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_assembly_connected_pieces_h
#define ebsmpm_assembly_connected_pieces_h

#include <ebsmpm/assembly/point_groups.h>
#include <ebsmpm/assembly/point_state.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace EBSMPM
{
  /**
   * The pieces into which cracks have cut a body, and how each of them is held.
   *
   * Two functions belong to the same piece if some point reads both, directly
   * or by way of constraints: the pieces are the connected components of the
   * graph of the tangent matrix. A piece whose Dirichlet data leaves it a rigid
   * motion makes the static problem singular; DisplacementSystem gives it a
   * small mass. With the rigid motions $\mathbf r_m$ of a piece, rotations
   * about its centre and divided by its radius of gyration, the free ones are
   * the null space of
   * @f[
   *   M_{mn} = \sum_b A_0\, \mathbf r_m(\mathbf x_b)\cdot\mathbf\Pi\,
   *   \mathbf r_n(\mathbf x_b)
   * @f]
   * over the boundary points of the piece.
   *
   * @code
   * ConnectedPieces<dim> pieces;
   * pieces.reinit(points, state.volume, groups,
   *               boundary_points, boundary, boundary_groups, functions);
   * if (pieces.n_free() > 0)
   *   ...
   * @endcode
   *
   * The result does not depend on the number of processes.
   */
  template <int dim>
  class ConnectedPieces
  {
  public:
    /** A connected part of the body. */
    struct Piece
    {
      /** Its volume. */
      double volume = 0.;

      /** Number of rigid motions that nothing prevents. */
      unsigned int n_free_motions = 0;
    };

    /**
     * Find the pieces. Collective.
     *
     * @param points, @p volumes, @p groups the material points
     * @param boundary_points, @p boundary, @p boundary_groups the boundary
     *   points; BoundaryState::projection says what is prescribed
     * @param functions the partitioner of a scalar problem on the space, with
     *   which the groups were made
     */
    void
    reinit(const CellPoints<dim>     &points,
           const std::vector<double> &volumes,
           const PointGroups<dim>    &groups,
           const CellPoints<dim>     &boundary_points,
           const BoundaryState<dim>  &boundary,
           const PointGroups<dim>    &boundary_groups,
           const std::shared_ptr<const Utilities::MPI::Partitioner> &functions);

    /** Forget all pieces: none is free. */
    void
    clear();

    /** All pieces, the largest one first; the same on all processes. */
    const std::vector<Piece> &
    pieces() const;

    /** Number of pieces that can move without resistance. */
    unsigned int
    n_free() const;

    /** Whether group number @p g of the material points is in such a piece. */
    bool
    is_free(const unsigned int g) const;

    /**
     * Return $\sum_m\mathbf r_m(\mathbf x)\otimes\mathbf r_m(\mathbf x)$, where
     * $\mathbf r_m$ is an orthonormal basis of the rigid motions that nothing
     * prevents of the piece of group @p g of the material points: what projects
     * a displacement on where the piece can go. Only if is_free().
     */
    SymmetricTensor<2, dim>
    free_directions(const unsigned int g, const Point<dim> &x) const;

  private:
    /**
     * Where the material of a piece is, how far it reaches, and, in columns,
     * the combinations of rigid motions about its centre that nothing prevents.
     */
    struct Moments
    {
      double             volume = 0.;
      Point<dim>         centre;
      double             radius = 1.;
      FullMatrix<double> free_motions;
    };

    /**
     * Give each function the smallest index of any function that it is
     * connected with.
     */
    static std::vector<double>
    connect(
      const std::vector<const PointGroups<dim> *>              &all_groups,
      const std::shared_ptr<const Utilities::MPI::Partitioner> &functions);

    /** Return the number of piece that each group is in. */
    static std::vector<unsigned int>
    pieces_of_groups(const PointGroups<dim>    &groups,
                     const std::vector<double> &labels,
                     const std::vector<double> &all_labels);

    /** Find the motions that the Dirichlet data permits. */
    void
    find_free_motions(const CellPoints<dim>           &boundary_points,
                      const BoundaryState<dim>        &boundary,
                      const PointGroups<dim>          &boundary_groups,
                      const std::vector<unsigned int> &piece_of_group,
                      const MPI_Comm                  &communicator);

    std::vector<Piece> piece_list;

    /** More about each piece, in the order of #piece_numbers. */
    std::vector<Moments> moments;

    /** The piece of each group; empty if none is free. */
    std::vector<unsigned int> piece_numbers;
  };
} // namespace EBSMPM

#endif
