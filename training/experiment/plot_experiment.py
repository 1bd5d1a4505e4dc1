#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws an experiment's figures, as SVG and PNG, from what striker-experiment wrote.

Usage: striker-plot-experiment DIR

Writes into DIR: learning_curves (the paper's figure with 95 % intervals, the ceiling and what the paper got), sample_efficiency
(episodes until the moving average exceeds a level; "never" is a word, and a level at which no variant differs is left out,
with the figure if that is all of them) and generalisation (trained as named, tested at the origin and anywhere). The same
tables give the same bytes.
"""

import csv
import json
import os
import sys

import matplotlib.pyplot as plt
from striker_pictures import PlotError, refuse, save

PROGRAM = "striker-plot-experiment"
FLOOR = -4.0
LEVELS = [("-4", "-4"), ("0", "0"), ("50%", "50 % of the way to the ceiling"), ("90%", "90 % of the way to the ceiling")]


def read(directory, name, parse):
    file = os.path.join(directory, name)
    try:
        with open(file, encoding="utf-8", newline="") as stream:
            found = parse(stream)
    except OSError as error:
        raise PlotError(f"{file}: {error.strerror}; give a directory of striker-experiment") from error
    except ValueError as error:
        raise PlotError(f"{file}: cannot be read ({error}); run striker-experiment again") from error
    if not found:
        raise PlotError(f"{file}: no rows; run striker-experiment again")
    return found


def rows_of(stream):
    return list(csv.DictReader(stream))


def errors(rows, name):
    values = [float(row[name]) for row in rows]
    low = [value - float(row[f"{name}_low"]) for value, row in zip(values, rows)]
    high = [float(row[f"{name}_high"]) - value for value, row in zip(values, rows)]
    return values, [low, high]


def learning_curves(curves, about, directory):
    figure, axes = plt.subplots(figsize=(10, 5.5), layout="constrained")
    for variant in about["variants"]:
        rows = [row for row in curves if row["variant"] == variant["name"]]
        episodes = [int(row["episode"]) for row in rows]
        line, = axes.plot(episodes, [float(row["moving_average"]) for row in rows], label=variant["says"], linewidth=1.3)
        axes.fill_between(episodes, [float(row["low"]) for row in rows], [float(row["high"]) for row in rows],
                          color=line.get_color(), alpha=0.15, linewidth=0)
    levels = [(about["ceiling"], f"ceiling, {about['ceiling']:g}", "--"), (FLOOR, f"no contact, {FLOOR:g}", ":")]
    if about["paper_best"] is not None:
        levels.append((about["paper_best"], f"the paper's best, {about['paper_best']:g}", "-."))
    for level, text, style in levels:
        axes.axhline(level, color="black", linewidth=0.9, linestyle=style, label=text)
    axes.set_xlabel("episode")
    axes.set_ylabel("reward, moving average of 250 episodes")
    axes.set_title(f"Interquartile mean over {about['seeds']} seeds, 95 % bootstrap intervals")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    save(figure, directory, "learning_curves", PROGRAM)


def crossings(summary, about, key):
    """(episode or None for never, low, high or None, runs that do) of each variant."""
    found = []
    for row, variant in zip(summary, about["variants"]):
        value, low, high = (float(row[f"episodes_to_{key}{end}"]) for end in ("", "_low", "_high"))
        ends = [end if end <= variant["episodes"] else None for end in (value, low, high)]
        found.append((*ends, int(row[f"reached_{key}"])))
    return found


def draw_crossings(axes, found, about):
    last = max(variant["episodes"] for variant in about["variants"])
    for place, (value, low, high, reached) in enumerate(found):
        if value is None:
            text = "never" if reached == 0 else f"{reached} of {about['seeds']} runs"
            axes.text(0.5, place, text, transform=axes.get_yaxis_transform(), ha="center", va="center")
            continue
        bars = [[value - low], [(last if high is None else high) - value]]
        axes.errorbar([value], [place], xerr=bars, fmt="o", color="C0", capsize=3, xuplims=False)
        if high is None:  # some seeds never do
            axes.plot([last], [place], ">", color="C0")
            axes.text(last, place - 0.15, f"{reached} of {about['seeds']} runs", ha="right", va="bottom", fontsize=7)
    axes.set_xlim(0, 1.04 * last)


def sample_efficiency(summary, about, directory):
    panels = [(title, crossings(summary, about, key)) for key, title in LEVELS]
    panels = [(title, found) for title, found in panels if len(set(found)) > 1]
    if not panels:
        for kind in ("svg", "png"):
            file = os.path.join(directory, f"sample_efficiency.{kind}")
            if os.path.exists(file):  # of other runs
                os.remove(file)
        return
    figure, row = plt.subplots(1, len(panels), figsize=(3.2 + 2.8 * len(panels), 0.45 * len(summary) + 1.5), sharey=True,
                               squeeze=False, layout="constrained")
    for axes, (title, found) in zip(row[0], panels):
        draw_crossings(axes, found, about)
        axes.set_title(f"average above {title}", fontsize=9)
        axes.set_xlabel("episodes, median")
        axes.set_yticks(range(len(summary)), [variant["says"] for variant in about["variants"]])
        axes.set_ylim(len(summary) - 0.5, -0.5)
    save(figure, directory, "sample_efficiency", PROGRAM)


def generalisation(summary, about, directory):
    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    for shift, name in ((-0.12, "origin"), (0.12, "anywhere")):
        values, bars = errors(summary, name)
        axes.errorbar([place + shift for place in range(len(summary))], values, yerr=bars, fmt="o", capsize=3,
                      label=f"tested: {name}")
    axes.set_xticks(range(len(summary)), [variant["says"] for variant in about["variants"]], rotation=25, ha="right")
    axes.set_ylabel("reward, greedy on held-out episodes")
    axes.set_title("Generalisation to other places on the field")
    axes.legend()
    save(figure, directory, "generalisation", PROGRAM)


def draw(directory):
    about = read(directory, "experiment.json", json.load)
    summary = read(directory, "summary.csv", rows_of)
    learning_curves(read(directory, "curves.csv", rows_of), about, directory)
    sample_efficiency(summary, about, directory)
    generalisation(summary, about, directory)


def main():
    if len(sys.argv) != 2 or sys.argv[1] == "--help":
        print(__doc__)
        sys.exit(0 if "--help" in sys.argv else 2)
    try:
        draw(sys.argv[1])
    except PlotError as error:
        refuse(PROGRAM, error)
    except OSError as error:
        refuse(PROGRAM, f"{error.filename}: {error.strerror}; give a directory that can be written")


if __name__ == "__main__":
    main()
