// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_block_row_h
#define ebsmpm_base_block_row_h

#include <ebsmpm/base/lanes.h>

namespace EBSMPM
{
  /**
   * How a row of square blocks, with a number per pair of components, lies in
   * memory: the form of all dense matrices of a cell.
   *
   * Nine numbers per block would fill neither registers nor cache lines, and
   * all but a few blocks would begin in the middle of one. So the first numbers
   * of a block, as many as fill a register, are next to each other: its head.
   * The heads are followed by the last numbers of all blocks, the tails, if
   * there are any: the four numbers in 2-D are a head, a single number is a
   * tail. Both parts are padded. As the last number is on the diagonal, heads
   * are transposed on their own.
   *
   * @tparam n_components number of rows and columns of a block, from one to
   *   three
   */
  template <unsigned int n_components>
  struct BlockRow
  {
    /** Numbers in a block, and in its head. */
    static constexpr unsigned int block_size = n_components * n_components;
    static constexpr unsigned int head_size =
      block_size / max_n_short_lanes * max_n_short_lanes;

    /** Whether the last number is a tail. */
    static constexpr bool has_tails = (head_size < block_size);

    static_assert(block_size - head_size <= 1, "A tail is a single number.");

    /** Where the tails begin, in a row of @p n blocks. */
    static constexpr unsigned int
    tails(const unsigned int n)
    {
      return padded(head_size * n);
    }

    /** The length of a row of @p n blocks. */
    static constexpr unsigned int
    length(const unsigned int n)
    {
      return tails(n) + (has_tails ? padded(n) : 0);
    }

    /** Where the number of components @p a and @p b of block @p j is. */
    static constexpr unsigned int
    place(const unsigned int n,
          const unsigned int j,
          const unsigned int a,
          const unsigned int b)
    {
      const unsigned int entry = a * n_components + b;
      return entry < head_size ? j * head_size + entry : tails(n) + j;
    }
  };



  /** Copy the head of a block to that of its transpose. */
  template <unsigned int n_components, unsigned int n_bytes>
  EBSMPM_IN_EACH_TARGET void
  transpose_head(const double *from, double *to)
  {
    if constexpr (n_components == 2 && n_bytes >= 32)
      {
        using L             = Lanes<32>;
        const L::type block = L::load(from);
        L::store(EBSMPM_SHUFFLE(4, block, block, 0, 2, 1, 3), to);
      }
    else if constexpr (n_components == 3 && n_bytes == 64)
      {
        using L            = Lanes<64>;
        const L::type head = L::load(from);
        L::store(EBSMPM_SHUFFLE(8, head, head, 0, 3, 6, 1, 4, 7, 2, 5), to);
      }
    else if constexpr (n_components == 3 && n_bytes == 32)
      {
        using L             = Lanes<32>;
        const L::type lower = L::load(from), upper = L::load(from + L::n);
        L::store(EBSMPM_SHUFFLE(4, lower, upper, 0, 3, 6, 1), to);
        L::store(EBSMPM_SHUFFLE(4, lower, upper, 4, 7, 2, 5), to + L::n);
      }
    else
      for (unsigned int k = 0; k < BlockRow<n_components>::head_size; ++k)
        to[k] = from[k % n_components * n_components + k / n_components];
  }
} // namespace EBSMPM

#endif
