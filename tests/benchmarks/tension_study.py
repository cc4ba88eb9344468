#!/usr/bin/python3
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

"""What the tension test of the paper depends on.

usage: tension_study.py PROGRAM FOLDER [--jobs N] [--table] [CASE ...]

Runs tutorials/step-5/step-5.prm (or coarse.prm) with the changes listed below,
N cases at a time (default 2), each on one process, into FOLDER/CASE, and prints
a table of the peak, of where the load is zero for good, and of the work. Cases
that are there already are not run again; --table runs nothing. At the
resolution of the paper, a case takes between 2 and 30 minutes. The table of all
cases is stored in tension_study.output next to this file.
"""

import study

# Nothing happens any more once the load is gone for good.
BASE = {"": "step-5/step-5.prm", "Loading/Stop below": "1e-12"}

# The notch: a gap of three cells is what step-5.prm says.
DAMAGE = {
    "Body/Shape": "box(0,0, 1,1)",
    "Notch/Type": "damage",
    "Notch/Region": "box(-1,0.5-l/2, 0.5,0.5+l/2)",
}
SLIT = {
    "Body/Shape": "box(0,0, 1,1)",
    "Notch/Type": "slit",
    "Notch/Plane point": "0.5, 0.5",
    "Notch/Plane normal": "0, 1",
}
# With the corner at a multiple of h, the crack runs along a row of control
# points, since there are 125 rows; now it runs between two rows.
SHIFTED = {
    "Background grid/Lower corner": "-3.5*h, -3.5*h",
    "Background grid/Upper corner": "1+4.5*h, 1+4.5*h",
}
DIFFUSIVE = {"Crack partition/Enable": "false"}
ITERATED = {"Loading/Increments": "0.0044: 4e-4, 0.0064: 2e-5"}
LENGTH_016 = {"Damage/Length scale": "0.016"}
LENGTH_024 = {"Damage/Length scale": "0.024"}


def single(du):
    return {
        "Staggered/Maximum passes": "1",
        "Loading/Increments": f"0.0044: 4e-4, 0.0068: {du}",
    }


# Not where round-off decides, in the middle of a cell: between two of them.
def slit_to(x):
    return {"Notch/Region": f"half_space({x},0.5, 1,0)"}


def coarse(n_cells, passes=1):
    return {
        "": "step-5/coarse.prm",
        "Background grid/Cell size": f"1/{n_cells}",
        "Staggered/Maximum passes": str(passes),
    }


TO_THE_PEAK = {"Loading/Increments": "0.003: 2e-4, 0.0058: 2e-5"}


CASES = {
    "gap": [ITERATED],
    "gap-diffusive": [ITERATED, DIFFUSIVE],
    "gap-0.016": [ITERATED, LENGTH_016],
    "gap-0.016-diffusive": [ITERATED, LENGTH_016, DIFFUSIVE],
    "gap-0.024": [ITERATED, LENGTH_024],
    "gap-0.024-diffusive": [ITERATED, LENGTH_024, DIFFUSIVE],
    "gap-shifted": [ITERATED, SHIFTED],
    "gap-single-1e-5": [single("1e-5")],
    "gap-single-5e-6": [single("5e-6")],
    "gap-single-1e-5-diffusive": [single("1e-5"), DIFFUSIVE],
    "gap-paper-penalty": [
        ITERATED,
        {"Nitsche/Penalty": "2e5", "Newton/Indefinite tangent": "accept"},
    ],
    "damage": [ITERATED, DAMAGE],
    "damage-diffusive": [ITERATED, DAMAGE, DIFFUSIVE],
    "slit": [ITERATED, SLIT, slit_to("0.5-h/2")],
    "slit-shifted": [ITERATED, SLIT, slit_to("0.5"), SHIFTED],
    "coarse-single": [coarse(31)],
    "coarse-single-diffusive": [coarse(31), DIFFUSIVE],
    "coarse-iterated": [coarse(31, 500)],
    "coarse-iterated-diffusive": [coarse(31, 500), DIFFUSIVE],
    # A slit ends between two cells. With l fixed, the grid is refined, with a tip
    # at 0.5 - h/2 or 0.5 + h/2 (odd numbers of cells), or at 0.5 (even).
    "coarse-longer": [coarse(31), TO_THE_PEAK, slit_to("0.5+h/2")],
    "coarse-62": [coarse(62), TO_THE_PEAK, slit_to("0.5")],
    "coarse-93": [coarse(93), TO_THE_PEAK, slit_to("0.5-h/2")],
    "coarse-93-longer": [coarse(93), TO_THE_PEAK, slit_to("0.5+h/2")],
    "coarse-124": [coarse(124), TO_THE_PEAK, slit_to("0.5")],
}


def describe(directory):
    """One line of the table."""
    rows = study.read(directory)
    peak = max(rows, key=lambda row: row["force"])
    zero = None
    for row in reversed(rows):
        if abs(row["force"]) > 1e-10 * peak["force"]:
            break
        zero = row["displacement"]
    last = rows[-1]
    separation = "never" if zero is None else f"{zero:.5f}"
    return (
        f"{peak['force']:.4f}  {peak['displacement']:.5f}  {separation:>8}"
        f"  {last['displacement']:.5f}  {last['force'] / peak['force']:10.2e}"
        f"  {len(rows):5d}  {sum(row['passes'] for row in rows):6.0f}"
        f"  {max(row['passes'] for row in rows):6.0f}"
        f"  {last['wall_time']:6.0f}"
    )


if __name__ == "__main__":
    study.main(
        __doc__,
        {name: [BASE] + parts for name, parts in CASES.items()},
        f"{'peak':6}  {'at':7}  {'zero from':8}  {'end':6}"
        f"  {'load there':>10}  steps  passes   worst  time/s",
        describe,
    )
