// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_constant_h
#define ebsmpm_base_constant_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/exceptions.h>

#include <type_traits>

namespace EBSMPM
{
  /**
   * Call a function with a number that is one, two or three (the degree of
   * splines, the number of components) as a compile-time constant, a
   * <tt>std::integral_constant</tt>, so that loops over it are unrolled:
   *
   * @code
   * with_constant(degree, [&](const auto p) { evaluate<p()>(x, values); });
   * @endcode
   */
  template <typename Function>
  inline void
  with_constant(const unsigned int n, const Function &function)
  {
    switch (n)
      {
        case 1:
          return function(std::integral_constant<unsigned int, 1>());
        case 2:
          return function(std::integral_constant<unsigned int, 2>());
        case 3:
          return function(std::integral_constant<unsigned int, 3>());
        default:
          Assert(false, ExcNotImplemented());
      }
  }
} // namespace EBSMPM

#endif
