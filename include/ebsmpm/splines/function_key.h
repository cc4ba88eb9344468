// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_splines_function_key_h
#define ebsmpm_splines_function_key_h

#include <ebsmpm/base/config.h>

#include <boost/serialization/array.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <tuple>

/**
 * @page notation The words of the splines layer
 *
 * - <b>function</b>, also <b>control point</b>: a tensor-product B-spline,
 *   known by its FunctionKey.
 * - <b>active</b>: has a point in its support and is numbered; all others are
 *   <b>exterior</b> and do not exist for us.
 * - <b>standard</b>: more than the fraction $\phi_\text{cr}$ of it is occupied
 *   by material; <b>deficient</b>: active, but occupied less.
 * - <b>independent</b>: an unknown of the linear system. <b>dependent</b>:
 *   active, but given by a line $c_J=\sum_I E_{IJ} c_I$ of an
 *   AffineConstraints object (deficient functions and twins).
 * - <b>part 0</b>: the function as its own side of a crack sees it.
 * - <b>twin</b> (part 1): the same function as the other side sees it. A twin
 *   is always dependent, so that the number of unknowns does not grow when a
 *   crack opens.
 */

namespace EBSMPM
{
  /**
   * The name of a B-spline function, the same on all processes and for all
   * numbers of processes: the refinement level of the cells it is made of, its
   * lattice index there, and which side of a crack reads it.
   *
   * The function with index $J$ has the support of the cells $J-p,\ldots,J$ in
   * each direction, so that the cell with lattice index $c$ sees the functions
   * $c,\ldots,c+p$.
   *
   * The type is trivially copyable, hence cheap to send in large numbers.
   */
  template <int dim>
  struct FunctionKey
  {
    /** Refinement level. */
    std::int32_t level = 0;

    /** Lattice index on that level. */
    std::array<std::int32_t, dim> index{};

    /** 0: as its own side sees it; 1: the twin. */
    std::int32_t part = 0;

    bool
    operator==(const FunctionKey &other) const
    {
      return level == other.level && index == other.index && part == other.part;
    }

    /** Order by level, then by the last index first, then by part. */
    bool
    operator<(const FunctionKey &other) const
    {
      if (level != other.level)
        return level < other.level;
      for (int d = dim - 1; d >= 0; --d)
        if (index[d] != other.index[d])
          return index[d] < other.index[d];
      return part < other.part;
    }

    /** The same function, read by the side @p part. */
    FunctionKey
    with_part(const int new_part) const
    {
      FunctionKey result = *this;
      result.part        = new_part;
      return result;
    }

    /** Write the key to an archive, or read it. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &level &index &part;
    }
  };



  /**
   * Which of the functions that its cell sees a point reads as twins: bit $i$
   * is set if it reads the twin of function $i$.
   */
  using ReadingPattern = std::uint64_t;



  /**
   * A hash of a FunctionKey: for unordered containers, and to choose the
   * process that keeps the books about a function (see FunctionDirectory).
   */
  template <int dim>
  struct FunctionKeyHash
  {
    std::size_t
    operator()(const FunctionKey<dim> &key) const
    {
      // One round of splitmix64 per entry: cheap, and neighbours on the
      // lattice end up far from each other.
      std::uint64_t h   = 0x9e3779b97f4a7c15ULL;
      const auto    mix = [&h](const std::int32_t value) {
        h += static_cast<std::uint32_t>(value) + 0x9e3779b97f4a7c15ULL;
        h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
        h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
        h ^= h >> 31;
      };
      mix(key.level);
      for (const auto i : key.index)
        mix(i);
      mix(key.part);
      return h;
    }
  };
} // namespace EBSMPM

#endif
