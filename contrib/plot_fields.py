#!/usr/bin/python3
# ------------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# ------------------------------------------------------------------------------

"""Draw material points at their current positions, coloured by a field.

    plot_fields.py OUT.png FILE [FILE ...] --field NAME [--component K]
                   [--warp FACTOR] [--zoom X0 Y0 X1 Y1] [--limits LOW HIGH]
                   [--label TEXT ...] [--title TEXT]

Each FILE is a points_*.vtu, or a points_*.pvtu with all its pieces, and gets a
panel of its own. --warp exaggerates the displacement: a point is drawn at
x + (FACTOR-1) u. Of a vector, the length is drawn, or component K = 0, 1, 2.
--zoom shows a part of the picture, in the coordinates that are drawn. The
colours are the same in all panels; --limits fixes what they mean. --label
names a panel, in the order of the files. In 3d, one looks along -z.

Needs numpy and matplotlib; the files are decoded here.
"""

import argparse
import base64
import os
import sys
import xml.etree.ElementTree
import zlib

import numpy as np


class InputError(Exception):
    """What the user has to correct, in one sentence."""


# ------------------------------ reading of files ------------------------------

TYPES = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1",
         "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8"}


def decompress(text, header_type):
    """Return the bytes behind a compressed array.

    The text consists of two base64 streams: a header with the number of
    blocks, the sizes of all but the last block and of the last one, and the
    compressed sizes; and the blocks themselves, compressed by zlib.
    """
    width = header_type.itemsize

    def characters(n_bytes):
        return 4 * ((n_bytes + 2) // 3)

    start = base64.b64decode(text[:characters(width)])
    n_blocks = int(np.frombuffer(start[:width], header_type)[0])
    header_size = characters((3 + n_blocks) * width)
    header = np.frombuffer(base64.b64decode(text[:header_size]), header_type)
    data = base64.b64decode(text[header_size:])

    result, position = [], 0
    for size in header[3:3 + n_blocks].astype(int):
        result.append(zlib.decompress(data[position:position + size]))
        position += size
    return b"".join(result)


def decode(element, root):
    """Return the contents of a DataArray as a table with a row per point."""
    kind = TYPES.get(element.get("type"))
    if kind is None:
        raise ValueError(f"unknown type {element.get('type')}")
    order = "<" if root.get("byte_order") == "LittleEndian" else ">"
    text = "".join((element.text or "").split()) \
        if element.get("format") == "binary" else (element.text or "")

    if element.get("format") == "ascii":
        values = np.array(text.split(), dtype=kind)
    elif element.get("format") == "binary" and root.get("compressor"):
        header_type = np.dtype(
            order + TYPES[root.get("header_type", "UInt32")])
        values = np.frombuffer(decompress(text, header_type), order + kind)
    else:
        raise ValueError("arrays are neither ascii nor zlib-compressed")
    n_components = int(element.get("NumberOfComponents") or 1)
    return values.reshape(-1, n_components).astype(float)


def read_vtu(filename):
    """Return positions and a dictionary of fields of one file."""
    root = xml.etree.ElementTree.parse(filename).getroot()
    positions, fields = [], {}
    for piece in root.iter("Piece"):
        if int(piece.get("NumberOfPoints", 0)) == 0:
            continue
        positions.append(decode(piece.find("Points/DataArray"), root))
        for element in piece.findall("PointData/DataArray"):
            fields.setdefault(element.get("Name"), []).append(
                decode(element, root))
    return positions, fields


def read(filename):
    """Return positions and fields of a VTU file, or of all pieces of a PVTU."""
    try:
        names = [filename]
        if filename.endswith(".pvtu"):
            root = xml.etree.ElementTree.parse(filename).getroot()
            folder = os.path.dirname(filename)
            names = [os.path.join(folder, piece.get("Source"))
                     for piece in root.iter("Piece")]
        positions, fields = [], {}
        for name in names:
            some_positions, some_fields = read_vtu(name)
            positions += some_positions
            for key, values in some_fields.items():
                fields.setdefault(key, []).extend(values)
    except OSError as error:
        raise InputError(f"The file '{error.filename or filename}' cannot be "
                         f"read: {error.strerror}.")
    except (xml.etree.ElementTree.ParseError, ValueError, TypeError, KeyError,
            AttributeError, IndexError, zlib.error) as error:
        raise InputError(f"The file '{filename}' is not a VTU file as deal.II "
                         f"writes it: {error}.")
    if not positions:
        raise InputError(f"The file '{filename}' has no points.")
    return (np.concatenate(positions),
            {key: np.concatenate(values) for key, values in fields.items()})


# ---------------------------------- drawing -----------------------------------

def select(fields, name, component, filename):
    """Return one number per point: the field, its component or its length."""
    if name not in fields:
        raise InputError(f"The file '{filename}' has no field '{name}', but "
                         + ", ".join(sorted(fields)) + ".")
    values = fields[name]
    if component is not None:
        if not 0 <= component < values.shape[1]:
            raise InputError(f"The field '{name}' has {values.shape[1]} "
                             f"components, counted from 0; there is no "
                             f"component {component}.")
        return values[:, component]
    if values.shape[1] == 1:
        return values[:, 0]
    return np.linalg.norm(values, axis=1)


def widths(positions, fields, in_2d):
    """Return the width of each point: of its square or cube of material."""
    if "reference_volume" in fields:
        volumes = np.maximum(fields["reference_volume"][:, 0], 0)
        return volumes ** (1 / 2 if in_2d else 1 / 3)
    extent = np.ptp(positions[:, :2 if in_2d else 3], axis=0)
    extent = extent[extent > 0]
    if extent.size == 0:
        return np.ones(len(positions))
    spacing = (np.prod(extent) / len(positions)) ** (1 / extent.size)
    return np.full(len(positions), spacing)


def prepare(filename, options):
    """Return a panel: what is to be drawn of a file."""
    positions, fields = read(filename)
    values = select(fields, options.field, options.component, filename)
    in_2d = not np.any(positions[:, 2])
    width = widths(positions, fields, in_2d)

    drawn = positions
    if options.warp != 1:
        if "displacement" not in fields:
            raise InputError(f"The file '{filename}' has no field "
                             "'displacement' and cannot be warped.")
        drawn = positions + (options.warp - 1) * fields["displacement"]

    # From back to front; in 2d, what has the larger value is on top.
    order = np.argsort(values if in_2d else drawn[:, 2], kind="stable")
    return drawn[order, :2], values[order], width[order]


def colour_limits(panels, boxes, options):
    """Return the values at the ends of the colour bar."""
    if options.limits is not None:
        return options.limits
    if options.field in ("damage", "peak_damage"):
        return 0, 1
    visible = []
    for (positions, values, _), box in zip(panels, boxes):
        inside = np.all((positions >= box[:2]) & (positions <= box[2:]),
                        axis=1)
        visible.append(values[inside])
    visible = np.concatenate(visible)
    if visible.size == 0:
        raise InputError("No point is in the part that is to be shown.")
    return np.min(visible), np.max(visible)


def plot(panels, options):
    """Draw all panels and save the picture."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"font.size": 8, "axes.linewidth": 0.6})

    boxes = []
    for positions, _, width in panels:
        if options.zoom is not None:
            boxes.append(options.zoom)
        else:
            margin = width[:, None]
            corners = [np.min(positions - margin, axis=0),
                       np.max(positions + margin, axis=0)]
            boxes.append([*corners[0], *corners[1]])

    low, high = colour_limits(panels, boxes, options)
    n_columns = min(len(panels), 3)
    n_rows = -(-len(panels) // n_columns)
    ratio = max((b[3] - b[1]) / (b[2] - b[0]) for b in boxes)
    panel_width = 6.5 / max(n_columns, 1.6)
    panel_height = panel_width * min(max(ratio, 0.2), 2.5)
    figure, all_axes = plt.subplots(
        n_rows, n_columns, squeeze=False, constrained_layout=True,
        figsize=(panel_width * n_columns + 0.9,
                 (panel_height + 0.45) * n_rows))

    for axes, box in zip(all_axes.flat, boxes):
        axes.set_xlim(box[0], box[2])
        axes.set_ylim(box[1], box[3])
        axes.set_aspect("equal")
        axes.locator_params(nbins=5)
    for axes in list(all_axes.flat)[len(panels):]:
        axes.set_visible(False)

    scatters = []
    for i, (axes, (positions, values, width)) in enumerate(
            zip(all_axes.flat, panels)):
        scatters.append(axes.scatter(
            positions[:, 0], positions[:, 1], c=values, s=1, marker="s",
            linewidths=0, vmin=low, vmax=high, cmap="viridis",
            rasterized=True, antialiased=False))
        if i < len(options.label):
            axes.set_title(options.label[i], fontsize=9)
    name = options.field.replace("_", " ")
    if options.component is not None:
        name += f", component {options.component}"
    figure.colorbar(scatters[0], ax=all_axes, label=name, shrink=0.8,
                    aspect=30)
    figure.suptitle(options.title or None, fontsize=10)

    # The sizes of the markers are in units of the paper: they can be given
    # only now that everything has its place. A little overlap hides the seams.
    figure.canvas.draw()
    for axes, scatter, (_, _, width) in zip(all_axes.flat, scatters, panels):
        unit = axes.transData.transform([(0, 0), (1, 0)])
        paper = 72 / figure.dpi * (unit[1, 0] - unit[0, 0])
        scatter.set_sizes((1.08 * paper * width) ** 2)

    try:
        figure.savefig(options.output, dpi=options.dpi, bbox_inches="tight")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error).split("\n")[0]
        raise InputError(f"The picture '{options.output}' cannot be written: "
                         f"{reason}.")


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        usage=__doc__.split("\n\n")[1].strip(),
        description=__doc__.split("\n")[0])
    parser.add_argument("output", metavar="OUT.png")
    parser.add_argument("files", nargs="+", metavar="FILE")
    parser.add_argument("--field", default="damage")
    parser.add_argument("--component", type=int)
    parser.add_argument("--warp", type=float, default=1)
    parser.add_argument("--zoom", type=float, nargs=4,
                        metavar=("X0", "Y0", "X1", "Y1"))
    parser.add_argument("--limits", type=float, nargs=2,
                        metavar=("LOW", "HIGH"))
    parser.add_argument("--label", action="append", default=[])
    parser.add_argument("--title", default="")
    parser.add_argument("--dpi", type=float, default=200)

    def refuse(message):
        raise InputError(f"The arguments are wrong: {message}.")

    parser.error = refuse
    options = parser.parse_intermixed_args(arguments)
    zoom = options.zoom
    if zoom is not None and (zoom[0] >= zoom[2] or zoom[1] >= zoom[3]):
        raise InputError("The part to be shown must have X0 < X1 and Y0 < Y1.")
    return options


def main():
    try:
        options = parse_arguments(sys.argv[1:])
        plot([prepare(name, options) for name in options.files], options)
    except InputError as error:
        sys.exit(f"plot_fields.py: {error}")
    except ImportError as error:
        sys.exit("plot_fields.py: The Python package "
                 f"'{error.name}' is not installed.")


if __name__ == "__main__":
    main()
