// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/large_pages.h>

#ifdef __linux__
#  include <sys/mman.h>
#  include <unistd.h>

#  include <cstdint>
#endif

namespace EBSMPM
{
  namespace
  {
    enum class Advice
    {
      huge_page,
      collapse
    };

    /** Give an advice on all pages that begin in an array. */
    void
    advise(double *array, const std::size_t size, const Advice advice)
    {
#ifdef __linux__
      // The number of an advice that is newer than the headers of the C
      // library.
      constexpr int        collapse = 25;
      const std::uintptr_t page     = sysconf(_SC_PAGESIZE);
      const auto           begin    = reinterpret_cast<std::uintptr_t>(array);
      const std::uintptr_t first    = (begin + page - 1) / page * page;
      const std::uintptr_t end      = begin + size * sizeof(double);
      if (first < end)
        madvise(reinterpret_cast<void *>(first),
                end - first,
                advice == Advice::collapse ? collapse : MADV_HUGEPAGE);
#else
      (void)array;
      (void)size;
      (void)advice;
#endif
    }
  } // namespace



  void
  resize_in_large_pages(AlignedVector<double> &array, const std::size_t size)
  {
    if (size > array.capacity())
      {
        array.clear();
        array.reserve(size);
        // Before the first number is written: this is when pages are taken.
        advise(array.data(), size, Advice::huge_page);
      }
    array.resize(size);
  }



  void
  move_to_large_pages(double *begin, const std::size_t size)
  {
    advise(begin, size, Advice::collapse);
  }
} // namespace EBSMPM
