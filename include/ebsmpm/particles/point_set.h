// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_point_set_h
#define ebsmpm_particles_point_set_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/particles/cell_locator.h>

#include <deal.II/base/mpi.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/grid/tria.h>

#include <deal.II/particles/particle_handler.h>

#include <vector>

namespace EBSMPM
{
  /**
   * Points with properties on a distributed grid: what MaterialPoints and
   * BoundaryPoints have in common. @p View is MaterialPoint<dim> or
   * BoundaryPoint<dim>.
   *
   * The points are the particles of a Particles::ParticleHandler, which stores
   * them cell by cell and can be used directly for everything that does not
   * create, remove or move points between cells. This class does the latter, in
   * such a way that nothing depends on the number of processes:
   * <ul>
   * <li>The numbers (ids) of the points count through the cells in the order of
   * the space-filling curve by which p4est distributes them, beginning at zero
   * without gaps.</li>
   * <li>A point on a face belongs to one definite cell, see CellLocator.</li>
   * <li>Within a cell, the points are in the order of their numbers, so that
   * sums over a cell come out the same to the last digit.</li>
   * <li>A point may move over any number of cells and processes in one step,
   * and if it leaves the grid, all processes learn of it.</li>
   * </ul>
   *
   * The grid must consist of axis-parallel boxes, on a
   * parallel::distributed::Triangulation or a serial Triangulation.
   *
   * Cost: sort() looks at every point once, and moves those that have left
   * their cells; the order of 0.1 s for a million points.
   */
  template <int dim, typename View>
  class PointSet
  {
  public:
    using cell_iterator = typename Triangulation<dim>::active_cell_iterator;

    /**
     * Constructor. Collective. Both arguments must live longer than this
     * object.
     */
    PointSet(const Triangulation<dim> &triangulation,
             const Mapping<dim>       &mapping);

    /**
     * Return the particles.
     */
    Particles::ParticleHandler<dim> &
    handler();

    /**
     * Return the particles.
     */
    const Particles::ParticleHandler<dim> &
    handler() const;

    /**
     * Return the grid.
     */
    const Triangulation<dim> &
    triangulation() const;

    /**
     * Return the object that finds cells. Call its CellLocator::update() first
     * if the grid may have changed.
     */
    CellLocator<dim> &
    locator();

    /**
     * Return the position that decides about the cell of a point: a tiny step
     * from the point into the search direction of its View.
     */
    Point<dim>
    search_position(const Point<dim>     &location,
                    const Tensor<1, dim> &search_direction) const;

    /**
     * Put every point into the cell where it is now, and onto the process that
     * owns the cell, and set its reference position. To be called on all
     * processes, after positions were changed.
     *
     * If a point is outside of the grid, ExcPointOutsideGrid is thrown on all
     * processes and names the one with the smallest number. All points are
     * still there, with the positions they were given and in the cells they
     * were in before, so that one can restore the positions and go on.
     */
    void
    sort();

    /**
     * To be called before, and after, the cells of a distributed grid are given
     * to other processes: the points go with their cells. In between, there are
     * no points that could be looked at. Collective.
     */
    void
    prepare_for_repartitioning();

    void
    finish_repartitioning();

    /**
     * To be called before Triangulation::save(), which then writes the points
     * with the grid, and after Triangulation::load(), which reads them, on any
     * number of processes. Several sets on the same grid must be told in the
     * same order in both cases. Collective.
     */
    void
    prepare_for_serialization();

    void
    deserialize();

    /**
     * Make this set a copy of another one on the same grid, for instance to
     * return to an earlier state. Collective.
     */
    void
    copy_from(const PointSet<dim, View> &other);

    /**
     * Return the number of points on all processes.
     */
    types::particle_index
    n_global() const;

    /**
     * Return the number of points on this process.
     */
    types::particle_index
    n_locally_owned() const;

  protected:
    /**
     * A new point.
     */
    struct NewPoint
    {
      Point<dim>    location;
      cell_iterator cell;
    };

    /**
     * Create points in locally owned cells, with numbers that follow those of
     * the points that exist already. @p set_properties(i, view) is to set the
     * properties of the point with index i. Collective.
     */
    template <typename SetProperties>
    void
    create(const std::vector<NewPoint> &points,
           const SetProperties         &set_properties);

  private:
    using particle_iterator =
      typename Particles::ParticleHandler<dim>::particle_iterator;

    /**
     * Return the numbers of new points, whose cells are given.
     */
    std::vector<types::particle_index>
    number_along_curve(const std::vector<NewPoint> &points,
                       std::vector<unsigned int>   &order) const;

    /**
     * Put points that deal.II has unpacked into the order they had.
     */
    void
    restore_order();

    /**
     * Put the points of a cell into the order of their numbers.
     */
    void
    sort_within_cell(const cell_iterator &cell);

    const Triangulation<dim>       &tria;
    CellLocator<dim>                cell_locator;
    Particles::ParticleHandler<dim> particle_handler;

    /**
     * Work space of sort_within_cell().
     */
    std::vector<particle_iterator> scratch;
  };



  // ----------------------- inline and template functions --------------------



  template <int dim, typename View>
  inline Particles::ParticleHandler<dim> &
  PointSet<dim, View>::handler()
  {
    return particle_handler;
  }



  template <int dim, typename View>
  inline const Particles::ParticleHandler<dim> &
  PointSet<dim, View>::handler() const
  {
    return particle_handler;
  }



  template <int dim, typename View>
  inline const Triangulation<dim> &
  PointSet<dim, View>::triangulation() const
  {
    return tria;
  }



  template <int dim, typename View>
  inline CellLocator<dim> &
  PointSet<dim, View>::locator()
  {
    return cell_locator;
  }



  template <int dim, typename View>
  inline Point<dim>
  PointSet<dim, View>::search_position(
    const Point<dim>     &location,
    const Tensor<1, dim> &search_direction) const
  {
    // Clearly more than the tolerance itself.
    return location + 100. * cell_locator.tolerance() * search_direction;
  }



  template <int dim, typename View>
  inline types::particle_index
  PointSet<dim, View>::n_global() const
  {
    return particle_handler.n_global_particles();
  }



  template <int dim, typename View>
  inline types::particle_index
  PointSet<dim, View>::n_locally_owned() const
  {
    return particle_handler.n_locally_owned_particles();
  }



  template <int dim, typename View>
  template <typename SetProperties>
  void
  PointSet<dim, View>::create(const std::vector<NewPoint> &points,
                              const SetProperties         &set_properties)
  {
    cell_locator.update();

    std::vector<unsigned int>                order;
    const std::vector<types::particle_index> ids =
      number_along_curve(points, order);

    // In the order of the cells, so that neighbors are close in memory.
    particle_handler.reserve(n_locally_owned() + points.size());
    std::vector<double> properties(View::n_properties);
    View                view(make_array_view(properties));
    for (const unsigned int i : order)
      {
        const NewPoint &point = points[i];
        set_properties(i, view);
        particle_handler.insert_particle(
          point.location,
          cell_locator.box(point.cell).to_unit(point.location),
          ids[i],
          point.cell,
          ArrayView<const double>(properties.data(), properties.size()));
      }
    particle_handler.update_cached_numbers();
  }
} // namespace EBSMPM

#endif
