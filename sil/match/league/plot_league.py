#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws a league's table, as SVG and PNG.

Usage: striker-plot-league LEAGUE -o DIR

Reads league.json of the directory LEAGUE, and writes into DIR: table (points, and goal differences with their 95 %
intervals) and pairings (each two teams' goal difference, and red minus blue of teams against themselves, with theirs).
The same league gives the same bytes.
"""

import os

import matplotlib.pyplot as plt
from striker_pictures import BLUE, PlotError, parser_of, run, save
from striker_records import NUMBER_OR_NULL, TEXT, WHOLE, load

PROGRAM = "striker-plot-league"
MEAN = {"goal_difference": NUMBER_OR_NULL, "goal_difference_half_width": NUMBER_OR_NULL}
PARTS = {"teams": {"team": TEXT, "points": WHOLE}, "pairings": {"first": TEXT, "second": TEXT}, "mirrors": {"team": TEXT}}


def read(directory):
    """What is drawn of the table: its matches, and of each of PARTS the rows."""
    file = os.path.join(directory, "league.json")
    table = load(file, "give the directory of a league")
    league = {"matches": table.take("matches", WHOLE), "incomplete": table.take("incomplete", WHOLE)}
    for part, kinds in PARTS.items():
        league[part] = [{name: row.take(name, kind) for name, kind in {**kinds, **MEAN}.items()} for row in table.parts(part)]
    if not league["teams"]:
        raise PlotError(f"{file}: no match was played to its end; go on with the league")
    return league


def draw_differences(axes, rows, names):
    """Those that there are, with their intervals; a value without one is a point."""
    for place, row in enumerate(rows):
        if row["goal_difference"] is not None:
            axes.errorbar([row["goal_difference"]], [place], xerr=[row["goal_difference_half_width"] or 0.0], fmt="o",
                          color=BLUE, capsize=3)
    axes.axvline(0.0, color="black", linewidth=0.7, linestyle=":")
    axes.set_yticks(range(len(rows)), names)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlabel("goal difference a match")


def table(league, directory, command):
    teams = league["teams"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 0.45 * len(teams) + 1.6), sharey=True, layout="constrained")
    left.barh(range(len(teams)), [team["points"] for team in teams], color=BLUE)
    left.set_xlabel("points")
    left.set_title(f"{league['matches']} matches" + (f"; {league['incomplete']} more were interrupted" if league["incomplete"] else ""))
    draw_differences(right, teams, [team["team"] for team in teams])
    right.set_title("means over pairs with 95 % intervals")
    save(figure, directory, "table", command)


def pairings(league, directory, command):
    rows = league["pairings"] + league["mirrors"]
    names = [f"{row['first']} - {row['second']}" for row in league["pairings"]]
    names += [f"{row['team']}, red - blue" for row in league["mirrors"]]
    figure, axes = plt.subplots(figsize=(9, 0.4 * len(rows) + 1.4), layout="constrained")
    draw_differences(axes, rows, names)
    axes.set_title("means with 95 % intervals")
    save(figure, directory, "pairings", command)


def draw(options, directory, command):
    league = read(options.league)
    table(league, directory, command)
    pairings(league, directory, command)


def main():
    parser = parser_of(PROGRAM, __doc__)
    parser.add_argument("league", metavar="LEAGUE", help="the directory that striker-sil league wrote")
    run(PROGRAM, draw, parser.parse_args())


if __name__ == "__main__":
    main()
