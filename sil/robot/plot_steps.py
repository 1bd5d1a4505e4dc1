#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what a robot makes of steps of its set-point, as SVG and PNG: as it is described, and if it is not.

Usage: striker-plot-steps ROBOT.toml... -o DIR

Writes into DIR, for each description, NAME_steps.svg and NAME_steps.png: rim and robot (above) and torque (below) of
straight steps to the top speed, to its opposite and to 0, for the described robot and for others in its place, by
'striker-robot step'. The same descriptions give the same bytes.
"""

import argparse
import csv
import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = os.path.dirname(os.path.realpath(__file__))
VARIATIONS = (("as described", ""), ("30 % lighter", "mass=0.7"), ("30 % heavier", "mass=1.3"),
              ("torque 30 % up", "torque=1.3"), ("a third of the grip", "friction=0.333"))

# The same bytes for the same steps.
matplotlib.rcParams["svg.hashsalt"] = "striker"
METADATA = {"svg": {"Date": None}, "png": {"Software": None}}


class PlotError(Exception):
    """What cannot be drawn, in one line."""


def rows_of(robot, variation):
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "step.csv")
        words = [os.path.join(HERE, "striker-robot"), "step", os.path.abspath(robot), "--csv", table]
        done = subprocess.run(words + (["--vary", variation] if variation else []), capture_output=True, text=True,
                              check=False)
        if done.returncode != 0:
            raise PlotError(done.stderr.strip().removeprefix("striker-robot: "))
        with open(table, encoding="utf-8", newline="") as stream:
            return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(stream)]


def draw(robot, variations, directory):
    figure, axes = plt.subplots(2, len(VARIATIONS), figsize=(15, 5.5), sharex=True, sharey="row", layout="constrained")
    for column, (title, rows) in zip(axes.T, variations):
        time_s = [row["time_ms"] / 1e3 for row in rows]
        for name, label, style in (("set_point_mm_s", "set-point", "k:"), ("measured_mm_s", "rim", "C1-"),
                                   ("moved_mm_s", "robot", "C0-")):
            column[0].plot(time_s, [row[name] / 1e3 for row in rows], style, label=label, linewidth=1.1)
        column[1].plot(time_s, [row["torque_mNm"] for row in rows], "C3-", linewidth=1.0)
        column[0].set_title(title)
        column[1].set_xlabel("time, s")
        for part in column:
            part.grid(alpha=0.3)
    axes[0][0].set_ylabel("speed, m/s")
    axes[1][0].set_ylabel("torque of the right wheel, mNm")
    axes[0][0].legend(loc="lower left", fontsize=8)
    name = os.path.splitext(os.path.basename(robot))[0]
    figure.suptitle(f"{name}: steps of the set-point")
    for kind, metadata in METADATA.items():
        save(figure, os.path.join(directory, f"{name}_steps.{kind}"), kind, metadata)
    plt.close(figure)


def save(figure, target, kind, metadata):
    part = f"{target}.part"
    try:
        figure.savefig(part, format=kind, metadata=metadata, dpi=100)
        os.replace(part, target)
    except OSError:
        if os.path.exists(part):
            os.remove(part)
        raise
    print(target)


def main():
    parser = argparse.ArgumentParser(prog="striker-plot-steps", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("robot", nargs="+", help="a description, as firmware/robots/forward.toml")
    parser.add_argument("-o", "--out", required=True, metavar="DIR", help="is made if there is none")
    parser.add_argument("--version", action="version", version=version())
    options = parser.parse_args()
    names = [os.path.splitext(os.path.basename(robot))[0] for robot in options.robot]
    try:
        if len(set(names)) < len(names):
            raise PlotError("two descriptions have the same name, and so would their pictures")
        steps = [[(title, rows_of(robot, variation)) for title, variation in VARIATIONS] for robot in options.robot]
        os.makedirs(options.out, exist_ok=True)
        for robot, variations in zip(options.robot, steps):
            draw(robot, variations, options.out)
    except PlotError as error:
        refuse(error)
    except OSError as error:
        refuse(f"{error.filename or options.out}: {error.strerror}; give a folder that can be written with -o")


def version():
    told = subprocess.run([os.path.join(HERE, "striker-robot"), "--version"], capture_output=True, text=True, check=False)
    return told.stdout.strip().replace("striker-robot", "striker-plot-steps")


def refuse(text):
    print(f"striker-plot-steps: {text}", file=sys.stderr)
    sys.exit(2)


if __name__ == "__main__":
    main()
