# shellcheck shell=bash
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

# What quickstart.sh and run-tests.sh have in common; to be sourced by them. It
# defines functions and changes nothing by itself:
#
#   install_packages       make sure that everything needed is there
#   configure FOLDER ...   prepare build/FOLDER, with the given cmake options
#   build FOLDER TARGETS   compile
#
# Nothing outside of the folder of the sources is touched, except by apt.

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_root=$source_dir/build

# Not just "python3": a Python that somebody put into PATH does not see the
# modules that Debian installs.
python=/usr/bin/python3



say()
{
  printf '\n== %s\n' "$*"
}



fail()
{
  printf '\nERROR: %s\n' "$*" >&2
  exit 1
}



# How many cores there are. nproc by itself would count the threads that
# set_environment() allows for.
number_of_cores()
{
  env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc
}



# How many processes to compile with: one per core, as far as the memory goes.
# Compiling a file that uses deal.II takes up to 1.5 GB.
number_of_jobs()
{
  local cores memory
  cores=$(number_of_cores)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo)
  if [ "${memory:-0}" -lt 1 ]; then
    memory=1
  fi
  echo $((memory < cores ? memory : cores))
}



# Print the Debian packages that are missing. What is asked for is the thing
# itself, so that it does not matter where it came from.
missing_packages()
{
  command -v cmake > /dev/null || echo cmake
  command -v ninja > /dev/null || echo ninja-build
  command -v c++ > /dev/null || echo g++
  command -v mpiexec > /dev/null || echo mpi-default-bin
  command -v numdiff > /dev/null || echo numdiff
  command -v perl > /dev/null || echo perl
  "$python" -c 'import numpy' 2> /dev/null || echo python3-numpy
  "$python" -c 'import matplotlib' 2> /dev/null || echo python3-matplotlib

  # A deal.II of one's own is announced by DEAL_II_DIR, as everywhere.
  if [ -z "${DEAL_II_DIR:-}" ] &&
    [ ! -f /usr/share/cmake/deal.II/deal.IIConfig.cmake ] &&
    ! ls /usr/lib/*/cmake/deal.II/deal.IIConfig.cmake \
      /usr/local/lib/cmake/deal.II/deal.IIConfig.cmake > /dev/null 2>&1; then
    echo libdeal.ii-dev
  fi

  # Debian is content with the reference BLAS, which is ten times slower than
  # OpenBLAS. Whichever of the two a program uses is decided when it starts.
  if [ -z "${DEAL_II_DIR:-}" ] &&
    ! ls /usr/lib/*/openblas*/libblas.so.3 > /dev/null 2>&1; then
    echo libopenblas0-serial
  fi
}



# Install what is missing. Only with the rights of root, and only on systems
# that have apt; otherwise say what somebody else has to install.
install_packages()
{
  local packages install
  mapfile -t packages < <(missing_packages)
  if [ ${#packages[@]} -eq 0 ]; then
    return
  fi
  install="apt-get install --no-install-recommends ${packages[*]}"

  if ! command -v apt-get > /dev/null; then
    fail "This system has no apt-get. Please install by other means what \
Debian calls: ${packages[*]}"
  fi

  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo > /dev/null; then
      fail "These packages are missing: ${packages[*]}. You are not root and \
there is no sudo. Please have somebody run '$install'."
    fi
    if [ ! -t 0 ] && ! sudo -n true 2> /dev/null; then
      fail "These packages are missing: ${packages[*]}. sudo would ask for a \
password, and nobody is there to answer. Please run 'sudo $install' first."
    fi
    root=(sudo)
  fi

  say "Installing Debian packages: ${packages[*]}"
  local apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get -o DPkg::Lock::Timeout=300)
  local get=("${apt[@]}" install --yes --no-install-recommends "${packages[@]}")

  # The lists of packages are fetched when there are none or they are too old.
  if ! apt-get install --simulate --no-install-recommends "${packages[@]}" \
    > /dev/null 2>&1; then
    "${apt[@]}" update || fail "apt-get update failed: is there a network?"
    "${get[@]}" || fail "The installation failed: $install"
  else
    "${get[@]}" || { "${apt[@]}" update && "${get[@]}"; } ||
      fail "The installation failed: $install"
  fi

  mapfile -t packages < <(missing_packages)
  if [ ${#packages[@]} -ne 0 ]; then
    fail "Installed, but still not found: ${packages[*]}"
  fi
}



# The environment of all runs: processes and no threads, also as root and also
# more of them than there are cores.
set_environment()
{
  export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 DEAL_II_NUM_THREADS=1
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_rmaps_base_oversubscribe=1
  export OMPI_MCA_btl_vader_single_copy_mechanism=none
  # Where Python and matplotlib keep their caches.
  export PYTHONDONTWRITEBYTECODE=1
  export MPLBACKEND=Agg MPLCONFIGDIR=$build_root/matplotlib
  export NINJA_STATUS="[%f/%t, %es] "
}



configure()
{
  local folder=$build_root/$1
  shift
  # A build folder does not survive that the sources were moved.
  if [ -f "$folder/CMakeCache.txt" ] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$source_dir" \
      "$folder/CMakeCache.txt"; then
    rm -rf "$folder"
  fi
  mkdir -p "$folder"
  if ! cmake -S "$source_dir" -B "$folder" -G Ninja \
    -DEBSMPM_DEBUG_SYMBOLS=OFF "$@" > "$folder/configure.log" 2>&1; then
    cat "$folder/configure.log"
    fail "cmake failed, see above."
  fi
}



build()
{
  local folder=$build_root/$1
  shift
  ninja -C "$folder" -j "$(number_of_jobs)" "$@" ||
    fail "Compiling failed, see above."
}
