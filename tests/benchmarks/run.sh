#!/bin/bash
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

# Compile the benchmark programs and run them, in two and three dimensions, on
# one and two processes: about fifteen minutes on a machine with nothing else to
# do. The tables go to the screen and to build/results/benchmarks.txt.
#
# usage: bash tests/benchmarks/run.sh

set -euo pipefail

# shellcheck source=../../contrib/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../contrib/setup.sh"

install_packages
set_environment
configure release -DCMAKE_BUILD_TYPE=Release -DEBSMPM_DEBUG_SYMBOLS=OFF
build release benchmarks

programs=$build_root/release/tests/benchmarks
mkdir -p "$build_root/results"

run()
{
  local processes=$1 program=$2
  shift 2
  printf '\n== %s %s, %s process(es)\n' "$program" "$*" "$processes"
  mpiexec --bind-to none -np "$processes" "$programs/$program" "$@"
}

{
  for processes in 1 2; do
    run $processes assembly 2 3 64 3 # 9 points per cell
    run $processes assembly 3 2 8 3  # 8
    run $processes assembly 3 3 8 2  # 27
    run $processes linear_solver 128
    run $processes multigrid 3 8 3
  done
} 2>&1 | tee "$build_root/results/benchmarks.txt"
