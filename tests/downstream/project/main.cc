// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Evaluate the middle B-spline of a cell, (3/4)^2 at the centre.

#include <ebsmpm/base/config.h>

#include <ebsmpm/splines/fe_bspline.h>

#include <iostream>



int
main()
{
  const EBSMPM::FE_BSpline<2> fe(2);

  std::cout << "ebsmpm " << EBSMPM_VERSION << ": " << fe.get_name() << " has "
            << fe.shape_value(4, dealii::Point<2>(0.5, 0.5)) << std::endl;
}
