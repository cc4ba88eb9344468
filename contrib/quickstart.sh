#!/bin/bash
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

# From nothing to a broken specimen: see --help.

set -euo pipefail
# shellcheck source=contrib/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"



# ---- What is run -------------------------------------------------------------

# The tension test of the paper, section 4.(1), and what is changed in it unless
# --paper is given: the finest resolution that is done in 20 minutes on two
# cores, with everything that comes before.
parameter_file=$source_dir/tutorials/step-5/step-5.prm
paper_text="the resolution of the paper, h = 0.008 mm"
quick_text="the resolution of the paper, h = 0.008 mm, and fewer fields on disk"
quick_overrides=("Output/Interval = 30")

# Where the runs end, in mm of displacement. The time left is estimated from a
# table of displacements and of the part of the work that is done by then.
paper_progress="0 0  0.0048 0.07  0.00504 0.10  0.00516 0.22  0.00528 0.40  0.0054 0.63  0.00552 0.96  0.0060 1"
quick_progress="0 0  0.0048 0.07  0.00504 0.10  0.00516 0.22  0.00528 0.40  0.0054 0.63  0.00552 0.96  0.0060 1"

# How many times the displacements are magnified in the picture of the crack.
warp=20
fields_arguments=()

# The L-shaped panel, section 4.(2), with --panel; the part of it where the crack
# is, in mm.
panel_file=$source_dir/tutorials/step-6/step-6.prm
panel_text="the resolution of the paper, h = 5 mm"
panel_progress="0 0  8 0.08  9 0.28  10 0.45  12 0.72  15 1"
panel_window=(--zoom 0 200 300 510)

# The two variants: the crack stays a band of damaged material, or it becomes a
# discontinuity.
variants=(PF-MPM PF-MPM-DFG)
declare -A variant_override=(
  [PF-MPM]="Crack partition/Enable = false"
  [PF-MPM-DFG]="Crack partition/Enable = true"
)



# ---- Options -----------------------------------------------------------------

benchmark=tension
resolution=quick
for argument in "$@"; do
  case $argument in
    --panel)
      benchmark=panel
      ;;
    --paper)
      resolution=paper
      ;;
    -h | --help)
      cat << END
usage: bash contrib/quickstart.sh [--paper | --panel]

Installs the Debian packages that are missing, builds ebsmpm in release mode in
build/release, runs the single-edge-notched tension test with the crack as a
damaged band (PF-MPM) and with the transition to a discrete crack (PF-MPM-DFG),
both at the same time, and plots the results, which are in
build/results/tension-<resolution>. Without options this takes at most 20
minutes on two cores; --paper uses the resolution of the paper and takes longer.

With --panel, the L-shaped panel is bent instead, at the resolution of the paper,
and there are pictures of the crack as it opens; this takes about as long.

Calling it again uses what is installed and built already, and replaces the
results.
END
      exit 0
      ;;
    *)
      fail "There is no option '$argument'. Try --help."
      ;;
  esac
done

overrides=()
if [ $benchmark = panel ]; then
  parameter_file=$panel_file
  resolution=paper
  resolution_text=$panel_text
  progress_table=$panel_progress
  warp=1
  fields_arguments=("${panel_window[@]}")
elif [ $resolution = paper ]; then
  resolution_text=$paper_text
  progress_table=$paper_progress
else
  resolution_text=$quick_text
  progress_table=$quick_progress
  for override in ${quick_overrides[@]+"${quick_overrides[@]}"}; do
    overrides+=(--set "$override")
  done
fi
results=$build_root/results/$benchmark-$resolution



# ---- Packages and build ------------------------------------------------------

SECONDS=0
say "1/4 Looking for packages"
install_packages
set_environment

say "2/4 Building in build/release (a few minutes when done for the first time)"
configure release -DCMAKE_BUILD_TYPE=Release -DEBSMPM_BUILD_TESTS=OFF \
  -DEBSMPM_BUILD_TUTORIALS=OFF
build release ebsmpm
program=$build_root/release/bin/ebsmpm



# ---- Runs --------------------------------------------------------------------

# The cores are shared by the two runs. Processes must not be bound to cores,
# because the second run would be bound to those of the first.
ranks=$(($(number_of_cores) / ${#variants[@]}))
if [ $ranks -gt 8 ]; then
  ranks=8
fi
launcher=()
if [ $ranks -gt 1 ]; then
  launcher=(mpiexec --bind-to none -n "$ranks")
fi

say "3/4 Benchmark '$benchmark', ${variants[0]} and ${variants[1]}, with $resolution_text"
rm -rf "$results"
declare -A process
stop_runs()
{
  local id
  for id in ${process[@]+"${process[@]}"}; do
    kill "$id" 2> /dev/null || true
  done
}
trap stop_runs EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

for variant in "${variants[@]}"; do
  mkdir -p "$results/$variant"
  ${launcher[@]+"${launcher[@]}"} "$program" "$parameter_file" \
    ${overrides[@]+"${overrides[@]}"} \
    --set "${variant_override[$variant]}" \
    --set "Output/Directory = $results/$variant" \
    > "$results/$variant.log" 2>&1 &
  process[$variant]=$!
done

# Print how far the given run is: displacement, percentage of the work, and the
# seconds left, from the last line of its history and the seconds it has run.
progress()
{
  local history=$results/$1/history.csv
  if [ ! -s "$history" ]; then
    echo "0 0 0"
    return
  fi
  tail -n 1 "$history" | awk -F, -v table="$progress_table" -v time="$2" '
    {
      u = $2 + 0
      n = split(table, t, " ")
      part = u >= t[n - 1] ? 1 : 0
      for (i = 1; i + 2 < n; i += 2)
        if (u >= t[i] && u < t[i + 2])
          part = t[i + 1] \
                 + (t[i + 3] - t[i + 1]) * (u - t[i]) / (t[i + 2] - t[i])
      left = part > 0 ? time * (1 - part) / part : 0
      printf "%.5f %.0f %.0f\n", u, 100 * part, left
    }'
}

minutes()
{
  printf '%d:%02d' $(($1 / 60)) $(($1 % 60))
}

start=$SECONDS
last_report=-1000
if [ -t 1 ]; then
  pause=2 interval=0 end_of_line='\r'
else
  pause=2 interval=30 end_of_line='\n'
fi
running=1
while [ $running -eq 1 ]; do
  sleep $pause
  running=0
  line="  $(minutes $((SECONDS - start)))"
  longest=0
  for variant in "${variants[@]}"; do
    read -r displacement percent left < <(progress "$variant" \
      $((SECONDS - start)))
    if kill -0 "${process[$variant]}" 2> /dev/null; then
      running=1
      line+="   $variant: u = $displacement mm, $percent %"
      if [ "$left" -gt "$longest" ]; then
        longest=$left
      fi
    else
      line+="   $variant: u = $displacement mm, ended"
    fi
  done
  if [ "$longest" -gt 0 ]; then
    line+="   about $(minutes "$longest") left"
  fi
  if [ $running -eq 0 ] || [ $((SECONDS - last_report)) -ge $interval ]; then
    printf "%-78s$end_of_line" "$line"
    last_report=$SECONDS
  fi
done
if [ -t 1 ]; then
  printf '\n'
fi

failed=()
for variant in "${variants[@]}"; do
  if ! wait "${process[$variant]}"; then
    failed+=("$variant")
    printf '\n-- the end of %s\n' "$results/$variant.log" >&2
    tail -n 20 "$results/$variant.log" >&2
  fi
  unset "process[$variant]"
done
if [ ${#failed[@]} -ne 0 ]; then
  fail "Did not finish: ${failed[*]}. What they wrote is in $results."
fi



# ---- Pictures ----------------------------------------------------------------

say "4/4 Plotting"
mkdir -p "$MPLCONFIGDIR"
history_arguments=()
for variant in "${variants[@]}"; do
  history_arguments+=("$variant" "$results/$variant/history.csv")
done
"$python" "$source_dir/contrib/plot_history.py" \
  "$results/load-displacement.png" "${history_arguments[@]}"

last_points=()
labels=()
for variant in "${variants[@]}"; do
  last=$(find "$results/$variant" -name 'points_*.pvtu' | sort | tail -n 1)
  if [ -z "$last" ]; then
    fail "There are no points in $results/$variant."
  fi
  last_points+=("$last")
  labels+=(--label "$variant")
done
plot_fields()
{
  "$python" "$source_dir/contrib/plot_fields.py" "$@" \
    ${fields_arguments[@]+"${fields_arguments[@]}"}
}
plot_fields "$results/damage.png" "${last_points[@]}" "${labels[@]}" \
  --field damage
if [ "$warp" -gt 1 ]; then
  title=(--title "Displacements magnified $warp times")
else
  title=()
fi
plot_fields "$results/opened-crack.png" "${last_points[@]}" "${labels[@]}" \
  --field damage --warp "$warp" ${title[@]+"${title[@]}"}

# The discrete crack as it opens, by damage and by side: four times, the last one
# included.
mapfile -t all_points < <(find "$results/${variants[1]}" -name 'points_*.pvtu' \
  | sort)
n=${#all_points[@]}
opening=()
for k in 1 2 3 4; do
  opening+=("${all_points[$(((n * k + 3) / 4 - 1))]}")
done
plot_fields "$results/opening-by-damage.png" "${opening[@]}" \
  --field damage --warp "$warp"
# The component along y of the side vectors has another sign on either side.
plot_fields "$results/opening-by-side.png" "${opening[@]}" \
  --field side --component 1 --warp "$warp"

say "Done in $(minutes $SECONDS) minutes, with $resolution_text"
cat << END
  $results/
    load-displacement.png          the curves of both variants
    damage.png                     the damage at the end
    opened-crack.png               the same, at the displacements times $warp
    opening-by-damage.png          the discrete crack as it opens
    opening-by-side.png            the same, coloured by the sides of the points
    <variant>/history.csv          load, energies, crack length, step by step
    <variant>/points.pvd, *.pvd    for ParaView
    <variant>.log                  what the program printed
  where <variant> is ${variants[0]} or ${variants[1]}.
END
