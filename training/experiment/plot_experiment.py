#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws an experiment's figures, as SVG and PNG, from the tables that striker-experiment wrote.

Usage: striker-plot-experiment DIR

Writes into DIR: learning_curves (the paper's figure, with 95 % intervals), sample_efficiency (episodes until the
moving average exceeds a level) and generalisation (trained as named, tested at the origin and anywhere). The same
tables give the same bytes.
"""

import csv
import os
import sys

import matplotlib.pyplot as plt
from striker_pictures import save

COMMAND = "striker-plot-experiment"
LEVELS = [("-4", "-4"), ("0", "0"), ("50%", "50 % of the ceiling"), ("90%", "90 % of the ceiling")]


def read(directory, name):
    file = os.path.join(directory, name)
    try:
        with open(file, encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
    except OSError as error:
        sys.exit(f"striker-plot-experiment: {file}: {error.strerror}; give a directory of striker-experiment")
    if not rows:
        sys.exit(f"striker-plot-experiment: {file}: no rows; run striker-experiment again")
    return rows


def errors(rows, name, scale=1.0):
    values = [float(row[name]) * scale for row in rows]
    low = [value - float(row[f"{name}_low"]) * scale for value, row in zip(values, rows)]
    high = [float(row[f"{name}_high"]) * scale - value for value, row in zip(values, rows)]
    return values, [low, high]


def learning_curves(curves, directory):
    figure, axes = plt.subplots(figsize=(9, 5.5), layout="constrained")
    for variant in dict.fromkeys(row["variant"] for row in curves):
        rows = [row for row in curves if row["variant"] == variant]
        episodes = [int(row["episode"]) for row in rows]
        line, = axes.plot(episodes, [float(row["moving_average"]) for row in rows], label=variant, linewidth=1.3)
        axes.fill_between(episodes, [float(row["low"]) for row in rows], [float(row["high"]) for row in rows],
                          color=line.get_color(), alpha=0.15, linewidth=0)
    axes.axhline(-4.0, color="black", linewidth=0.7, linestyle=":")
    axes.set_xlabel("episode")
    axes.set_ylabel("reward, moving average of 250")
    axes.set_title("Interquartile mean over seeds, 95 % bootstrap intervals")
    axes.legend()
    save(figure, directory, "learning_curves", COMMAND)


def sample_efficiency(summary, directory):
    figure, axes = plt.subplots(1, len(LEVELS), figsize=(12, 0.45 * len(summary) + 1.5), sharey=True,
                                layout="constrained")
    places = range(len(summary))
    for panel, (key, title) in zip(axes, LEVELS):
        values, bars = errors(summary, f"episodes_to_{key}")
        panel.errorbar(values, places, xerr=bars, fmt="o", capsize=3)
        panel.set_title(f"average above {title}", fontsize=9)
        panel.set_xlabel("episodes (median)")
        panel.set_yticks(places, [row["variant"] for row in summary])
    axes[0].invert_yaxis()
    save(figure, directory, "sample_efficiency", COMMAND)


def generalisation(summary, directory):
    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    for shift, name in ((-0.12, "origin"), (0.12, "anywhere")):
        values, bars = errors(summary, name)
        axes.errorbar([place + shift for place in range(len(summary))], values, yerr=bars, fmt="o", capsize=3,
                      label=f"tested: {name}")
    axes.set_xticks(range(len(summary)), [row["variant"] for row in summary], rotation=25, ha="right")
    axes.set_ylabel("reward, greedy on held-out episodes")
    axes.set_title("Generalisation to other places on the field")
    axes.legend()
    save(figure, directory, "generalisation", COMMAND)


def main():
    if len(sys.argv) != 2 or sys.argv[1] == "--help":
        print(__doc__)
        sys.exit(0 if "--help" in sys.argv else 2)
    directory = sys.argv[1]
    summary = read(directory, "summary.csv")
    learning_curves(read(directory, "curves.csv"), directory)
    sample_efficiency(summary, directory)
    generalisation(summary, directory)


if __name__ == "__main__":
    main()
