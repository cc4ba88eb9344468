// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_tests_instruction_sets_h
#define ebsmpm_tests_instruction_sets_h

#include <ebsmpm/base/lanes.h>



/**
 * Call a function once for each instruction set that kernels are compiled for
 * and that this machine has, with the kernels for it in use.
 */
template <typename Function>
void
for_each_instruction_set(const Function &function)
{
  using EBSMPM::InstructionSet;
  for (const auto set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
    if (set <= EBSMPM::best_instruction_set())
      {
        EBSMPM::instruction_set() = set;
        function();
      }
  EBSMPM::instruction_set() = EBSMPM::best_instruction_set();
}

#endif
