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

  private:
    typedef double in_memory
      __attribute__((vector_size(n_bytes), aligned(8), may_alias));
  };



  /** The largest number of lanes. */
  constexpr unsigned int max_n_lanes = 8;



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
   * Run the variant of a kernel that is the best one for the machine the
   * program runs on, and return what it returns. Arguments are passed by value.
   */
  template <typename Kernel, typename... Arguments>
  inline auto
  run_best(Arguments... arguments)
  {
#ifdef EBSMPM_HAVE_X86_TARGETS
    static const bool has_avx512 =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
    static const bool has_avx2 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (has_avx512)
      return run_avx512<Kernel>(arguments...);
    if (has_avx2)
      return run_avx2<Kernel>(arguments...);
#endif
    return run_baseline<Kernel>(arguments...);
  }
} // namespace EBSMPM

#endif
