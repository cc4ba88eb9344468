// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_lanes_h
#define ebsmpm_base_lanes_h

#include <ebsmpm/base/config.h>

// With GCC and Linux on x86, kernels are compiled for several instruction sets,
// and the best one for the machine is taken at run time: a portable binary, as
// Debian builds them, thereby uses AVX where there is AVX. (deal.II's
// VectorizedArray has the width that deal.II was compiled for.)
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
  defined(__linux__)
#  define EBSMPM_HAVE_X86_TARGETS
#  define EBSMPM_TARGET_AVX2 __attribute__((target("avx2,fma")))
#  define EBSMPM_TARGET_AVX512 \
    __attribute__((target("avx512f,avx512vl,avx2,fma")))
#else
#  define EBSMPM_TARGET_AVX2
#  define EBSMPM_TARGET_AVX512
#endif

// Some of the numbers of two vectors of n, which are counted through both.
// GCC before version 12 knows its own builtin only, Clang does not have that.
#ifdef __clang__
#  define EBSMPM_SHUFFLE(n, a, b, ...) \
    __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#  define EBSMPM_SHUFFLE(n, a, b, ...) \
    __builtin_shuffle(a, b, ::EBSMPM::LaneNumbers##n{__VA_ARGS__})
#endif

// What is called by the variants of a kernel must become part of each.
#define EBSMPM_IN_EACH_TARGET inline __attribute__((always_inline))

namespace EBSMPM
{
  /**
   * Numbers next to each other in memory, as many as fit into a register of
   * @p n_bytes: what the innermost loops of the assembly compute with.
   *
   * Left to itself with arrays, the compiler turns such loops into shuffles of
   * pairs; with vectors that are longer than a register, it keeps them in
   * memory. Both is several times slower.
   *
   * A kernel is a class with a static function run() that is a template in
   * @p n_bytes and has the attribute EBSMPM_IN_EACH_TARGET. run_best() calls
   * the variant for the machine:
   *
   * @code
   * struct Add
   * {
   *   template <unsigned int n_bytes>
   *   static EBSMPM_IN_EACH_TARGET void run(const unsigned int n, double *x);
   * };
   *
   * run_best<Add>(n, x);
   * @endcode
   */
  template <unsigned int n_bytes>
  struct Lanes
  {
    /** The vector. Arithmetic works as with numbers, lane by lane. */
    typedef double type __attribute__((vector_size(n_bytes)));

    /** Number of lanes. */
    static constexpr unsigned int n = n_bytes / sizeof(double);

    /** Read from memory, wherever it begins. */
    static EBSMPM_IN_EACH_TARGET type
    load(const double *memory)
    {
      return *reinterpret_cast<const in_memory *>(memory);
    }

    /** Write to memory. */
    static EBSMPM_IN_EACH_TARGET void
    store(const type &value, double *memory)
    {
      *reinterpret_cast<in_memory *>(memory) = value;
    }

    /**
     * Return a vector of the sums of #n vectors over their lanes, for at most
     * four lanes.
     */
    static EBSMPM_IN_EACH_TARGET type
    totals(const type *vectors);

    /**
     * Transpose the matrix whose rows are #n vectors, for at most four lanes.
     */
    static EBSMPM_IN_EACH_TARGET void
    transpose(type *vectors);

  private:
    typedef double in_memory
      __attribute__((vector_size(n_bytes), aligned(8), may_alias));
  };



  /** How EBSMPM_SHUFFLE tells GCC which numbers. */
  typedef long long LaneNumbers2 __attribute__((vector_size(16)));
  typedef long long LaneNumbers4 __attribute__((vector_size(32)));
  typedef long long LaneNumbers8 __attribute__((vector_size(64)));

  template <>
  EBSMPM_IN_EACH_TARGET auto
  Lanes<16>::totals(const type *v) -> type
  {
    return EBSMPM_SHUFFLE(2, v[0], v[1], 0, 2) +
           EBSMPM_SHUFFLE(2, v[0], v[1], 1, 3);
  }

  template <>
  EBSMPM_IN_EACH_TARGET auto
  Lanes<32>::totals(const type *v) -> type
  {
    const type a = EBSMPM_SHUFFLE(4, v[0], v[1], 0, 4, 2, 6) +
                   EBSMPM_SHUFFLE(4, v[0], v[1], 1, 5, 3, 7);
    const type b = EBSMPM_SHUFFLE(4, v[2], v[3], 0, 4, 2, 6) +
                   EBSMPM_SHUFFLE(4, v[2], v[3], 1, 5, 3, 7);
    return EBSMPM_SHUFFLE(4, a, b, 0, 1, 4, 5) +
           EBSMPM_SHUFFLE(4, a, b, 2, 3, 6, 7);
  }



  template <>
  EBSMPM_IN_EACH_TARGET void
  Lanes<16>::transpose(type *v)
  {
    const type a = v[0], b = v[1];
    v[0] = EBSMPM_SHUFFLE(2, a, b, 0, 2);
    v[1] = EBSMPM_SHUFFLE(2, a, b, 1, 3);
  }

  template <>
  EBSMPM_IN_EACH_TARGET void
  Lanes<32>::transpose(type *v)
  {
    const type a = EBSMPM_SHUFFLE(4, v[0], v[1], 0, 4, 2, 6);
    const type b = EBSMPM_SHUFFLE(4, v[0], v[1], 1, 5, 3, 7);
    const type c = EBSMPM_SHUFFLE(4, v[2], v[3], 0, 4, 2, 6);
    const type d = EBSMPM_SHUFFLE(4, v[2], v[3], 1, 5, 3, 7);
    v[0]         = EBSMPM_SHUFFLE(4, a, c, 0, 1, 4, 5);
    v[1]         = EBSMPM_SHUFFLE(4, b, d, 0, 1, 4, 5);
    v[2]         = EBSMPM_SHUFFLE(4, a, c, 2, 3, 6, 7);
    v[3]         = EBSMPM_SHUFFLE(4, b, d, 2, 3, 6, 7);
  }



  /**
   * For loops that are short, like those over the points of a cell or the
   * functions that it sees: at most #max_n_short_lanes numbers, also where
   * registers are longer.
   */
  template <unsigned int n_bytes>
  using ShortLanes = Lanes<(n_bytes < 32 ? n_bytes : 32)>;

  /** The largest number of lanes of ShortLanes. */
  constexpr unsigned int max_n_short_lanes = 4;



  /** The largest number of lanes, and of doubles in a cache line. */
  constexpr unsigned int max_n_lanes = 8;

  /**
   * Return @p n rounded up to a multiple of #max_n_lanes: the length of a row
   * that vectors fill.
   */
  inline constexpr unsigned int
  padded(const unsigned int n)
  {
    return (n + max_n_lanes - 1) / max_n_lanes * max_n_lanes;
  }



  /** The instructions that kernels are compiled for, from few to many. */
  enum class InstructionSet
  {
    baseline,
    avx2,
    avx512
  };



  /** Return the best one for the machine the program runs on. */
  inline InstructionSet
  best_instruction_set()
  {
#ifdef EBSMPM_HAVE_X86_TARGETS
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"))
      return InstructionSet::avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
      return InstructionSet::avx2;
#endif
    return InstructionSet::baseline;
  }



  /**
   * The one that run_best() uses: the best one, unless a lesser one is assigned
   * to it, as a test does.
   */
  inline InstructionSet &
  instruction_set()
  {
    static InstructionSet result = best_instruction_set();
    return result;
  }



  /** A kernel for machines with AVX-512. */
  template <typename Kernel, typename... Arguments>
  EBSMPM_TARGET_AVX512 auto
  run_avx512(Arguments... arguments)
  {
    return Kernel::template run<64>(arguments...);
  }



  /** A kernel for machines with AVX2. */
  template <typename Kernel, typename... Arguments>
  EBSMPM_TARGET_AVX2 auto
  run_avx2(Arguments... arguments)
  {
    return Kernel::template run<32>(arguments...);
  }



  /** A kernel for all machines. */
  template <typename Kernel, typename... Arguments>
  auto
  run_baseline(Arguments... arguments)
  {
    return Kernel::template run<16>(arguments...);
  }



  /**
   * Run the variant of a kernel for instruction_set(), and return what it
   * returns. Arguments are passed by value.
   */
  template <typename Kernel, typename... Arguments>
  inline auto
  run_best(Arguments... arguments)
  {
    switch (instruction_set())
      {
#ifdef EBSMPM_HAVE_X86_TARGETS
        case InstructionSet::avx512:
          return run_avx512<Kernel>(arguments...);
        case InstructionSet::avx2:
          return run_avx2<Kernel>(arguments...);
#endif
        default:
          return run_baseline<Kernel>(arguments...);
      }
  }
} // namespace EBSMPM

#endif
