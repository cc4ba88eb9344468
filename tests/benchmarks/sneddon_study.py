#!/usr/bin/python3
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

"""Cracks under inner pressure, compared with Sneddon (1946).

usage: sneddon_study.py PROGRAM FOLDER [--jobs N] [--table] [CASE ...]

Runs sneddon_line.prm and sneddon_penny.prm with the changes listed below, N cases
at a time (default 2), each on one process, into FOLDER/CASE, and prints a table
of the volume of the opened crack over that of the formula, and of the work of the
pressure over twice the elastic energy. The largest case, wedge-10-10, takes 18 GB.
The table of all cases is stored in sneddon_study.output.

Names of cases: line-N, penny-N or wedge-N for h = a/N, where the wedge is a penny
with trilinear functions on an eighth of the box; then half the width of the box, in
units of a; then the position of the tip in its cell, in units of h, if
functions are separable up to 0.45 h from the tip, or what else is different.
"""

import math

import study

NU2 = 0.05
PRESSURE = 1e-3
EXACT = {
    "line": math.pi * (1 - NU2) * PRESSURE,
    "penny": 4 * (1 - NU2) / 3 * PRESSURE,
    "wedge": 2 * (1 - NU2) / 3 * PRESSURE,
}


def line(n, width=10, shift=0.25, **changes):
    # Right of the axis, the tip is shift*h beyond a line of the grid.
    return {
        "": "../tests/benchmarks/sneddon_line.prm",
        "Background grid/Cell size": f"1/{n}",
        "Background grid/Lower corner": f"{-3 - shift}*h, {-width}-3*h",
        "Background grid/Upper corner": f"{width}+3*h, {width}+3*h",
        "Body/Shape": f"box(0,{-width}, {width},{width})",
        **changes,
    }


def penny(n, width, **changes):
    return {
        "": "../tests/benchmarks/sneddon_penny.prm",
        "Background grid/Cell size": f"1/{n}",
        "Background grid/Lower corner": f"-2*h, -2*h, {-width}-2*h",
        "Background grid/Upper corner": f"{width}+2*h, {width}+2*h, {width}+2*h",
        "Body/Shape": f"box(0,0,{-width}, {width},{width},{width})",
        **changes,
    }


def wedge(n, width):
    # Half of the quarter, with the diagonal plane as a plane of symmetry. It lies
    # midway between the points if the lines of the grid are h/4 beyond the axis;
    # an even number of points per cell keeps that near the crack.
    return {
        "": "../tests/benchmarks/sneddon_penny.prm",
        "Background grid/Degree": "1",
        "Background grid/Cell size": f"1/{n}",
        "Background grid/Lower corner": f"-2*h+h/4, -2*h, {-width}-2*h",
        "Background grid/Upper corner": f"{width}+2*h+h/4, {width}+2*h, {width}+2*h",
        "Body/Shape": f"box(0,0,{-width}, {width}+h/4,{width}+h/4,{width}) & "
        "half_space(0,0,0, -1,1,0)",
        "Body/Regions": "6: box(-1,-1,-0.3, 1.4,1.4,0.3)",
        "Body/Boundaries": "diagonal: nx < -0.5; y: ny < -0.5; "
        "top: nz > 0.5; bottom: nz < -0.5",
        "Loading/Conditions": "diagonal.normal = 0; y.y = 0; top.z = 0; bottom.z = 0",
        "Linear solver/Displacement": "CG+IC",
    }


# The outer surface free instead of held in the normal direction: a strip ahead of
# the crack, which symmetry keeps in its place anyway, holds the body.
FREE_LINE = {
    "Body/Boundaries": "axis: nx < -0.5; ahead: nx > 0.5 && abs(y) < 0.1",
    "Loading/Conditions": "axis.x = 0; ahead.y = 0",
    "Loading/Driven boundary": "ahead.y",
}
FREE_PENNY = {
    "Body/Boundaries": "x: nx < -0.5; y: ny < -0.5; "
    "ahead: nx > 0.5 && abs(z) < 0.2",
    "Loading/Conditions": "x.x = 0; y.y = 0; ahead.z = 0",
    "Loading/Driven boundary": "ahead.z",
}
MARGIN = {"Notch/Tip margin": "0.45*h"}

CASES = {
    **{f"line-{n}-10": [line(n)] for n in (5, 10, 20)},
    **{
        f"line-10-10-{shift}": [line(10, shift=shift), MARGIN]
        for shift in (0.0, 0.25, 0.5, 0.75)
    },
    "line-10-10-free": [line(10), FREE_LINE],
    "line-10-5": [line(10, 5)],
    "line-10-20": [line(10, 20)],
    **{f"penny-5-{width}": [penny(5, width)] for width in (3, 4, 5, 6)},
    "penny-5-4-free": [penny(5, 4), FREE_PENNY],
    "penny-8-4": [penny(8, 4)],
    "penny-10-4": [penny(10, 4)],
    **{f"penny-{n}-3": [penny(n, 3)] for n in (8, 10, 12, 14, 16)},
    **{f"wedge-{n}-10": [wedge(n, 10)] for n in (5, 8, 10)},
    **{f"wedge-{n}-3": [wedge(n, 3)] for n in (8, 10, 12, 14, 16)},
}


def describe(directory):
    last = study.read(directory)[-1]
    kind = directory.rstrip("/").split("/")[-1].split("-")[0]
    volume = last["opened_volume"]
    return (
        f"{volume / EXACT[kind]:8.4f}  "
        f"{PRESSURE * volume / (2 * last['elastic_energy']):8.5f}  "
        f"{last['independent_functions']:9.0f}  {last['twin_functions']:6.0f}  "
        f"{last['wall_time']:7.0f} s"
    )


if __name__ == "__main__":
    study.main(
        __doc__,
        CASES,
        "volume    work/2E   functions   twins     time",
        describe,
    )
