// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The bodies that parse_shape() builds: volume by counting points, area of the
// surface, volume from the surface by the divergence theorem (exact for flat
// faces), and whether the surface is closed. Faces that two bodies have in
// common must appear once or not at all.

#include <ebsmpm/particles/shape_parser.h>

#include "../tests.h"


// Print the counted volume, the area, the volume enclosed by the surface, and
// the resultant of all normals, rounded so that only errors show.
template <int dim>
void
check(const std::string &text, const double spacing = 0.1)
{
  const auto             shape = parse_shape<dim>(text);
  const BoundingBox<dim> box   = shape->bounding_box();

  const unsigned int n     = (dim == 2 ? 100 : 30);
  unsigned int       n_in  = 0;
  unsigned int       n_all = 1;
  for (unsigned int d = 0; d < dim; ++d)
    n_all *= n;
  for (unsigned int i = 0; i < n_all; ++i)
    {
      Point<dim> xi;
      for (unsigned int d = 0, j = i; d < dim; ++d, j /= n)
        xi[d] = (j % n + 0.5) / n;
      n_in += shape->contains(box.unit_to_real(xi));
    }

  double         area = 0, volume = 0, longest = 0;
  Tensor<1, dim> resultant;
  unsigned int   n_elements = 0, n_wrong = 0;
  for (const BoundaryElement<dim> &e : shape->boundary_elements(spacing))
    {
      ++n_elements;
      area += e.area;
      volume += e.area / dim * (e.midpoint * e.normal);
      resultant += e.area * e.normal;
      longest = std::max(longest, e.area / std::pow(spacing, dim - 1));
      // The normal has to lead from inside to outside.
      const double step = 1e-5 * spacing;
      n_wrong += !shape->contains(e.midpoint - step * e.normal) ||
                 shape->contains(e.midpoint + step * e.normal);
    }
  deallog << text << ": volume " << box.volume() * n_in / n_all << " = "
          << volume << ", area " << area << ", " << n_elements << " elements, "
          << n_wrong << " wrong, "
          << (longest < 1. + 1e-6 ? "short" : "too long") << ", "
          << (resultant.norm() < 1e-4 * spacing ? "closed" : "not closed")
          << std::endl;
}



int
main()
{
  initlog();

  deallog << "2d" << std::endl;
  check<2>("box(0,0, 2,1)");
  check<2>("box(0,0, 1/31*31,1)", 1. / 31);
  check<2>("ball(0.5,0.5, 0.25)");
  check<2>("ball(0.5,0.5, 0.25)", 0.001);
  check<2>("half_space(0.3,0.3, 1,1) & box(0,0, 1,1)");
  // Side by side, a common face of different length; overlapping; one in the
  // other with a common face; the same twice.
  check<2>("box(0,0, 1,1) + box(1,0.25, 2,0.7)");
  check<2>("box(0,0, 1,1) + box(0.33,0.25, 2,0.7)");
  check<2>("box(0,0, 1,1) + box(0.5,0.25, 1,0.7)");
  check<2>("box(0,0, 1,1) + box(0,0, 1,1)");
  check<2>("box(0,0, 1,1) & box(0,0.37, 1,2)");
  check<2>("box(0,0, 1,1) & box(0,0, 1,1)");
  // A notch, one with a round tip, a hole that is open on two sides, the
  // letter L; a body that only touches.
  check<2>("box(0,0, 1,1) - box(-1,0.484, 0.5,0.516)");
  check<2>("box(0,0, 1,1) - box(0,0.45, 0.5,0.55) - ball(0.5,0.5, 0.05)", 0.01);
  check<2>("box(0,0, 1,1) - box(0,0.2, 1,0.3)");
  check<2>("box(0,0, 1,1) - box(0.5,0, 1,0.5)");
  check<2>("box(0,0, 1,1) - box(1,0, 2,1)");
  // Moved bodies, and precedence: a + (b & c) - d.
  check<2>("rotate(0.4, box(0,0, 1,1))");
  check<2>("translate(3,-2, rotate(pi/6, box(0,0, 1,1) - ball(0.5,0.5, 0.2)))",
           0.01);
  check<2>("box(0,0, 1,1) + box(0,0, 3,0.5) & box(0,0, 2,2) - "
           "box(0.2,0.2, 0.4,0.4)");

  deallog << "3d" << std::endl;
  check<3>("box(0,0,0, 2,1,1)");
  check<3>("ball(0.5,0.5,0.5, 0.25)", 0.01);
  check<3>("box(0,0,0, 1,1,1) + box(1,0.25,0.2, 2,0.7,0.9)");
  check<3>("box(0,0,0, 1,1,1) + box(0,0,0, 1,1,1)");
  check<3>("box(0,0,0, 1,1,1) - box(-1,0.47,0, 0.5,0.53,1)");
  check<3>("box(0,0,0, 1,1,1) & half_space(0.5,0.5,0.5, 1,1,1)", 0.05);
  check<3>("rotate(0.3, 1,2,3, translate(1,0,0, box(0,0,0, 1,1,1)))");

  // Parsed expressions have a volume only.
  const auto ellipse =
    parse_shape<2>("expression(\"x^2 + (y/b)^2 - 1\")", {{"b", 0.5}});
  deallog << "ellipse contains (0,0.4): " << ellipse->contains({0, 0.4})
          << ", (0,0.6): " << ellipse->contains({0, 0.6}) << ", elements "
          << ellipse->boundary_elements(0.1, unbounded_box<2>()).size()
          << std::endl;

  // A row of boxes covers every point once, also those on the faces.
  const auto   left   = parse_shape<2>("box(0,0, 1/3,1)");
  const auto   middle = parse_shape<2>("box(1/3,0, 2/3,1)");
  unsigned int n_once = 0;
  for (unsigned int i = 0; i < 6; ++i)
    {
      const Point<2> p(i / 9. + (i % 2 ? 1e-16 : -1e-16), 0.5);
      n_once += (left->contains(p) + middle->contains(p) == 1);
    }
  deallog << n_once << " of 6 points covered once" << std::endl;
}
