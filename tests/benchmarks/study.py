#!/usr/bin/python3
# -----------------------------------------------------------------------------
#
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the ebsmpm authors
#
# This file is part of the ebsmpm library.
#
# -----------------------------------------------------------------------------

"""What the studies of benchmarks have in common: many runs of the program
ebsmpm that differ in a few parameters, and a table of what they say."""

import argparse
import concurrent.futures
import csv
import os
import shutil
import subprocess
import sys

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")


def run(program, directory, parts):
    """Run a case, unless it has been run to its end. It is given as a list of
    dictionaries of parameters, of which later ones win; the name "" stands for
    the parameter file."""
    if is_finished(directory):
        return
    settings = {"Output/Interval": "1000"}
    for part in parts:
        settings.update(part)
    command = [program, os.path.join(SOURCE, "tutorials", settings.pop(""))]
    settings["Output/Directory"] = directory
    for key, value in settings.items():
        command += ["--set", f"{key} = {value}"]
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1")
    if os.path.isdir(directory):
        shutil.rmtree(directory)
    os.makedirs(directory)
    with open(os.path.join(directory, "screen.txt"), "w") as screen:
        subprocess.run(command, stdout=screen, stderr=screen, env=environment)


def is_finished(directory):
    """Whether a run has written the last line of its log."""
    try:
        with open(os.path.join(directory, "log.txt")) as log:
            return log.read().splitlines()[-1].startswith("finished")
    except (OSError, IndexError):
        return False


def read(directory):
    """The history of a run, a dictionary of numbers per step."""
    with open(os.path.join(directory, "history.csv")) as file:
        rows = list(csv.DictReader(file))
    return [{key: float(value) for key, value in row.items()} for row in rows]


def main(documentation, all_cases, header, describe):
    """Run the cases that the command line asks for, and print the table: a line
    per case, describe(directory)."""
    parser = argparse.ArgumentParser(description=documentation.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", action="store_true")
    options = parser.parse_intermixed_args()
    cases = options.cases or list(all_cases)
    for name in cases:
        if name not in all_cases:
            sys.exit(f"There is no case '{name}', but {', '.join(all_cases)}.")
    directories = {name: os.path.join(options.folder, name) for name in cases}

    if not options.table:
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            jobs = [
                pool.submit(run, options.program, directories[name], all_cases[name])
                for name in cases
            ]
            for job in jobs:
                job.result()

    width = max(len(name) for name in cases)
    print(f"{'case':{width}}  {header}")
    for name in cases:
        try:
            text = describe(directories[name])
            if not is_finished(directories[name]):
                text += "  (broken off)"
        except (OSError, ValueError, IndexError):
            text = "not run"
        print(f"{name:{width}}  {text}")
