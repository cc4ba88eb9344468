#!/usr/bin/python3
# ------------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# ------------------------------------------------------------------------------

"""Draw a crack in three dimensions, and the body that it has cut.

    plot_crack_3d.py OUT.png POINTS [--damage D] [--warp FACTOR]

POINTS is a points_*.vtu, or a points_*.pvtu with all its pieces. On the left are
the points with a damage above D (default 0.9), coloured by their height, the
second coordinate: the surface of the crack. On the right are the points of the
surface of the body, displaced FACTOR times (default 50), coloured by damage.

Needs numpy and matplotlib.
"""

import argparse

import matplotlib
import numpy as np

import plot_fields

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def shell(X):
    """Which points are the outermost ones in some direction of an axis."""
    result = np.zeros(len(X), dtype=bool)
    for axis in range(3):
        others = [a for a in range(3) if a != axis]
        columns = np.round(X[:, others], 3)
        _, column = np.unique(columns, axis=0, return_inverse=True)
        column = column.ravel()
        for sign in (1, -1):
            order = np.lexsort((sign * X[:, axis], column))
            last = np.append(np.diff(column[order]) > 0, True)
            result[order[last]] = True
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("output")
    parser.add_argument("points")
    parser.add_argument("--damage", type=float, default=0.9)
    parser.add_argument("--warp", type=float, default=50.0)
    options = parser.parse_args()

    x, fields = plot_fields.read(options.points)
    u, d = fields["displacement"], np.ravel(fields["damage"])
    X = x - u
    figure = plt.figure(figsize=(11, 5), dpi=130)
    pictures = (
        (X[d > options.damage], X[d > options.damage][:, 1], "crack"),
        (*(lambda s: ((X + options.warp * u)[s], d[s]))(shell(X)), "body"),
    )
    for i, (points, colour, title) in enumerate(pictures):
        axes = figure.add_subplot(1, 2, i + 1, projection="3d")
        # The axis of a beam, the third coordinate, is drawn horizontally.
        drawn = axes.scatter(
            points[:, 2],
            points[:, 0],
            points[:, 1],
            c=colour,
            s=2,
            cmap="viridis" if i == 0 else "inferno_r",
        )
        axes.set_box_aspect(np.ptp(points[:, [2, 0, 1]], axis=0))
        axes.set_xlabel("z")
        axes.set_ylabel("x")
        axes.set_zlabel("y")
        axes.view_init(elev=25, azim=-60)
        # Short axes have no room for many numbers.
        axes.locator_params(axis="y", nbins=3)
        axes.locator_params(axis="z", nbins=3)
        figure.colorbar(
            drawn, ax=axes, shrink=0.6, pad=0.15, label="y" if i == 0 else "damage"
        )
        axes.set_title(title)
    figure.tight_layout()
    figure.savefig(options.output)


if __name__ == "__main__":
    main()
