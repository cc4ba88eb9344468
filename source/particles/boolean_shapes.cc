// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/particles/boolean_shapes.h>

#include <algorithm>

namespace EBSMPM
{
  namespace
  {
    // The common part of two boxes; a single point if there is none.
    template <int dim>
    BoundingBox<dim>
    intersect(const BoundingBox<dim> &a, const BoundingBox<dim> &b)
    {
      Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::max(a.lower_bound(d), b.lower_bound(d));
          upper[d] =
            std::max(lower[d], std::min(a.upper_bound(d), b.upper_bound(d)));
        }
      return BoundingBox<dim>(std::make_pair(lower, upper));
    }



    // In how many pieces per direction an element that has to be cut is
    // examined: the smallest detail of the other body that is seen.
    template <int dim>
    constexpr unsigned int n_samples = (dim == 2 ? 16 : 8);



    // The point of an element with coordinates from -1 to 1.
    template <int dim>
    Point<dim>
    point_on(const BoundaryElement<dim>        &element,
             const std::array<double, dim - 1> &xi)
    {
      Point<dim> p = element.midpoint;
      for (unsigned int d = 0; d < dim - 1; ++d)
        p += xi[d] * element.half_axes[d];
      return p;
    }



    // Find, between a point that is kept and one that is not, where the one
    // becomes the other.
    template <int dim, typename Predicate>
    double
    bisect(std::array<double, dim - 1> xi,
           const unsigned int          direction,
           double                      kept,
           double                      dropped,
           const Predicate            &keep)
    {
      while (std::abs(kept - dropped) > 1e-12)
        {
          xi[direction]               = 0.5 * (kept + dropped);
          (keep(xi) ? kept : dropped) = xi[direction];
        }
      return kept;
    }



    // Add the part of an element with lower <= xi <= upper.
    template <int dim>
    void
    add_part(const BoundaryElement<dim>        &element,
             const std::array<double, dim - 1> &lower,
             const std::array<double, dim - 1> &upper,
             std::vector<BoundaryElement<dim>> &elements)
    {
      BoundaryElement<dim>        part = element;
      std::array<double, dim - 1> xi;
      for (unsigned int d = 0; d < dim - 1; ++d)
        {
          xi[d] = 0.5 * (lower[d] + upper[d]);
          part.half_axes[d] *= 0.5 * (upper[d] - lower[d]);
          part.area *= 0.5 * (upper[d] - lower[d]);
        }
      part.midpoint = point_on(element, xi);
      if (part.area > 1e-6 * element.area)
        elements.push_back(part);
    }



    // A cut segment: every run of samples that are kept, with the exact ends.
    template <typename Predicate>
    void
    cut(const BoundaryElement<2>        &element,
        const Predicate                 &keep,
        std::vector<BoundaryElement<2>> &elements)
    {
      constexpr unsigned int n = n_samples<2>;
      const auto sample = [](const int i) { return -1. + (2. * i + 1.) / n; };
      std::array<bool, n> kept;
      for (unsigned int i = 0; i < n; ++i)
        kept[i] = keep({{sample(i)}});

      for (unsigned int begin = 0; begin < n; ++begin)
        if (kept[begin] && (begin == 0 || !kept[begin - 1]))
          {
            unsigned int end = begin;
            while (end + 1 < n && kept[end + 1])
              ++end;
            const std::array<double, 1> lower = {
              {begin == 0 && keep({{-1. + 1e-6}}) ?
                 -1. :
                 bisect<2>(
                   {}, 0, sample(begin), sample(int(begin) - 1), keep)}};
            const std::array<double, 1> upper = {
              {end == n - 1 && keep({{1. - 1e-6}}) ?
                 1. :
                 bisect<2>({}, 0, sample(end), sample(end + 1), keep)}};
            add_part(element, lower, upper, elements);
          }
    }



    // A cut parallelogram. If the samples that are kept form a rectangle, the
    // cuts are parallel to the sides, and their exact position can be found as
    // in 2d. Otherwise count the samples.
    template <typename Predicate>
    void
    cut(const BoundaryElement<3>        &element,
        const Predicate                 &keep,
        std::vector<BoundaryElement<3>> &elements)
    {
      constexpr unsigned int n = n_samples<3>;
      const auto sample = [](const int i) { return -1. + (2. * i + 1.) / n; };

      unsigned int          n_kept = 0;
      std::array<int, 2>    first  = {{n, n}};
      std::array<int, 2>    last   = {{-1, -1}};
      std::array<double, 2> center = {{0, 0}};
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          if (keep({{sample(i), sample(j)}}))
            {
              ++n_kept;
              const std::array<unsigned int, 2> index = {{i, j}};
              for (unsigned int d = 0; d < 2; ++d)
                {
                  first[d] = std::min<int>(first[d], index[d]);
                  last[d]  = std::max<int>(last[d], index[d]);
                  center[d] += sample(index[d]);
                }
            }
      if (n_kept == 0)
        return;

      for (unsigned int d = 0; d < 2; ++d)
        center[d] /= n_kept;

      if (static_cast<int>(n_kept) ==
          (last[0] - first[0] + 1) * (last[1] - first[1] + 1))
        {
          std::array<double, 2> lower, upper;
          for (unsigned int d = 0; d < 2; ++d)
            {
              std::array<double, 2> xi = {{sample(first[0]), sample(first[1])}};
              xi[1 - d] = sample((first[1 - d] + last[1 - d]) / 2);
              xi[d]     = -1. + 1e-6;
              lower[d]  = first[d] == 0 && keep(xi) ?
                            -1. :
                            bisect<3>(xi,
                                     d,
                                     sample(first[d]),
                                     sample(first[d] - 1),
                                     keep);
              xi[d]     = 1. - 1e-6;
              upper[d] =
                last[d] == n - 1 && keep(xi) ?
                  1. :
                  bisect<3>(xi, d, sample(last[d]), sample(last[d] + 1), keep);
            }
          add_part(element, lower, upper, elements);
        }
      else
        {
          BoundaryElement<3> part = element;
          part.midpoint           = point_on(element, center);
          part.area *= static_cast<double>(n_kept) / (n * n);
          // What is left has no sides that could be cut again.
          part.half_axes = {};
          elements.push_back(part);
        }
    }
  } // namespace



  template <int dim>
  BooleanShape<dim>::BooleanShape(const std::shared_ptr<const Shape<dim>> &a,
                                  const std::shared_ptr<const Shape<dim>> &b)
    : a(a)
    , b(b)
  {}



  template <int dim>
  double
  BooleanShape<dim>::orientation_of_b() const
  {
    return 1.;
  }



  template <int dim>
  std::vector<BoundaryElement<dim>>
  BooleanShape<dim>::boundary_elements(const double            spacing,
                                       const BoundingBox<dim> &window) const
  {
    // Only what is inside of the box around the combination can be part of its
    // surface, which makes the surface of a half space finite.
    const BoundingBox<dim> box = intersect(window, this->bounding_box());

    std::vector<BoundaryElement<dim>> elements;
    add_elements(Origin::a,
                 spacing,
                 a->boundary_elements(spacing, box),
                 elements);
    add_elements(Origin::b,
                 spacing,
                 b->boundary_elements(spacing, box),
                 elements);
    return elements;
  }



  template <int dim>
  void
  BooleanShape<dim>::add_elements(
    const Origin                             origin,
    const double                             spacing,
    const std::vector<BoundaryElement<dim>> &candidates,
    std::vector<BoundaryElement<dim>>       &elements) const
  {
    const Shape<dim> &other  = (origin == Origin::a ? *b : *a);
    const double orientation = (origin == Origin::a ? 1. : orientation_of_b());
    const double step        = 1e-5 * spacing;

    for (BoundaryElement<dim> element : candidates)
      {
        const auto keep_point = [&](const std::array<double, dim - 1> &xi) {
          const Point<dim> p = point_on(element, xi);
          return keep(origin,
                      other.contains(p - step * element.normal),
                      other.contains(p + step * element.normal));
        };

        const bool keep_midpoint = keep_point({});

        // Look at the corners, but not right there: cuts often run exactly
        // along the sides of elements.
        bool is_cut = false;
        if (element.half_axes[0].norm_square() > 0)
          for (unsigned int v = 0; v < (1 << (dim - 1)); ++v)
            {
              std::array<double, dim - 1> xi;
              for (unsigned int d = 0; d < dim - 1; ++d)
                xi[d] = ((v >> d) & 1 ? 1. : -1.) * (1. - 1e-6);
              is_cut = is_cut || (keep_point(xi) != keep_midpoint);
            }

        const std::size_t n_before = elements.size();
        if (is_cut)
          cut(element, keep_point, elements);
        else if (keep_midpoint)
          elements.push_back(element);
        for (std::size_t i = n_before; i < elements.size(); ++i)
          elements[i].normal *= orientation;
      }
  }



  template <int dim>
  bool
  UnionShape<dim>::contains(const Point<dim> &p) const
  {
    return this->a->contains(p) || this->b->contains(p);
  }



  template <int dim>
  BoundingBox<dim>
  UnionShape<dim>::bounding_box() const
  {
    BoundingBox<dim> box = this->a->bounding_box();
    box.merge_with(this->b->bounding_box());
    return box;
  }



  template <int dim>
  bool
  UnionShape<dim>::keep(const typename BooleanShape<dim>::Origin origin,
                        const bool                               inside,
                        const bool                               outside) const
  {
    return !outside && (origin == BooleanShape<dim>::Origin::a || !inside);
  }



  template <int dim>
  bool
  IntersectionShape<dim>::contains(const Point<dim> &p) const
  {
    return this->a->contains(p) && this->b->contains(p);
  }



  template <int dim>
  BoundingBox<dim>
  IntersectionShape<dim>::bounding_box() const
  {
    return intersect(this->a->bounding_box(), this->b->bounding_box());
  }



  template <int dim>
  bool
  IntersectionShape<dim>::keep(const typename BooleanShape<dim>::Origin origin,
                               const bool                               inside,
                               const bool outside) const
  {
    return inside && (origin == BooleanShape<dim>::Origin::a || outside);
  }



  template <int dim>
  bool
  DifferenceShape<dim>::contains(const Point<dim> &p) const
  {
    return this->a->contains(p) && !this->b->contains(p);
  }



  template <int dim>
  BoundingBox<dim>
  DifferenceShape<dim>::bounding_box() const
  {
    return this->a->bounding_box();
  }



  template <int dim>
  bool
  DifferenceShape<dim>::keep(const typename BooleanShape<dim>::Origin origin,
                             const bool                               inside,
                             const bool outside) const
  {
    return origin == BooleanShape<dim>::Origin::a ? !inside :
                                                    (inside && outside);
  }



  template <int dim>
  double
  DifferenceShape<dim>::orientation_of_b() const
  {
    return -1.;
  }



  template class BooleanShape<2>;
  template class BooleanShape<3>;
  template class UnionShape<2>;
  template class UnionShape<3>;
  template class IntersectionShape<2>;
  template class IntersectionShape<3>;
  template class DifferenceShape<2>;
  template class DifferenceShape<3>;
} // namespace EBSMPM
