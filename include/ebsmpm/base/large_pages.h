// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_large_pages_h
#define ebsmpm_base_large_pages_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/aligned_vector.h>

#include <cstddef>

namespace EBSMPM
{
  /**
   * Resize an array that is read and written here and there, and ask the
   * operating system to keep it in large pages: a processor remembers the
   * addresses of so many pages only, and a large array has many of 4 kB. What
   * was in the array is lost if it has to be moved.
   *
   * Only Linux is asked, and it need not follow. Nothing but the speed depends
   * on it.
   */
  void
  resize_in_large_pages(AlignedVector<double> &array, const std::size_t size);

  /**
   * Ask the operating system to move what is in @p size numbers from @p begin
   * on, which somebody else has allocated, to large pages. Addresses stay the
   * same. Linux does that from version 6.1 on.
   */
  void
  move_to_large_pages(double *begin, const std::size_t size);
} // namespace EBSMPM

#endif
