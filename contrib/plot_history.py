#!/usr/bin/python3
# ------------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# ------------------------------------------------------------------------------

"""Draw load-displacement curves from the history.csv of one or more runs.

    plot_history.py OUT.png LABEL1 history1.csv [LABEL2 history2.csv ...]
                    [--title TEXT] [--mark LABEL U F] [--xlabel TEXT]
                    [--ylabel TEXT]

The peak of each curve is marked and given in the legend. --mark adds a point
for comparison, such as a published peak; it can be repeated. The kind of
picture follows from the name of the output: png, pdf or svg.

Needs numpy and matplotlib.
"""

import argparse
import csv
import sys


class InputError(Exception):
    """What the user has to correct, in one sentence."""


def read_history(filename):
    """Return displacement and force, two lists of the same length.

    A last line that is not complete, because the run is still going on, is
    left out.
    """
    try:
        with open(filename, newline="") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or "it is no table"
        raise InputError(f"The file '{filename}' cannot be read: {reason}.")

    header = [name.strip() for name in rows[0]] if rows else []
    for name in ("displacement", "force"):
        if name not in header:
            raise InputError(f"The file '{filename}' has no column '{name}'.")
    u, f = header.index("displacement"), header.index("force")

    displacements, forces = [], []
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(header):
            if number == len(rows):
                break
            raise InputError(f"Line {number} of '{filename}' has {len(row)} "
                             f"entries instead of {len(header)}.")
        try:
            displacements.append(float(row[u]))
            forces.append(float(row[f]))
        except ValueError:
            raise InputError(f"Line {number} of '{filename}' has an entry "
                             "that is not a number.")
    if not forces:
        raise InputError(f"The file '{filename}' has no line with numbers.")
    return displacements, forces


def parse_arguments(arguments):
    """Return the options and a list of pairs (label, file)."""
    parser = argparse.ArgumentParser(
        usage=__doc__.split("\n\n")[1].strip(),
        description=__doc__.split("\n")[0])
    parser.add_argument("output", metavar="OUT.png")
    parser.add_argument("curves", nargs="+", metavar="LABEL history.csv")
    parser.add_argument("--title", default="")
    parser.add_argument("--xlabel", default="displacement")
    parser.add_argument("--ylabel", default="force")
    parser.add_argument("--mark", nargs=3, action="append", default=[],
                        metavar=("LABEL", "U", "F"))

    def refuse(message):
        raise InputError(f"The arguments are wrong: {message}.")

    parser.error = refuse
    options = parser.parse_intermixed_args(arguments)

    if len(options.curves) % 2 != 0:
        raise InputError("Each history.csv must have a label in front of it; "
                         f"'{options.curves[-1]}' is alone.")
    marks = []
    for label, u, f in options.mark:
        try:
            marks.append((label, float(u), float(f)))
        except ValueError:
            raise InputError(f"The mark '{label}' needs two numbers, not "
                             f"'{u}' and '{f}'.")
    options.mark = marks
    return options, list(zip(options.curves[::2], options.curves[1::2]))


def plot(options, curves):
    """Draw all curves and save the picture."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({
        "font.size": 9,
        "axes.linewidth": 0.8,
        "xtick.direction": "in",
        "ytick.direction": "in",
        "xtick.top": True,
        "ytick.right": True,
        "legend.frameon": False,
        "legend.fontsize": 8,
    })
    # Okabe and Ito's colours, which everybody can tell apart; the styles of
    # the lines do it without colours.
    colours = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00",
               "#56B4E9", "#000000"]
    styles = ["-", "--", "-.", ":"]
    markers = ["x", "+", "1", "2", "*"]

    # A long legend would cover the curves.
    is_long = len(curves) + len(options.mark) > 6
    figure, axes = plt.subplots(figsize=(7.6 if is_long else 5.2, 3.6),
                                constrained_layout=True)
    for i, (label, (displacements, forces)) in enumerate(curves):
        colour = colours[i % len(colours)]
        peak = max(range(len(forces)), key=forces.__getitem__)
        axes.plot(displacements, forces, color=colour, linewidth=1.3,
                  linestyle=styles[i % len(styles)],
                  label=f"{label}: peak {forces[peak]:.4g} at "
                        f"{displacements[peak]:.4g}")
        axes.plot(displacements[peak], forces[peak], "o", color=colour,
                  markersize=4, markerfacecolor="white", zorder=3)
    for i, (label, u, f) in enumerate(options.mark):
        axes.plot(u, f, markers[i % len(markers)], color="black",
                  markersize=7, linestyle="none", label=label, zorder=4,
                  clip_on=False)

    axes.set_xlabel(options.xlabel)
    axes.set_ylabel(options.ylabel)
    axes.set_title(options.title, fontsize=10)
    if all(min(u) >= 0 for _, (u, _) in curves):
        axes.set_xlim(left=0)
    if all(min(f) >= -1e-6 * max(f) for _, (_, f) in curves):
        axes.set_ylim(bottom=0)
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-4, 4),
                          useMathText=True)
    axes.margins(y=0.1)
    if is_long:
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    else:
        axes.legend(loc="best")
    try:
        figure.savefig(options.output, dpi=250)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error).split("\n")[0]
        raise InputError(f"The picture '{options.output}' cannot be written: "
                         f"{reason}.")


def main():
    try:
        options, files = parse_arguments(sys.argv[1:])
        plot(options, [(label, read_history(name)) for label, name in files])
    except InputError as error:
        sys.exit(f"plot_history.py: {error}")
    except ImportError as error:
        sys.exit("plot_history.py: The Python package "
                 f"'{error.name}' is not installed.")


if __name__ == "__main__":
    main()
