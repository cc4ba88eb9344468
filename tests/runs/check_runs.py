#!/usr/bin/python3
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

"""Whole runs of the program ebsmpm, checked by what they write.

usage: check_runs.py PROGRAM SOURCE_DIR CASE

Every case is a function below, named run_CASE; it raises an AssertionError
where something is not as it should be.
"""

import csv
import glob
import os
import shutil
import subprocess
import sys
import tempfile
import time

PROGRAM, SOURCE, CASE = sys.argv[1:4]
COARSE = os.path.join(SOURCE, "tutorials/step-5/coarse.prm")
EXACT = (
    "independent_functions",
    "deficient_functions",
    "twin_functions",
    "pieces",
    "free_pieces",
)

# A small version of coarse.prm that breaks completely, within seconds.
SMALL = {
    "Background grid/Cell size": "1/15",
    "Damage/Length scale": "2.5*h",
    "Loading/Increments": "0.004: 4e-4, 0.012: 1e-4",
    "Loading/Stop below": "1e-10",
    "Output/Interval": "0",
}


def command_line(directory, settings, ranks, arguments):
    command = [PROGRAM, *arguments]
    for name, value in settings.items():
        command += ["--set", f"{name} = {value}"]
    command += ["--set", f"Output/Directory = {directory}"]
    if ranks > 1:
        command = ["mpiexec", "--bind-to", "none", "-n", str(ranks)] + command
    return command


def call(directory, settings, ranks=1, arguments=(COARSE,)):
    """Run the program; return the finished process."""
    return subprocess.run(
        command_line(directory, settings, ranks, arguments),
        capture_output=True,
        text=True,
    )


def start(directory, settings):
    """Start the program on one process; return the running process."""
    return subprocess.Popen(
        command_line(directory, settings, 1, (COARSE,)),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def history(settings, ranks=1, parameter_file=COARSE):
    """Run the program; return its history as a list of dictionaries."""
    with tempfile.TemporaryDirectory() as folder:
        result = call(
            os.path.join(folder, "run"), settings, ranks, (parameter_file,)
        )
        assert result.returncode == 0, result.stdout[-2000:] + result.stderr
        with open(os.path.join(folder, "run", "history.csv")) as file:
            return [
                {k: float(v) for k, v in row.items()}
                for row in csv.DictReader(file)
            ]


def peak(table):
    return max(abs(row["force"]) for row in table)


def compare(a, b, what, tolerance=1e-8):
    """The same functions and pieces, and the same forces, relative to the
    peak."""
    assert len(a) == len(b), f"{what}: {len(a)} and {len(b)} steps"
    forces = [k for k in a[0] if k.startswith("force")]
    for x, y in zip(a, b):
        for name in EXACT:
            assert x[name] == y[name], f"{what}, step {x['step']:.0f}: {name}"
        for name in forces:
            difference = abs(x[name] - y[name]) / peak(a)
            assert difference < tolerance, (
                f"{what}, step {x['step']:.0f}: {name} differs by {difference}"
            )


def check_separation(table, what):
    """The load rises, falls to zero, one body becomes two, and no unknowns were
    added for it."""
    assert abs(table[-1]["force"]) < 1e-10 * peak(table), (
        f"{what}: the force is still {table[-1]['force']}"
    )
    assert table[-1]["twin_functions"] > table[0]["twin_functions"], what
    assert (table[0]["pieces"], table[-1]["pieces"]) == (1, 2), what
    # Unknowns may come and go where the boundary crosses grid lines.
    n_before = [row["force"] for row in table].index(peak(table)) + 1
    before = max(row["independent_functions"] for row in table[:n_before])
    after = table[-1]["independent_functions"]
    assert after <= before, f"{what}: unknowns were added"


def run_ranks():
    """1, 2, 3, 4 processes give the same history, to full separation. With
    Balance off, cells are distributed without regard to the points, so that
    the border between processes is elsewhere, across the path of the crack.
    Fields are written as well: numbers of cells differ between processes."""
    settings = dict(
        SMALL,
        **{
            "Loading/Increments": "0.004: 1e-3, 0.012: 3e-4",
            "Output/Interval": "10",
        },
    )
    reference = history(settings)
    check_separation(reference, "1 process")
    for ranks in (2, 3, 4):
        compare(reference, history(settings, ranks), f"{ranks} processes")
    unbalanced = dict(settings, **{"Background grid/Balance": "false"})
    compare(reference, history(unbalanced, 3), "3 processes, not balanced")


def run_empty_ranks():
    """Processes that have cells, but no points."""
    settings = dict(
        SMALL,
        **{
            "Background grid/Balance": "false",
            "Background grid/Upper corner": "1+3*h, 1+16*h",
            "Loading/Increments": "0.004: 1e-3, 0.0064: 3e-4",
        },
    )
    compare(history(settings), history(settings, 4), "empty processes")


def run_shifted():
    """The crack plane between rows of control points, not on one."""
    settings = dict(
        SMALL,
        **{
            "Background grid/Cell size": "1/31",
            "Background grid/Lower corner": "-2.5*h, -2.5*h",
            "Background grid/Upper corner": "1+3.5*h, 1+3.5*h",
            "Loading/Increments": "0.004: 4e-4, 0.012: 5e-5",
        },
    )
    check_separation(history(settings), "shifted by h/2")


def run_rigid():
    """After separation the halves move as rigid bodies, one with the top and
    one not at all: to 1 %, since stresses that are locked in at the lips find
    another balance where points move into other cells."""
    sys.path.insert(0, os.path.join(SOURCE, "contrib"))
    import numpy
    import plot_fields

    settings = dict(
        SMALL,
        **{
            "Loading/Increments": "0.004: 1e-3, 0.0115: 3e-4",
            "Loading/Stop below": "0",
            "Output/Interval": "1",
        },
    )
    with tempfile.TemporaryDirectory() as folder:
        directory = os.path.join(folder, "run")
        result = call(directory, settings)
        assert result.returncode == 0, result.stdout[-2000:] + result.stderr
        with open(os.path.join(directory, "history.csv")) as file:
            rows = list(csv.DictReader(file))
        names = sorted(glob.glob(os.path.join(directory, "points_*.pvtu")))
        assert len(names) == len(rows)
        forces = [abs(float(row["force"])) for row in rows]
        first = min(i for i, f in enumerate(forces) if f < 1e-10 * max(forces))
        assert first < len(rows) - 2, "separates too late for this test"

        def displacements(name):
            """Reference positions, in an order that is always the same, and
            displacements."""
            positions, fields = plot_fields.read(name)
            u = fields["displacement"][:, :2]
            X = positions[:, :2] - u
            order = numpy.lexsort(numpy.round(X.T, 6))
            return X[order], u[order]

        X, u = displacements(names[first])
        X_end, u_end = displacements(names[-1])
    assert numpy.abs(X - X_end).max() < 1e-6
    motion = float(rows[-1]["displacement"]) - float(rows[first]["displacement"])
    for half, expected in ((X[:, 1] > 0.5, motion), (X[:, 1] < 0.5, 0.0)):
        inside = half & (numpy.abs(X[:, 1] - 0.5) > 2.0 / 15)
        error = (u_end - u)[inside] - numpy.array([0.0, expected])
        assert numpy.abs(error).max() < 0.01 * motion, error


# The specimen of SMALL, one cell deep, with three layers of points, held in the
# third direction: plane strain. The grid reaches beyond it on both sides, since
# points on the surface move by rounding errors.
THIN = dict(
    SMALL,
    **{
        "Background grid/Dimension": "3",
        "Background grid/Lower corner": "-3*h, -3*h, -h",
        "Background grid/Upper corner": "1+3*h, 1+3*h, 2*h",
        "Body/Shape": "box(0,0,0, 1,1,h)",
        "Body/Boundaries": "bottom: y < 1e-9; top: y > 1 - 1e-9; "
        "back: nz < -0.5; front: nz > 0.5",
        "Notch/Plane point": "0.5, 0.5, 0",
        "Notch/Plane normal": "0, 1, 0",
        "Notch/Region": "half_space(0.5,0.5,0, 1,0,0)",
        "Loading/Conditions": "bottom.x = 0; bottom.y = 0; top.x = 0; "
        "top.y = u; back.z = 0; front.z = 0",
        "Loading/Increments": "0.004: 1e-3, 0.012: 3e-4",
    },
)


def run_quasi_3d():
    """Plane strain in 3-D is plane strain: per depth, the force of a thin
    specimen is that in 2-D until the crack runs, to the accuracy of the
    quadrature, then to a few per cent of the peak, and gone at the end."""
    plane = history(
        dict(SMALL, **{"Loading/Increments": THIN["Loading/Increments"]})
    )
    thin = history(THIN)
    check_separation(thin, "3-D")
    largest = peak(plane)
    for a, b in zip(plane, thin):
        before = a["twin_functions"] == plane[0]["twin_functions"]
        difference = abs(a["force"] - 15.0 * b["force"]) / largest
        assert difference < (1e-3 if before else 0.04), (a["step"], difference)
    assert abs(len(plane) - len(thin)) <= 2, (len(plane), len(thin))


def run_ranks_3d():
    """The same history on 1, 2, 3, 4 processes in 3-D, to full separation. The
    cells are distributed such that the crack runs across the border."""
    settings = dict(
        THIN,
        **{
            "Background grid/Cell size": "1/9",
            "Background grid/Balance": "false",
            "Damage/Length scale": "2*h",
            "Loading/Increments": "0.004: 2e-3, 0.02: 5e-4",
        },
    )
    reference = history(settings)
    check_separation(reference, "3-D, 1 process")
    for ranks in (2, 3, 4):
        compare(
            reference,
            history(settings, ranks),
            f"3-D, {ranks} processes",
            tolerance=1e-6,
        )


def run_balance():
    """After separation, one half is moved over many cells: the grid is
    distributed anew on the way, and the history is that of one process."""
    settings = dict(
        SMALL,
        **{
            "Background grid/Upper corner": "1+3*h, 1.6",
            "Background grid/Largest imbalance": "1.05",
            "Loading/Increments": "0.004: 1e-3, 0.0115: 3e-4, 0.4: 0.05",
            "Loading/Stop below": "0",
            "Output/Interval": "10",
        },
    )
    reference = history(settings)
    for ranks in (2, 3):
        with tempfile.TemporaryDirectory() as folder:
            directory = os.path.join(folder, "run")
            result = call(directory, settings, ranks)
            assert result.returncode == 0, result.stdout[-2000:] + result.stderr
            with open(os.path.join(directory, "history.csv")) as file:
                table = [
                    {k: float(v) for k, v in row.items()}
                    for row in csv.DictReader(file)
                ]
        assert result.stdout.count("distributed anew") > 1, result.stdout
        compare(reference, table, f"{ranks} processes")


# The load grows by powers of two: a run that ends early ends with the same
# number, to the last digit, with which a longer one goes on.
def restart_settings(steps, **more):
    """Checkpoints every eight steps. The first four steps go to 16/4096. (On
    several processes, no two runs with MUMPS are the same to the last digit.)"""
    return dict(
        SMALL,
        **{
            "Loading/Increments": f"16/4096: 1/1024, {steps + 12}/4096: 1/4096",
            "Output/Interval": "5",
            "Checkpoint/Interval": "8",
            "Linear solver/Displacement": "KLU",
        },
        **more,
    )


def read_lines(directory):
    """The history as text, without the column with the time."""
    with open(os.path.join(directory, "history.csv")) as file:
        return [line.rstrip().rsplit(",", 1)[0] for line in file]


def read_table(directory):
    with open(os.path.join(directory, "history.csv")) as file:
        return [
            {k: float(v) for k, v in row.items()} for row in csv.DictReader(file)
        ]


def series(directory):
    """The files that the PVD files list."""
    lines = []
    for name in ("points.pvd", "grid.pvd"):
        with open(os.path.join(directory, name)) as file:
            lines += [line for line in file if "<DataSet" in line]
    return lines


def succeed(*arguments):
    result = call(*arguments)
    assert result.returncode == 0, result.stdout[-2000:] + result.stderr
    return result


def run_restart():
    """A run that is continued from a checkpoint is the same as one that was not
    interrupted: to the last digit on the same number of processes, to rounding
    errors on another. The crack has grown by then."""
    half, full = restart_settings(steps=24), restart_settings(steps=48)
    again = dict(full, **{"Checkpoint/Resume": "true"})
    with tempfile.TemporaryDirectory() as folder:
        whole, tables = {}, {}
        for ranks in (1, 2):
            whole[ranks] = os.path.join(folder, f"whole_{ranks}")
            succeed(whole[ranks], full, ranks)
            tables[ranks] = read_table(whole[ranks])
        twins = [row["twin_functions"] for row in tables[1]]
        assert twins[0] < twins[23] < twins[-1], twins

        for ranks, next_ranks in ((1, (1,)), (2, (1, 2, 3))):
            first = os.path.join(folder, f"first_{ranks}")
            succeed(first, half, ranks)
            for n in next_ranks:
                directory = os.path.join(folder, f"{ranks}_{n}")
                shutil.copytree(first, directory)
                succeed(directory, again, n)
                what = f"{ranks} and then {n} processes"
                compare(tables[ranks], read_table(directory), what)
                if n == ranks:
                    assert read_lines(whole[n]) == read_lines(directory), what
                # The last fields of the first run remain.
                assert len(series(directory)) == len(series(whole[1])) + 2
                with open(os.path.join(directory, "log.txt")) as file:
                    log = file.read()
                assert "step     1" in log and "after step 24" in log, log
        check_killed(folder, full, whole[1])
        check_refused(os.path.join(folder, "first_1"), again)


def check_killed(folder, settings, whole):
    """A run that is killed continues from its last checkpoint, and what it has
    computed since then is computed again."""
    directory = os.path.join(folder, "killed")
    checkpoints = os.path.join(directory, "checkpoint")
    process = start(directory, settings)
    while process.poll() is None and not glob.glob(f"{checkpoints}/step_*"):
        time.sleep(0.01)
    while process.poll() is None and len(read_lines(directory)) < 8 + 4:
        time.sleep(0.01)
    process.kill()
    process.communicate()
    # As if it had been killed while it wrote the next checkpoint.
    os.makedirs(os.path.join(checkpoints, "new"), exist_ok=True)
    with open(os.path.join(checkpoints, "new", "run"), "w") as file:
        file.write("nothing")
    succeed(directory, dict(settings, **{"Checkpoint/Resume": "true"}))
    assert read_lines(directory) == read_lines(whole)
    assert series(directory) == series(whole)
    assert len(os.listdir(checkpoints)) == 1, os.listdir(checkpoints)


def check_refused(directory, settings):
    """What must not be continued is refused, and left as it is."""
    refuse(settings, ["no checkpoint", "Checkpoint/Resume"])
    before = {
        name: os.stat(os.path.join(directory, name)).st_mtime_ns
        for name in os.listdir(directory)
    }
    late = settings["Loading/Increments"].replace("1/1024", "1/2048")
    reason = "as in the run that is to be continued"
    for name, value, old, why in (
        ("Damage/Fracture energy", "3e-3", "2.7e-3", reason),
        ("Background grid/Cell size", "1/16", "1/15", reason),
        ("Loading/Increments", late, "1/1024", "up to the load"),
        ("Checkpoint/Resume", "false", "", "checkpoint"),
    ):
        result = call(directory, dict(settings, **{name: value}))
        assert result.returncode != 0, name
        lines = result.stderr.strip().splitlines()
        assert len(lines) == 1, result.stderr
        words = (name, value, old) if old else (directory, "overwrite")
        for word in (*words, why):
            assert word in lines[0], f"'{word}' is not in '{lines[0]}'"
        for file, time_stamp in before.items():
            path = os.path.join(directory, file)
            assert os.stat(path).st_mtime_ns == time_stamp, path


def run_restart_3d():
    """The same in 3-D, on another number of processes; and increments, output
    and solvers that are others from there on."""
    settings = dict(
        THIN,
        **{
            "Background grid/Cell size": "1/9",
            "Background grid/Balance": "false",
            "Damage/Length scale": "2*h",
            "Loading/Increments": "1/256: 1/512, 5/512: 1/1024",
            "Checkpoint/Interval": "4",
        },
    )
    reference = history(settings, 2)
    first = dict(settings, **{"Loading/Increments": "1/256: 1/512, 6/1024: 1/1024"})
    again = dict(settings, **{"Checkpoint/Resume": "true", "Output/Interval": "2"})
    with tempfile.TemporaryDirectory() as folder:
        for ranks in (2, 3):
            directory = os.path.join(folder, f"run_{ranks}")
            succeed(directory, first, 2)
            succeed(directory, again, ranks)
            table = read_table(directory)
            compare(reference, table, f"3-D, {ranks}", tolerance=1e-6)


def run_pressure():
    """Cracks under inner pressure (Sneddon): the volume of the crack, which the
    pressure has opened with twice the elastic energy as work. The line in a box
    of half-width 5, for which a fine grid gives 0.97 of the infinite body; the
    penny, coarse, the same on one and two processes."""
    folder = os.path.join(SOURCE, "tests/benchmarks")
    line = {
        "Background grid/Lower corner": "-3.25*h, -5-3*h",
        "Background grid/Upper corner": "5+3*h, 5+3*h",
        "Body/Shape": "box(0,-5, 5,5)",
    }
    penny = {
        "Background grid/Cell size": "1/4",
        "Background grid/Lower corner": "-2*h, -2*h, -2-2*h",
        "Background grid/Upper corner": "2+2*h, 2+2*h, 2+2*h",
        "Body/Shape": "box(0,0,-2, 2,2,2)",
    }
    exact = {"line": 2.98451302, "penny": 1.26666667}
    for name, settings, ranks in (
        ("line", line, 1),
        ("penny", penny, 1),
        ("penny", penny, 2),
    ):
        (row,) = history(
            settings, ranks, os.path.join(folder, f"sneddon_{name}.prm")
        )
        volume = row["opened_volume"] / 1e-3
        work = 1e-3 * row["opened_volume"] / (2 * row["elastic_energy"])
        assert abs(work - 1.0) < 1e-3, (name, work)
        error = volume / exact[name] - 1.0
        assert abs(error) < (0.03 if name == "line" else 0.1), (name, error)
        if ranks == 1:
            alone = volume
    assert abs(volume / alone - 1.0) < 1e-6, (volume, alone)


# A specimen that is broken from the start, of which only the lower half is held.
BROKEN = dict(
    SMALL,
    **{
        "Notch/Type": "damage",
        "Notch/Region": "box(-1,0.5-l/2, 2,0.5+l/2)",
        "Body/Boundaries": "bottom: y < 1e-9",
        "Loading/Conditions": "bottom.x = 0; bottom.y = u",
        "Loading/Driven boundary": "bottom.y",
        "Loading/Stop below": "0",
    },
)


def run_detached():
    """The upper half is held by nothing: it stays where it is."""
    settings = dict(
        BROKEN,
        **{
            "Loading/Conditions": "bottom.x = 0; bottom.y = -u",
            "Loading/Increments": "0.04: 0.02",
        },
    )
    for ranks in (1, 2):
        last = history(settings, ranks)[-1]
        assert last["pieces"] == 2 and last["free_pieces"] == 1, last
        assert abs(last["force"]) < 1e-10, last
        assert abs(last["smallest_opening"] - 0.04) < 2e-3, last


def run_closing():
    """Lips that come together are reported: there is no contact."""
    settings = dict(BROKEN, **{"Loading/Increments": "0.04: 0.02"})
    with tempfile.TemporaryDirectory() as folder:
        directory = os.path.join(folder, "run")
        result = call(directory, settings)
        assert result.returncode == 0, result.stdout[-2000:] + result.stderr
        assert "(lips overlap by 0.0" in result.stdout, result.stdout
        with open(os.path.join(directory, "history.csv")) as file:
            last = list(csv.DictReader(file))[-1]
    assert abs(float(last["smallest_opening"]) + 0.04) < 2e-3, last


def run_panel():
    """The L-shaped panel, coarse: a curved crack, the same on 1, 2 and 3
    processes, and with the transition less load than without."""
    panel = os.path.join(SOURCE, "tutorials/step-6/coarse.prm")
    settings = {"Loading/Increments": "8: 1, 9.6: 0.2", "Output/Interval": "0"}
    tables = [history(settings, ranks, panel) for ranks in (1, 2, 3)]
    for table, ranks in zip(tables[1:], (2, 3)):
        compare(tables[0], table, f"{ranks} processes", tolerance=1e-6)
    diffusive = history(
        dict(settings, **{"Crack partition/Enable": "false"}), 1, panel
    )
    assert tables[0][-1]["twin_functions"] > 10
    assert tables[0][-1]["force"] < 0.95 * diffusive[-1]["force"]
    assert abs(peak(tables[0]) - peak(diffusive)) < 0.01 * peak(diffusive)


def run_stability():
    """With a penalty factor that is too small, the tangent is indefinite. That
    is reported, makes the increment smaller, and ends the run, unless it is to
    be accepted. Nothing crashes."""
    settings = dict(
        SMALL,
        **{
            "Nitsche/Penalty factor": "0.5",
            "Loading/Increments": "8e-4: 4e-4",
            "Loading/Minimum increment": "5e-5",
        },
    )
    with tempfile.TemporaryDirectory() as folder:
        result = call(os.path.join(folder, "run"), settings)
    assert result.returncode != 0
    assert "negative pivots" in result.stdout, result.stdout[-2000:]
    assert "Trying increment" in result.stdout, result.stdout[-2000:]
    assert "penalty factor" in result.stderr, result.stderr
    settings["Newton/Indefinite tangent"] = "accept"
    assert len(history(settings)) == 2


def run_gap():
    """The notch as a gap of three cells; iterated to convergence."""
    settings = dict(
        SMALL,
        **{
            "Background grid/Cell size": "1/41",
            "Notch/Type": "none",
            "Body/Shape": "box(0,0, 1,1) - box(-1,0.5-1.5*h, 0.5,0.5+1.5*h)",
            "Loading/Increments": "0.0044: 4e-4, 0.009: 1e-4",
            "Staggered/Maximum passes": "500",
        },
    )
    table = history(settings)
    check_separation(table, "gap")

    # Without the transition, the broken specimen still carries load.
    settings["Crack partition/Enable"] = "false"
    diffusive = history(settings)
    assert diffusive[-1]["twin_functions"] == 0
    assert abs(peak(diffusive) / peak(table) - 1.0) < 0.02, (
        peak(diffusive),
        peak(table),
    )
    assert abs(diffusive[-1]["force"]) > 1e-3 * peak(diffusive)


def refuse(settings, words, arguments=(COARSE,)):
    """A bad input ends with one sentence that contains the words, a status
    that is not zero, and no output."""
    with tempfile.TemporaryDirectory() as folder:
        directory = os.path.join(folder, "run")
        result = call(directory, settings, arguments=arguments)
        assert result.returncode != 0, words
        lines = result.stderr.strip().splitlines()
        assert len(lines) == 1, result.stderr
        for word in words:
            assert word in lines[0], f"'{word}' is not in '{lines[0]}'"
        assert not os.path.exists(directory), words


def run_bad_input():
    refuse({"Damage/Lenght scale": "1"}, ["Lenght scale", "Length scale"])
    refuse({"Damage/Fracture energy": "-1"}, ["Damage/Fracture energy", "-1"])
    refuse({"Damage/Length scale": "0"}, ["Damage/Length scale", "positive"])
    refuse({"Background grid/Cell size": "1/"}, ["Background grid/Cell size"])
    refuse({"Background grid/Degree": "4"}, ["Background grid/Degree", "4"])
    refuse({"Loading/Increments": "1e-3"}, ["Loading/Increments"])
    refuse({"Loading/Driven boundary": "left.x"}, ["Loading/Driven boundary"])
    refuse({"Loading/Conditions": "left.x = 0"}, ["left"])
    refuse({"Loading/Conditions": "top.normal = u; top.x = 0"}, ["top", "normal"])
    refuse({"Body/Shape": "box(0,0, 1"}, ["position"])
    refuse({"Staggered/Maximum passes": "0"}, ["Staggered/Maximum passes"])
    refuse({"Loading/Tractions": "top.x = 1"}, ["top", "direction x"])
    sliding = "bottom.x = 0; bottom.y = 0; top.normal = u"
    refuse(
        {"Loading/Conditions": sliding, "Loading/Tractions": "top.x = 1"},
        ["top", "along its normal"],
    )
    refuse({"Loading/Tractions": "slit.upper.pressure = 1"}, ["slit.upper"])
    refuse({"Loading/Tractions": "top.p = 1"}, ["pressure"])
    refuse({"Notch/Type": "none", "Notch/Faces": "true"}, ["Notch/Faces"])
    refuse({"Notch/Tip margin": "h/"}, ["Notch/Tip margin"])
    refuse({}, ["nothing.prm"], arguments=("nothing.prm",))

    # Results are not overwritten unless one insists.
    settings = dict(SMALL, **{"Loading/Increments": "4e-4: 4e-4"})
    with tempfile.TemporaryDirectory() as folder:
        directory = os.path.join(folder, "run")
        assert call(directory, settings).returncode == 0
        before = open(os.path.join(directory, "history.csv")).read()
        result = call(directory, settings)
        assert result.returncode != 0 and "history.csv" in result.stderr
        assert open(os.path.join(directory, "history.csv")).read() == before
        result = call(directory, settings, arguments=(COARSE, "--force"))
        assert result.returncode == 0, result.stderr


globals()["run_" + CASE]()
print(f"{CASE}: OK")
