#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what a policy decides over two numbers of the relative state, as SVG and PNG: float beside integer, and the planner.

Usage: striker-plot-policy MODEL [--x NAME=FROM:TO] [--y NAME=FROM:TO] [--hold NAME=VALUE]... [--cells N] -o DIR

Writes policy.svg and policy.png into DIR, by 'striker-plane', whose options and names these are. Above, what each chooses: the
float network, its integers (dots where the two differ), and the planner of striker-ceiling. Below, by how much the best Q
leads the next best, in floats and integers, and what the integers' choice costs against the planner's: the reward from here
on after the planner's choice, less that after the integers', if the planner goes on after both. White: the ball would be
inside the robot. The same model gives the same bytes.
"""

import json
import os
import subprocess
import tempfile

import matplotlib.pyplot as plt
import numpy
from matplotlib.colors import ListedColormap, LogNorm, TwoSlopeNorm
from matplotlib.patches import Patch
from striker_pictures import BLUE, HERE, VERMILION, PlotError, parser_of, run, save

PROGRAM = "striker-plot-policy"
ACTIONS = {"forward": BLUE, "stop": "#F0E442", "backward": VERMILION, "no plan meets the ball": "0.85"}
NO_PLAN = 3
LABELS = {"ball_x_m": "ball ahead of the robot, m", "ball_y_m": "ball to the robot's left, m",
          "robot_speed_m_s": "robot's speed, m/s", "ball_vx_m_s": "ball's velocity along the heading, m/s",
          "ball_vy_m_s": "ball's velocity to the left, m/s", "decisions_left": "decisions left"}
LEAST_COST = 0.5  # of the colour scale's ends
LEAST_LEAD, GREATEST_LEAD = 0.01, 10.0  # a lead above 0.02 is a clear one (agreement.hpp)


def plane_of(options):
    words = [os.path.join(HERE, "striker-plane"), options.model]
    for name in ("x", "y", "cells", "weights", "network", "config"):
        value = getattr(options, name)
        words += [] if value is None else [f"--{name}", value]
    words += [word for setting in options.hold for word in ("--hold", setting)]
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "plane.json")
        done = subprocess.run([*words, "-o", file], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise PlotError(done.stderr.strip().rpartition("\n")[2].removeprefix("striker-plane: "))
        with open(file, encoding="utf-8") as stream:
            return json.load(stream)


class Plane:
    def __init__(self, plane):
        self.names = [plane[axis]["name"] for axis in ("x", "y")]
        x, y = ([plane[axis]["values"][place] for place in (0, -1)] for axis in ("x", "y"))
        self.cells = len(plane["x"]["values"])
        half_x, half_y = ((end - begin) / (self.cells - 1) / 2 for begin, end in (x, y))
        self.extent = (x[0] - half_x, x[1] + half_x, y[0] - half_y, y[1] + half_y)
        self.touches = numpy.array(plane["touches"]).reshape(self.cells, self.cells)

    def show(self, axes, values, title, **look):
        values = numpy.ma.masked_array(numpy.reshape(values, (self.cells, self.cells)), self.touches)
        image = axes.imshow(values, origin="lower", extent=self.extent, aspect="auto", interpolation="nearest", **look)
        axes.set_title(title)
        axes.set_xlabel(LABELS[self.names[0]])
        axes.set_ylabel(LABELS[self.names[1]])
        axes.grid(False)
        return image

    def mark(self, axes, differ):
        rows, columns = numpy.nonzero(numpy.reshape(differ, (self.cells, self.cells)) & ~self.touches)
        left, right, below, above = self.extent
        axes.plot(left + (columns + 0.5) * (right - left) / self.cells, below + (rows + 0.5) * (above - below) / self.cells, "k.",
                  markersize=2.5)
        axes.set_xlim(left, right)
        axes.set_ylim(below, above)
        return len(rows)


def margin(q):
    ordered = numpy.sort(q, axis=1)
    return ordered[:, -1] - ordered[:, -2]


def title_of(plane, differ):
    held = ", ".join(f"{LABELS[name].replace(', m/s', '').replace(', m', '')} {value:g}"
                     + (" m/s" if name.endswith("_m_s") else " m" if name.endswith("_m") else "")
                     for name, value in plane["held"].items())
    return f"policy {plane['policy']}: {held}\nfloat and {plane['weights']} integers differ in {differ} of {len(plane['touches'])} cells"


def choices(panels, view, plane):
    colours = {"cmap": ListedColormap(list(ACTIONS.values())), "vmin": -0.5, "vmax": NO_PLAN + 0.5}
    float_action, integer_action = (numpy.array(plane[f"{kind}_action"]) for kind in ("float", "integer"))
    view.show(panels[0], float_action, "float network's choice", **colours)
    view.show(panels[1], integer_action, "integers' choice; dots: not the float network's", **colours)
    view.show(panels[2], numpy.where(plane["contact"], plane["planner_action"], NO_PLAN), "planner's choice", **colours)
    panels[2].legend(handles=[Patch(facecolor=colour, label=name) for name, colour in ACTIONS.items()], loc="lower left")
    return view.mark(panels[1], float_action != integer_action)


def differences(figure, panels, view, plane):
    for axes, kind, name in zip(panels, ("float", "integer"), ("float", "integers")):
        lead = numpy.maximum(margin(numpy.array(plane[f"{kind}_q"])), LEAST_LEAD)
        image = view.show(axes, lead, f"lead of the best Q, {name}", cmap="viridis", norm=LogNorm(LEAST_LEAD, GREATEST_LEAD))
    figure.colorbar(image, ax=panels[1], label="Q, in units of reward", extend="both")
    planned, place = numpy.array(plane["planned"]), numpy.arange(len(plane["planned"]))
    cost = planned[place, plane["planner_action"]] - planned[place, plane["integer_action"]]
    scale = max(LEAST_COST, numpy.abs(cost).max())
    image = view.show(panels[2], cost, "what the integers lose against the planner", cmap="PuOr_r",
                      norm=TwoSlopeNorm(0.0, -scale, scale))
    figure.colorbar(image, ax=panels[2], label="reward (below 0: the planner loses)")


def draw(options, directory, command):
    plane = plane_of(options)
    view = Plane(plane)
    figure, panels = plt.subplots(2, 3, figsize=(14, 8), layout="constrained")
    differ = choices(panels[0], view, plane)
    differences(figure, panels[1], view, plane)
    figure.suptitle(title_of(plane, differ), fontsize=10)
    save(figure, directory, "policy", command)


def main():
    parser = parser_of(PROGRAM, __doc__, built_with="striker-plane")
    parser.add_argument("model", metavar="MODEL", help="a float network")
    parser.add_argument("--hold", action="append", default=[], metavar="NAME=VALUE")
    for name in ("x", "y", "cells", "weights", "network", "config"):
        parser.add_argument(f"--{name}", help="as of striker-plane")
    run(PROGRAM, draw, parser.parse_args())


if __name__ == "__main__":
    main()
