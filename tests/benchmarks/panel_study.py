#!/usr/bin/python3
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

"""What the L-shaped panel depends on.

usage: panel_study.py PROGRAM FOLDER [--jobs N] [--table] [CASE ...]

Runs the parameter files of tutorials/step-6 with the changes listed below, N
cases at a time (default 2), each on one process, into FOLDER/CASE, and prints a
table: the peak of the load and where it is, the load at some displacements, the
path of the crack (its height above the inner corner, at distances to the left
of it, both in mm in the undeformed body), the largest Lebesgue constant of an
extension, Newton iterations, and time. Cases that are there already are not run
again; --table runs nothing. Most cases take less than five minutes. The table of
all cases is stored in panel_study.output next to this file.
"""

import glob
import math
import os
import sys

import numpy as np

import study

sys.path.insert(0, os.path.join(study.SOURCE, "contrib"))
import plot_fields  # noqa: E402

FINE = {"": "step-6/step-6.prm"}
COARSE = {"": "step-6/coarse.prm"}
CONCRETE = {"": "step-6/concrete.prm"}
DIFFUSIVE = {"Crack partition/Enable": "false"}
ITERATED = {"Staggered/Maximum passes": "1000", "Loading/Increments": "15: 0.1"}

# The paper: 13 x 13 points per cell around the path, and 6 x 6 elsewhere.
DENSE = {
    "Body/Points per direction": "6",
    "Body/Regions": "13: box(0,220, 290,450)",
}
SHIFTED = {
    "Background grid/Lower corner": "-2.5*h, -2.5*h",
    "Background grid/Upper corner": "500+5.5*h, 500+6.5*h",
}
REFINED = {
    "Background grid/Cell size": "2.5",
    "Background grid/Upper corner": "500+10*h, 500+10*h",
    "Body/Points per direction": "3",
    "Body/Regions": "6: box(0,220, 290,450)",
}

HALF_STEPS = {"Loading/Increments": "8: 0.5, 9.5: 0.1"}

# The specimen turned by 20 degrees about its lower left corner.
ANGLE = 20
C, S = (f(math.radians(ANGLE)) for f in (math.cos, math.sin))
BACK_X, BACK_Y = f"({C}*x+{S}*y)", f"({C}*y-{S}*x)"


def rotated(shape):
    return f"rotate({math.radians(ANGLE)}, {shape})"


ROTATED = {
    "Background grid/Lower corner": "-190, -20",
    "Background grid/Upper corner": "510, 680",
    "Body/Shape": rotated("box(0,0, 500,500) - box(250,-10, 510,250)"),
    "Body/Regions": "8: " + rotated("box(0,220, 290,450)"),
    "Body/Undamageable": rotated("half_space(400,0, -1,0)"),
    "Body/Boundaries": f"bottom: {BACK_Y} < 1e-6; "
    f"strip: {BACK_Y} > 500-1e-6 && {BACK_X} > 470",
    "Loading/Conditions": "bottom.x = 0; bottom.y = 0; "
    f"strip.x = -{S}*u; strip.y = {C}*u",
}

CASES = {
    "fine": [FINE],
    "fine-diffusive": [FINE, DIFFUSIVE],
    "dense": [FINE, DENSE],
    "dense-diffusive": [FINE, DENSE, DIFFUSIVE],
    "dense-0.001": [FINE, DENSE, {"Extension/Threshold": "0.001"}],
    "shifted": [FINE, SHIFTED],
    "rotated": [FINE, ROTATED],
    # The same increments for both: at h = 2.5 mm, a step of 1 mm is cut back.
    "fine-0.5": [FINE, HALF_STEPS],
    "refined-0.5": [FINE, REFINED, HALF_STEPS],
    "coarse": [COARSE],
    "coarse-diffusive": [COARSE, DIFFUSIVE],
    "coarse-iterated": [COARSE, ITERATED],
    "coarse-iterated-diffusive": [COARSE, ITERATED, DIFFUSIVE],
    "fine-iterated": [FINE, ITERATED],
}
# The fracture energy with which the converged curve peaks at 8 mm.
for gc in ("0.30", "0.40", "0.50"):
    CASES[f"coarse-iterated-{gc}"] = [COARSE, ITERATED, {"Damage/Fracture energy": gc}]
# Thresholds and penalties.
for phi in ("0.001", "0.01", "0.05", "0.15"):
    CASES[f"coarse-phi-{phi}"] = [COARSE, {"Extension/Threshold": phi}]
for beta in ("10", "50", "100", "1000"):
    CASES[f"coarse-beta-{beta}"] = [COARSE, {"Nitsche/Penalty factor": beta}]
ACCEPT = {"Newton/Indefinite tangent": "accept"}
CASES["coarse-phi-0.001-beta-1000"] = [
    COARSE,
    {"Extension/Threshold": "0.001", "Nitsche/Penalty factor": "1000"},
]
CASES["coarse-phi-0.001-accept"] = [
    COARSE,
    {"Extension/Threshold": "0.001"},
    ACCEPT,
]
CASES["dense-0.001-beta-1000"] = [
    FINE,
    DENSE,
    {"Extension/Threshold": "0.001", "Nitsche/Penalty factor": "1000"},
]
CASES["concrete"] = [CONCRETE]
CASES["concrete-diffusive"] = [CONCRETE, DIFFUSIVE]
CASES["concrete-33"] = [CONCRETE, {"Damage/Length scale": "33"}]


def turn(vectors, angle):
    c, s = math.cos(angle), math.sin(angle)
    return vectors @ np.array([[c, s], [-s, c]])


def path(directory, distances=(25, 50, 100)):
    """The height of the crack at distances to the left of the corner."""
    names = sorted(glob.glob(os.path.join(directory, "points_*.pvtu")))
    positions, fields = plot_fields.read(names[-1])
    reference = positions[:, :2] - fields["displacement"][:, :2]
    if "rotated" in directory:
        reference = turn(reference, math.radians(-ANGLE))
    damage = fields["damage"][:, 0]
    heights = []
    for distance in distances:
        near = np.abs(reference[:, 0] - (250 - distance)) < 3
        weights = np.maximum(damage[near] - 0.8, 0) ** 2
        if weights.sum() == 0:
            heights.append("    -")
        else:
            height = (weights * reference[near, 1]).sum() / weights.sum() - 250
            heights.append(f"{height:5.1f}")
    return heights


def describe(directory):
    """One line of the table."""
    rows = study.read(directory)
    if "rotated" in directory:
        for row in rows:
            row["force"] = C * row["force_strip_y"] - S * row["force_strip_x"]
    peak = max(rows, key=lambda row: row["force"])

    def force_at(u):
        found = [row for row in rows if abs(row["displacement"] - u) < 1e-6]
        return f"{found[0]['force']:7.3f}" if found else "      -"

    heights = path(directory)
    return (
        f"{peak['force']:7.3f}  {peak['displacement']:5.2f}"
        f"  {force_at(4)}  {force_at(8)}  {force_at(10)}  {force_at(12)}"
        f"  {force_at(15)}  {'  '.join(heights)}"
        f"  {max(row['largest_extension_weight'] for row in rows):7.0f}"
        f"  {sum(row['passes'] for row in rows):6.0f}"
        f"  {sum(row['newton_iterations'] for row in rows):6.0f}"
        f"  {rows[-1]['wall_time']:6.0f}"
    )


if __name__ == "__main__":
    study.main(
        __doc__,
        CASES,
        f"{'peak':>7}  {'at':>5}  {'F(4)':>7}  {'F(8)':>7}  {'F(10)':>7}"
        f"  {'F(12)':>7}  {'F(15)':>7}  {'y25':>5}  {'y50':>5}  {'y100':>5}"
        f"  {'weight':>7}  passes  newton  time/s",
        describe,
    )
