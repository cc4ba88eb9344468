// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// What parse_shape() and Expression say when they cannot understand a text.

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/expression.h>
#include <ebsmpm/particles/primitive_shapes.h>
#include <ebsmpm/particles/shape_parser.h>

#include <functional>
#include <sstream>

#include "../tests.h"


void
report(const std::function<void()> &function)
{
  try
    {
      function();
      deallog << "no error" << std::endl;
    }
  catch (const ExcInput &e)
    {
      std::ostringstream message;
      e.print_info(message);
      std::string text = message.str();
      while (text.size() > 0 && (text.back() == '\n' || text.back() == ' '))
        text.pop_back();
      // What muParser says is not ours.
      deallog << text.substr(text.find_first_not_of(' '),
                             text.find("Parsing") - text.find_first_not_of(' '))
              << std::endl;
    }
}



int
main()
{
  initlog();

  for (const std::string text : {"",
                                 "bax(0,0, 1,1)",
                                 "box 0,0, 1,1",
                                 "box(0,0, 1)",
                                 "box(0,0, 1,1",
                                 "box(0,0,0, 1,1,1)",
                                 "box(0,0, 0,1)",
                                 "box(0,0, 1/0,1)",
                                 "box(0,0, 1,height)",
                                 "box(0,0, 1,sqrt 2)",
                                 "ball(0,0, -1)",
                                 "half_space(0,0, 0,0)",
                                 "(box(0,0, 1,1)",
                                 "box(0,0, 1,1) ball(0,0, 1)",
                                 "box(0,0, 1,1) - ",
                                 "expression(x)",
                                 "expression(\"x)",
                                 "expression(\"x + \")",
                                 "rotate(box(0,0, 1,1))"})
    report([&]() { parse_shape<2>(text); });
  report([&]() { parse_shape<3>("rotate(1, 0,0,0, ball(0,0,0, 1))"); });
  report(
    [&]() { parse_shape<2>("half_space(0,0, 1,0)")->boundary_elements(0.1); });
  report([&]() { BoxShape<2>(Point<2>(1, 0), Point<2>(0, 1)); });
  report([&]() { BallShape<2>(Point<2>(), 0); });
  report([&]() { HalfSpaceShape<2>(Point<2>(), Tensor<1, 2>()); });

  for (const std::string text :
       {"y > ", "y >> 1", "y > 1 x", "(y > 1", "w > 1", "min(x)"})
    report([&]() { Expression(text, {"x", "y"}); });

  // And what they do understand.
  const std::vector<double> xy = {2, 3};
  for (const std::string text : {"-2^2 + 3*4/6 - -1",
                                 "2^3^2",
                                 "x < y && !(x == 2) || y >= 3",
                                 "1 + 1 <= 2 && x != y",
                                 "max(x, y) * min(1, abs(-3)) + h",
                                 "sin(pi/2) + cos(0) + log(exp(1))",
                                 "1e-3 * .5"})
    deallog
      << text << " = "
      << Expression(text, {"x", "y"}, {{"h", 0.25}}).value(make_array_view(xy))
      << std::endl;
}
