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
  void
  resize_in_large_pages(std::vector<double> &array, const std::size_t size)
  {
    if (size > array.capacity())
      {
        array = std::vector<double>();
        array.reserve(size);
#ifdef __linux__
        // Before the first number is written: this is when pages are taken. An
        // advice begins with a page.
        const std::uintptr_t page = sysconf(_SC_PAGESIZE);
        const auto begin = reinterpret_cast<std::uintptr_t>(array.data());
        const std::uintptr_t first = (begin + page - 1) / page * page;
        const std::uintptr_t end   = begin + size * sizeof(double);
        if (first < end)
          madvise(reinterpret_cast<void *>(first), end - first, MADV_HUGEPAGE);
#endif
      }
    array.resize(size);
  }
} // namespace EBSMPM
