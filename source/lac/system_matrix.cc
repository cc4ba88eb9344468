// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/constant.h>
#include <ebsmpm/base/lanes.h>

#include <ebsmpm/lac/system_matrix.h>

#include <algorithm>
#include <cstdint>

#ifdef __SSE2__
#  include <emmintrin.h>
#endif

namespace EBSMPM
{
  namespace
  {
    /** Number of doubles in a cache line. */
    constexpr unsigned int doubles_per_line = 8;

    /** In bytes: open rows that fit in there need not be fetched. */
    constexpr std::size_t size_of_near_caches = 1U << 20;



    /**
     * Copy an array to the memory without a way through the caches, which would
     * read what is there first, only to have it overwritten.
     */
    void
    copy_past_caches(const std::size_t n, const double *from, double *to)
    {
      std::size_t k = 0;
#ifdef __SSE2__
      constexpr unsigned int line = doubles_per_line * sizeof(double),
                             pair = 16;
      for (; k < n && reinterpret_cast<std::uintptr_t>(to + k) % line != 0; ++k)
        to[k] = from[k];
      for (; k + doubles_per_line <= n; k += doubles_per_line)
        for (unsigned int l = 0; l < doubles_per_line;
             l += pair / sizeof(double))
          _mm_stream_pd(to + k + l, _mm_loadu_pd(from + k + l));
#endif
      std::copy(from + k, from + n, to + k);
    }
  } // namespace



  void
  SystemMatrix::begin(const std::vector<bool> *wanted_functions)
  {
    wanted    = wanted_functions;
    next_list = 0;
    if (wanted != nullptr)
      {
        needed = *wanted;
        for (unsigned int f = 0; f < global_functions.size(); ++f)
          for (std::size_t k = mirror_begins[f]; k < mirror_begins[f + 1]; ++k)
            if ((*wanted)[mirrors[k].function])
              needed[f] = true;
      }
    for (unsigned int f = 0; f < n_owned; ++f)
      if (last_lists[f] < first_lists[f])
        std::fill_n(row(f), n_components * n_components * row_length(f), 0.);
  }



  void
  SystemMatrix::add(const unsigned int list,
                    const double      *values,
                    const unsigned int stride)
  {
    AssertIndexRange(list + 1, list_begins.size());
    Assert(list >= next_list, ExcMessage("Lists have to be in their order."));
    for (; next_list < list; ++next_list)
      add_list(next_list, nullptr, 0);
    add_list(next_list++, values, stride);

    // The next list is most often the next one to be added.
    const bool are_rows_far =
      open_rows.size() * sizeof(double) > size_of_near_caches;
    if (are_rows_far && next_list + 1 < list_begins.size())
      fetch_rows(next_list);
  }



  inline double *
  SystemMatrix::open_row(const unsigned int function)
  {
    return open_rows.data() + slots[function] * slot_size;
  }



  double *
  SystemMatrix::row(const unsigned int function)
  {
    const unsigned int block_size = n_components * n_components;
    return function < n_owned ?
             entries + block_size * row_begins[function] :
             ghost_entries.data() +
               block_size * (row_begins[function] - row_begins[n_owned]);
  }



  namespace
  {
    /**
     * Add an array to another one, with registers that become smaller as less
     * is left.
     */
    template <unsigned int n_bytes>
    EBSMPM_IN_EACH_TARGET void
    add_array(const unsigned int length, const double *from, double *to)
    {
      if constexpr (n_bytes == sizeof(double))
        for (unsigned int k = 0; k < length; ++k)
          to[k] += from[k];
      else
        {
          using L        = Lanes<n_bytes>;
          unsigned int k = 0;
          for (; k + L::n <= length; k += L::n)
            L::store(L::load(to + k) + L::load(from + k), to + k);
          add_array<n_bytes / 2>(length - k, from + k, to + k);
        }
    }



    /**
     * Add one half of a symmetric local matrix of n x n blocks to rows, along
     * runs of columns that are neighbours.
     */
    template <unsigned int n_components>
    struct AddRuns
    {
      static constexpr unsigned int block_size = n_components * n_components;

      /** What quadratic splines have most of. */
      static constexpr unsigned int frequent_size = 3;

      template <unsigned int n_bytes, typename Run>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int n,
          const double      *values,
          const unsigned int stride,
          const Run         *run,
          double *const     *rows)
      {
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = i; j < n; j += run->size, ++run)
            {
              const double *from = values + i * stride + j * block_size;
              double       *to =
                rows[run->is_transposed ? j : i] + run->place * block_size;
              if (run->size == frequent_size)
                add_array<n_bytes>(frequent_size * block_size, from, to);
              else if (!run->is_transposed)
                add_array<n_bytes>(run->size * block_size, from, to);
              else
                for (unsigned int a = 0; a < n_components; ++a)
                  for (unsigned int b = 0; b < n_components; ++b)
                    to[a * n_components + b] += from[b * n_components + a];
            }
      }
    };



    /** Copy blocks of an open row, transposed, to others. */
    template <unsigned int n_components>
    struct CopyMirrors
    {
      template <unsigned int n_bytes, typename Mirror>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int  n,
          const Mirror       *mirror,
          const double       *blocks,
          double             *open_rows,
          const std::size_t   slot_size,
          const unsigned int *slots)
      {
        constexpr unsigned int block_size = n_components * n_components;
        for (unsigned int k = 0; k < n; ++k, ++mirror)
          transpose_block<n_components, n_bytes>(
            blocks + mirror->from * block_size,
            open_rows + slots[mirror->function] * slot_size +
              mirror->to * block_size);
      }
    };



    /** Copy a row of blocks to as many rows of numbers as blocks have. */
    template <unsigned int n_components>
    struct SplitRow
    {
      template <unsigned int n_bytes>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int n_blocks, const double *from, double *to)
      {
        // Three numbers are copied with another one, which is overwritten by
        // what comes next.
        const unsigned int length = n_blocks * n_components;
        unsigned int       k      = 0;
        if constexpr (n_components == 3 && n_bytes >= 32)
          for (; k + 1 < n_blocks; ++k, to += n_components)
            for (unsigned int a = 0; a < n_components;
                 ++a, from += n_components)
              Lanes<32>::store(Lanes<32>::load(from), to + a * length);
        for (; k < n_blocks; ++k, to += n_components)
          for (unsigned int a = 0; a < n_components; ++a, from += n_components)
            for (unsigned int b = 0; b < n_components; ++b)
              to[a * length + b] = from[b];
      }
    };
  } // namespace



  void
  SystemMatrix::begin_row(const unsigned int function)
  {
    const unsigned int block_size = n_components * n_components;
    if (wanted == nullptr || needed[function])
      std::fill(open_row(function) + block_size * first_places[function],
                open_row(function) + block_size * row_length(function),
                0.);
  }



  void
  SystemMatrix::close_row(const unsigned int function)
  {
    if (wanted != nullptr && !needed[function])
      return;

    const double *const blocks = open_row(function);
    const std::size_t   begin  = mirror_begins[function];
    with_constant(n_components, [&](const auto nc) {
      run_best<CopyMirrors<nc()>>(mirror_begins[function + 1] - begin,
                                  mirrors.data() + begin,
                                  blocks,
                                  open_rows.data(),
                                  slot_size,
                                  slots.data());
      if (wanted != nullptr && !(*wanted)[function])
        return;

      const std::size_t length   = nc() * nc() * row_length(function);
      const bool        is_large = this->is_large();
      double *const     to       = row(function);
      double *const     split    = is_large ? split_row.data() : to;
      run_best<SplitRow<nc()>>(row_length(function), blocks, split);
      if (is_large)
        copy_past_caches(length, split, to);
    });
  }



  void
  SystemMatrix::fetch_rows(const unsigned int list)
  {
    const unsigned int  n = list_begins[list + 1] - list_begins[list];
    const unsigned int *f = list_functions.data() + list_begins[list];
    for (unsigned int i = 0; i < n; ++i)
      row_pointers[i] = open_row(f[i]);

    // A block of nine numbers is in two cache lines.
    const unsigned int block_size  = n_components * n_components;
    const auto         fetch_block = [block_size](const double *block) {
      __builtin_prefetch(block, 1, 2);
      __builtin_prefetch(block + block_size - 1, 1, 2);
    };
    const Run *run = runs.data() + run_begins[list];
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i; j < n; j += run->size, ++run)
        {
          const double *number =
            row_pointers[run->is_transposed ? j : i] + run->place * block_size;
          const double *const end = number + run->size * block_size;
          for (; number < end; number += doubles_per_line)
            __builtin_prefetch(number, 1, 2);
          __builtin_prefetch(end - 1, 1, 2);
        }
    for (unsigned int i = 0; i < n; ++i)
      if (last_lists[f[i]] == list)
        {
          const double *const begin = open_row(f[i]);
          const double *const end   = begin + first_places[f[i]] * block_size;
          for (const double *line = begin; line < end; line += doubles_per_line)
            __builtin_prefetch(line, 0, 2);
          for (std::size_t k = mirror_begins[f[i]]; k < mirror_begins[f[i] + 1];
               ++k)
            fetch_block(open_row(mirrors[k].function) +
                        mirrors[k].to * block_size);
        }
  }



  void
  SystemMatrix::add_list(const unsigned int list,
                         const double      *values,
                         const unsigned int stride)
  {
    const unsigned int  n = list_begins[list + 1] - list_begins[list];
    const unsigned int *f = list_functions.data() + list_begins[list];

    for (unsigned int i = 0; i < n; ++i)
      {
        row_pointers[i] = open_row(f[i]);
        if (first_lists[f[i]] == list)
          begin_row(f[i]);
      }
    if (values != nullptr)
      with_constant(n_components, [&](const auto nc) {
        run_best<AddRuns<nc()>>(n,
                                values,
                                stride,
                                runs.data() + run_begins[list],
                                row_pointers.data());
      });
    for (unsigned int i = 0; i < n; ++i)
      if (last_lists[f[i]] == list)
        close_row(f[i]);
  }



  const LA::SparseMatrix &
  SystemMatrix::matrix() const
  {
    return sparse_matrix;
  }



  std::size_t
  SystemMatrix::memory_consumption() const
  {
    return list_functions.capacity() * sizeof(unsigned int) +
           global_functions.capacity() * sizeof(types::global_dof_index) +
           foreign_columns.memory_consumption() +
           runs.capacity() * sizeof(Run) + mirrors.capacity() * sizeof(Mirror) +
           first_places.capacity() * sizeof(std::uint16_t) +
           (columns.capacity() + row_columns.capacity() + slots.capacity() +
            closing_numbers.capacity() + first_lists.capacity() +
            last_lists.capacity()) *
             sizeof(unsigned int) +
           (list_begins.capacity() + run_begins.capacity() +
            row_begins.capacity() + mirror_begins.capacity() +
            arrival_places.capacity()) *
             sizeof(std::size_t) +
           row_pointers.capacity() * sizeof(double *) +
           (open_rows.capacity() + split_row.capacity() +
            ghost_entries.capacity() + arrivals.capacity()) *
             sizeof(double);
  }
} // namespace EBSMPM
