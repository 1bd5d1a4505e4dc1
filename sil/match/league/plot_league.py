#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws a league's table, as SVG and PNG.

Usage: striker-plot-league LEAGUE -o DIR

Reads league.json of the directory LEAGUE, and writes into DIR: table (points, and goal differences with their 95 %
intervals) and pairings (each two teams' goal difference, and red minus blue of teams against themselves, with theirs).
The same league gives the same bytes.
"""

import argparse
import json
import os
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = os.path.dirname(os.path.realpath(__file__))

# The same bytes for the same league.
matplotlib.rcParams["svg.hashsalt"] = "striker"
METADATA = {"svg": {"Date": None}, "png": {"Software": None}}


class PlotError(Exception):
    """What cannot be drawn, in one line."""


def read(directory):
    file = os.path.join(directory, "league.json")
    try:
        with open(file, encoding="utf-8") as stream:
            league = json.load(stream)
        if not league["teams"]:
            raise PlotError(f"{file}: no match was played to its end; go on with the league")
        return league
    except OSError as error:
        raise PlotError(f"{file}: {error.strerror}; give the directory of a league") from error
    except (ValueError, KeyError, TypeError) as error:
        raise PlotError(f"{file}: is no league's table ({error})") from error


def draw_differences(axes, rows, names):
    """Those that there are, with their intervals; a value without one is a point."""
    for place, row in enumerate(rows):
        if row["goal_difference"] is not None:
            axes.errorbar([row["goal_difference"]], [place], xerr=[row["goal_difference_half_width"] or 0.0], fmt="o",
                          color="C0", capsize=3)
    axes.axvline(0.0, color="black", linewidth=0.7, linestyle=":")
    axes.set_yticks(range(len(rows)), names)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlabel("goal difference a match")
    axes.grid(axis="x", linewidth=0.3)


def table(league, directory):
    teams = league["teams"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 0.45 * len(teams) + 1.6), sharey=True, layout="constrained")
    left.barh(range(len(teams)), [team["points"] for team in teams], color="C0")
    left.set_xlabel("points")
    left.set_title(f"{league['matches']} matches", fontsize=10)
    draw_differences(right, teams, [team["team"] for team in teams])
    right.set_title("means over pairs with 95 % intervals", fontsize=10)
    save(figure, directory, "table")


def pairings(league, directory):
    rows = league["pairings"] + league["mirrors"]
    names = [f"{row['first']} - {row['second']}" for row in league["pairings"]]
    names += [f"{row['team']}, red - blue" for row in league["mirrors"]]
    figure, axes = plt.subplots(figsize=(9, 0.4 * len(rows) + 1.4), layout="constrained")
    draw_differences(axes, rows, names)
    axes.set_title("means with 95 % intervals", fontsize=10)
    save(figure, directory, "pairings")


def save(figure, directory, name):
    for kind, metadata in METADATA.items():
        target = os.path.join(directory, f"{name}.{kind}")
        part = f"{target}.part"
        try:
            figure.savefig(part, format=kind, metadata=metadata, dpi=100)
            os.replace(part, target)
        except OSError:
            if os.path.exists(part):
                os.remove(part)
            raise
        print(target)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(prog="striker-plot-league", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("league", metavar="LEAGUE", help="the directory that striker-sil league wrote")
    parser.add_argument("-o", "--out", required=True, metavar="DIR", help="is made if there is none")
    parser.add_argument("--version", action=ShowVersion)
    options = parser.parse_args()
    try:
        league = read(options.league)
        os.makedirs(options.out, exist_ok=True)
        table(league, options.out)
        pairings(league, options.out)
    except PlotError as error:
        refuse(error)
    except OSError as error:
        refuse(f"{error.filename or options.out}: {error.strerror}; give a folder that can be written with -o")


class ShowVersion(argparse.Action):
    """The build's, which striker-sil knows."""

    def __init__(self, **options):
        super().__init__(nargs=0, help="show the build's version and exit", **options)

    def __call__(self, parser, *_):
        program = os.path.join(HERE, "striker-sil")
        try:
            told = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            refuse(f"{program}: does not tell its version ({error})")
        print(told.stdout.strip().replace("striker-sil", "striker-plot-league"))
        parser.exit()


def refuse(text):
    print(f"striker-plot-league: {text}", file=sys.stderr)
    sys.exit(2)


if __name__ == "__main__":
    main()
