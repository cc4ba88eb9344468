#!/bin/bash
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

# Build everything and run the whole test suite; the exit status is that of
# ctest. Arguments are handed to ctest, e.g. "-R splines".

set -euo pipefail
# shellcheck source=contrib/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

case ${1:-} in
  -h | --help)
    cat << END
usage: bash contrib/run-tests.sh [CTEST OPTIONS]

Installs the Debian packages that are missing, builds the library in debug and
release mode in build/tests, and runs all tests, or those that the options
choose, e.g. -R splines.
END
    exit 0
    ;;
esac

install_packages
set_environment

say "Configuring, in build/tests"
configure tests -DCMAKE_BUILD_TYPE=DebugRelease

# The harness puts an empty file with each test, which ctest renames when the
# test is done and again when it comes back: a test that was interrupted is
# thereby recognised and compiled once more. Our tests are compiled before
# ctest, so rename these files as it expects to find them.
rename_guards()
{
  find "$build_root/tests/tests" -name "interrupt_guard.cc$1" -exec \
    sh -c 'for f; do mv "$f" "${f%'"$1"'}'"$2"'"; done' sh {} +
}

say "Building the library and all tests"
rename_guards _bck ""
build tests all
# A test that does not compile is reported by ctest, among the others.
ninja -C "$build_root/tests" -j "$(number_of_jobs)" -k 0 test_programs || true
rename_guards "" _bck

# A test whose program did not change would not run again. Whoever calls this
# script wants to see all of them run.
find "$build_root/tests/tests" \( -name output -o -name diff \) -type f -delete

say "Running the tests"
cd "$build_root/tests"
exec ctest -j "$(number_of_cores)" --output-on-failure "$@"
