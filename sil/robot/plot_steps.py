#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what a robot makes of steps of its set-point, as SVG and PNG: as it is described, and if it is not.

Usage: striker-plot-steps ROBOT.toml... -o DIR

Writes into DIR, for each description, NAME_steps.svg and NAME_steps.png: rim and robot (above) and torque (below) of
straight steps to the top speed, to its opposite and to 0, for the described robot and for others in its place, by
'striker-robot step'. The same descriptions give the same bytes.
"""

import csv
import os
import subprocess
import tempfile

import matplotlib.pyplot as plt
from striker_pictures import BLUE, HERE, ORANGE, VERMILION, PlotError, parser_of, run, save

PROGRAM = "striker-plot-steps"
VARIATIONS = (("as described", ""), ("30 % lighter", "mass=0.7"), ("30 % heavier", "mass=1.3"),
              ("torque 30 % up", "torque=1.3"), ("a third of the grip", "friction=0.333"))


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


def draw_robot(robot, variations, directory, command):
    figure, axes = plt.subplots(2, len(VARIATIONS), figsize=(15, 5.5), sharex=True, sharey="row", layout="constrained")
    for column, (title, rows) in zip(axes.T, variations):
        time_s = [row["time_ms"] / 1e3 for row in rows]
        for name, label, colour, style in (("set_point_mm_s", "set-point", "black", ":"),
                                           ("measured_mm_s", "rim", ORANGE, "-"), ("moved_mm_s", "robot", BLUE, "-")):
            column[0].plot(time_s, [row[name] / 1e3 for row in rows], color=colour, linestyle=style, label=label,
                           linewidth=1.1)
        column[1].plot(time_s, [row["torque_mNm"] for row in rows], color=VERMILION, linewidth=1.0)
        column[0].set_title(title)
        column[1].set_xlabel("time, s")
    axes[0][0].set_ylabel("speed, m/s")
    axes[1][0].set_ylabel("torque of the right wheel, mNm")
    axes[0][0].legend(loc="lower left")
    name = os.path.splitext(os.path.basename(robot))[0]
    figure.suptitle(f"{name}: steps of the set-point")
    save(figure, directory, f"{name}_steps", command)


def draw(options, directory, command):
    names = [os.path.splitext(os.path.basename(robot))[0] for robot in options.robot]
    if len(set(names)) < len(names):
        raise PlotError("two descriptions have the same name, and so would their pictures")
    steps = [[(title, rows_of(robot, variation)) for title, variation in VARIATIONS] for robot in options.robot]
    for robot, variations in zip(options.robot, steps):
        draw_robot(robot, variations, directory, command)


def main():
    parser = parser_of(PROGRAM, __doc__, built_with="striker-robot")
    parser.add_argument("robot", nargs="+", help="a description, as firmware/robots/forward.toml")
    run(PROGRAM, draw, parser.parse_args())


if __name__ == "__main__":
    main()
