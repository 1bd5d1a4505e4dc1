# SPDX-License-Identifier: Apache-2.0
"""A training's or an experiment's directory as what a report shows of it (striker_runs.py says how)."""

import csv
import json
import os

from striker_runs import load, rounded, run_of, table_of

MOST_POINTS = 600  # of a curve
FLOOR = -4.0


def rows_of(stream):
    rows = list(csv.DictReader(stream))
    if not rows:
        raise ValueError("it has no rows")
    return rows


def curve(name, rows, x, y):
    stride = -(-len(rows) // MOST_POINTS)
    chosen = rows[::stride] + ([] if (len(rows) - 1) % stride == 0 else rows[-1:])
    return {"name": name, "x": [int(row[x]) for row in chosen], "y": [rounded(float(row[y])) for row in chosen]}


def chart(name, y, curves, levels=()):
    return {"name": name, "x": "episode", "y": y, "series": curves, "levels": [list(level) for level in levels]}


def training(directory):
    rows = load(directory, "learning_curve.csv", rows_of)
    evaluations = []
    if os.path.exists(os.path.join(directory, "evaluations.csv")):
        evaluations = load(directory, "evaluations.csv", lambda stream: list(csv.DictReader(stream)))
    charts = [chart("learning curve", "reward, moving average of 250 episodes",
                    [curve("training", rows, "episode", "moving_average_250")]
                    + ([curve("greedy, held-out episodes", evaluations, "episode", "mean_reward")] if evaluations else []),
                    [(FLOOR, "no contact")]),
              chart("errors", "temporal difference, in units of reward", [curve("mean absolute", rows, "episode", "td_error")]),
              chart("Q", "Q, in units of reward", [curve("of the samples", rows, "episode", "q")]),
              chart("exploration", "probability of a random action", [curve("epsilon", rows, "episode", "epsilon")])]
    last = rows[-1]
    facts = [["episodes", len(rows)], ["moving average at the end", rounded(float(last["moving_average_250"]))],
             ["contacts in the last 250", sum(int(row["contact"]) for row in rows[-250:])],
             ["best evaluation", max((rounded(float(row["mean_reward"])) for row in evaluations), default="none")]]
    return run_of("training", f"training of {len(rows)} episodes: {directory}", facts, charts=charts,
                  tables=[table_of("evaluations", ["episode", "mean_reward", "best"], evaluations)] if evaluations else [])


def experiment(directory):
    about = load(directory, "experiment.json", json.load)
    summary = load(directory, "summary.csv", rows_of)
    points = load(directory, "curves.csv", rows_of)
    says = {variant["name"]: variant["says"] for variant in about["variants"]}
    last = {variant["name"]: variant["episodes"] for variant in about["variants"]}
    curves = [curve(text, [row for row in points if row["variant"] == name], "episode", "moving_average")
              for name, text in says.items()]
    levels = [(about["ceiling"], "ceiling"), (FLOOR, "no contact")]
    levels += [] if about["paper_best"] is None else [(about["paper_best"], "the paper's best")]

    def episodes_to(row, level):
        value = float(row[f"episodes_to_{level}"])
        return "never" if value > last[row["variant"]] else round(value)

    def figure(row, name):
        value, low, high = (float(row[name + end]) for end in ("", "_low", "_high"))
        return f"{value:.2f} [{low:.2f}, {high:.2f}]"

    columns = ["training", "episodes to 0", "to 50 %", "to 90 %", "best average", "last 1,000", "origin", "anywhere"]
    rows = [[says[row["variant"]], *(episodes_to(row, level) for level in ("0", "50%", "90%")),
             *(figure(row, name) for name in ("best", "final_1000", "origin", "anywhere"))] for row in summary]
    return run_of("experiment", f"experiment, {about['experiment']}: {directory}",
                  [["seeds", about["seeds"]], ["ceiling", about["ceiling"]]],
                  charts=[chart("learning curves", "reward, moving average of 250 episodes", curves, levels)],
                  tables=[{"name": "interquartile means with 95 % intervals", "columns": columns, "rows": rows, "replay": None}])
