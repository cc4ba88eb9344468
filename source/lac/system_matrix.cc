// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/block_row.h>
#include <ebsmpm/base/constant.h>

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
      constexpr unsigned int line = max_n_lanes * sizeof(double), pair = 16;
      for (; k < n && reinterpret_cast<std::uintptr_t>(to + k) % line != 0; ++k)
        to[k] = from[k];
      for (; k + max_n_lanes <= n; k += max_n_lanes)
        for (unsigned int l = 0; l < max_n_lanes; l += pair / sizeof(double))
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
  SystemMatrix::add(const unsigned int list, const double *values)
  {
    AssertIndexRange(list + 1, list_begins.size());
    Assert(list >= next_list, ExcMessage("Lists have to be in their order."));
    for (; next_list < list; ++next_list)
      add_list(next_list, nullptr);
    add_list(next_list++, values);

    // The next list is most often the next one to be added.
    const bool are_rows_far =
      open_rows.size() * sizeof(double) > size_of_near_caches;
    if (are_rows_far && next_list + 1 < list_begins.size())
      with_constant(n_components,
                    [&](const auto nc) { fetch_rows<nc()>(next_list); });
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
      using Row = BlockRow<n_components>;

      /** What quadratic splines have most of. */
      static constexpr unsigned int frequent_size = 3;

      template <unsigned int n_bytes>
      static EBSMPM_IN_EACH_TARGET void
      add_blocks(const unsigned int n,
                 const double      *heads,
                 const double      *tails,
                 double            *to_heads,
                 double            *to_tails)
      {
        add_array<n_bytes>(n * Row::head_size, heads, to_heads);
        if constexpr (Row::has_tails)
          add_array<n_bytes>(n, tails, to_tails);
      }

      /**
       * @param open_tails where the tails begin in the rows that are added to
       */
      template <unsigned int n_bytes, typename Run>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int n,
          const double      *values,
          const Run         *run,
          double *const     *rows,
          const std::size_t  open_tails)
      {
        for (unsigned int i = 0; i < n; ++i, values += Row::length(n))
          for (unsigned int j = i; j < n; j += run->size, ++run)
            {
              const double *heads    = values + j * Row::head_size;
              const double *tails    = values + Row::tails(n) + j;
              double *const row      = rows[run->is_transposed ? j : i];
              double       *to_heads = row + run->place * Row::head_size;
              double       *to_tails = row + open_tails + run->place;
              if (run->size == frequent_size)
                add_blocks<n_bytes>(
                  frequent_size, heads, tails, to_heads, to_tails);
              else if (!run->is_transposed)
                add_blocks<n_bytes>(
                  run->size, heads, tails, to_heads, to_tails);
              else
                {
                  double transposed[Row::head_size + 1];
                  transpose_head<n_components, n_bytes>(heads, transposed);
                  add_blocks<n_bytes>(1, transposed, tails, to_heads, to_tails);
                }
            }
      }
    };



    /** Copy blocks of an open row, transposed, to others. */
    template <unsigned int n_components>
    struct CopyMirrors
    {
      using Row = BlockRow<n_components>;

      template <unsigned int n_bytes, typename Mirror>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int  n,
          const Mirror       *mirror,
          const double       *row,
          double             *open_rows,
          const std::size_t   slot_size,
          const std::size_t   open_tails,
          const unsigned int *slots)
      {
        for (unsigned int k = 0; k < n; ++k, ++mirror)
          {
            double *const to = open_rows + slots[mirror->function] * slot_size;
            transpose_head<n_components, n_bytes>(row + mirror->from *
                                                          Row::head_size,
                                                  to + mirror->to *
                                                         Row::head_size);
            if constexpr (Row::has_tails)
              to[open_tails + mirror->to] = row[open_tails + mirror->from];
          }
      }
    };



    /** Copy a row of blocks to as many rows of numbers as blocks have. */
    template <unsigned int n_components>
    struct SplitRow
    {
      using Row = BlockRow<n_components>;

      template <unsigned int n_bytes>
      static EBSMPM_IN_EACH_TARGET void
      run(const unsigned int n_blocks,
          const double      *heads,
          const double      *tails,
          double            *to)
      {
        const unsigned int length = n_blocks * n_components;
        unsigned int       k      = 0;
        // Three numbers are copied with another one, which is overwritten by
        // what comes next.
        if constexpr (n_components == 3 && n_bytes >= 32)
          for (; k + 1 < n_blocks; ++k, to += n_components)
            {
              const double *head = heads + k * Row::head_size;
              Lanes<32>::store(Lanes<32>::load(head), to);
              Lanes<32>::store(Lanes<32>::load(head + 3), to + length);
              Lanes<16>::store(Lanes<16>::load(head + 6), to + 2 * length);
              to[2 * length + 2] = tails[k];
            }
        for (; k < n_blocks; ++k, to += n_components)
          for (unsigned int e = 0; e < Row::block_size; ++e)
            to[e / n_components * length + e % n_components] =
              e < Row::head_size ? heads[k * Row::head_size + e] : tails[k];
      }
    };
  } // namespace



  template <unsigned int nc>
  void
  SystemMatrix::begin_row(const unsigned int function)
  {
    if (wanted != nullptr && !needed[function])
      return;
    using Row = BlockRow<nc>;

    const unsigned int first = first_places[function];
    const unsigned int size  = row_length(function) - first;
    double *const      row   = open_row(function);
    std::fill_n(row + first * Row::head_size, size * Row::head_size, 0.);
    if constexpr (Row::has_tails)
      std::fill_n(row + open_tails + first, size, 0.);
  }



  template <unsigned int nc>
  void
  SystemMatrix::close_row(const unsigned int function)
  {
    if (wanted != nullptr && !needed[function])
      return;

    const double *const blocks = open_row(function);
    const std::size_t   begin  = mirror_begins[function];
    run_best<CopyMirrors<nc>>(mirror_begins[function + 1] - begin,
                              mirrors.data() + begin,
                              blocks,
                              open_rows.data(),
                              slot_size,
                              open_tails,
                              slots.data());
    if (wanted != nullptr && !(*wanted)[function])
      return;

    const bool    is_large = this->is_large();
    double *const to       = row(function);
    double *const split    = is_large ? split_row.data() : to;
    run_best<SplitRow<nc>>(row_length(function),
                           blocks,
                           blocks + open_tails,
                           split);
    if (is_large)
      copy_past_caches(nc * nc * row_length(function), split, to);
  }



  namespace
  {
    /**
     * Ask the memory for some blocks of an open row. A compiler that does not
     * inline it at once takes this for a function without an effect.
     */
    template <unsigned int n_components>
    EBSMPM_IN_EACH_TARGET void
    fetch_blocks(const double      *row,
                 const std::size_t  open_tails,
                 const unsigned int place,
                 const unsigned int size)
    {
      using Row = BlockRow<n_components>;

      const double       *head = row + place * Row::head_size;
      const double *const end  = head + size * Row::head_size;
      for (; head < end; head += max_n_lanes)
        __builtin_prefetch(head, 1, 2);
      if constexpr (Row::has_tails)
        {
          const double *const tail = row + open_tails + place;
          __builtin_prefetch(tail, 1, 2);
          __builtin_prefetch(tail + size - 1, 1, 2);
        }
    }
  } // namespace



  template <unsigned int nc>
  void
  SystemMatrix::fetch_rows(const unsigned int list)
  {
    const unsigned int  n = list_begins[list + 1] - list_begins[list];
    const unsigned int *f = list_functions.data() + list_begins[list];
    for (unsigned int i = 0; i < n; ++i)
      row_pointers[i] = open_row(f[i]);

    const Run *run = runs.data() + run_begins[list];
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i; j < n; j += run->size, ++run)
        fetch_blocks<nc>(row_pointers[run->is_transposed ? j : i],
                         open_tails,
                         run->place,
                         run->size);
    for (unsigned int i = 0; i < n; ++i)
      if (last_lists[f[i]] == list)
        {
          fetch_blocks<nc>(row_pointers[i], open_tails, 0, first_places[f[i]]);
          for (std::size_t k = mirror_begins[f[i]]; k < mirror_begins[f[i] + 1];
               ++k)
            fetch_blocks<nc>(open_row(mirrors[k].function),
                             open_tails,
                             mirrors[k].to,
                             1);
        }
  }



  void
  SystemMatrix::add_list(const unsigned int list, const double *values)
  {
    const unsigned int  n = list_begins[list + 1] - list_begins[list];
    const unsigned int *f = list_functions.data() + list_begins[list];

    with_constant(n_components, [&](const auto nc) {
      for (unsigned int i = 0; i < n; ++i)
        {
          row_pointers[i] = open_row(f[i]);
          if (first_lists[f[i]] == list)
            begin_row<nc()>(f[i]);
        }
      if (values != nullptr)
        run_best<AddRuns<nc()>>(n,
                                values,
                                runs.data() + run_begins[list],
                                row_pointers.data(),
                                open_tails);
      for (unsigned int i = 0; i < n; ++i)
        if (last_lists[f[i]] == list)
          close_row<nc()>(f[i]);
    });
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
