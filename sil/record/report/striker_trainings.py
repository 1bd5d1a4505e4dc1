# SPDX-License-Identifier: Apache-2.0
"""A training's or an experiment's directory as what a report shows of it (striker_runs.py says how)."""

import os

from striker_records import NUMBER, NUMBER_OR_NULL, TEXT, WHOLE, LogError, load, load_table
from striker_runs import WHOLE_RUN, rounded, run_of, table_of, taken

MOST_POINTS = 600  # of a curve
FLOOR = -4.0
CURVE = {"episode": WHOLE, "moving_average_250": NUMBER, "td_error": NUMBER, "q": NUMBER, "epsilon": NUMBER, "contact": WHOLE}
EVALUATION = {"episode": WHOLE, "mean_reward": NUMBER, "best": WHOLE}
ABOUT = {"experiment": TEXT, "seeds": WHOLE, "ceiling": NUMBER, "paper_best": NUMBER_OR_NULL}
VARIANT = {"name": TEXT, "says": TEXT, "episodes": WHOLE}
LEVELS, FIGURES = ("0", "50%", "90%"), ("best", "final_1000", "origin", "anywhere")
SUMMARY = {"variant": TEXT, **{f"episodes_to_{level}": NUMBER for level in LEVELS},
           **{name + end: NUMBER for name in FIGURES for end in ("", "_low", "_high")}}
POINT = {"variant": TEXT, "episode": WHOLE, "moving_average": NUMBER}


def curve(name, rows, x, y):
    stride = -(-len(rows) // MOST_POINTS)
    chosen = rows[::stride] + ([] if (len(rows) - 1) % stride == 0 else rows[-1:])
    return {"name": name, "x": [row[x] for row in chosen], "y": [rounded(row[y]) for row in chosen]}


def chart(name, y, curves, levels=()):
    return {"name": name, "x": "episode", "y": y, "series": curves, "levels": [list(level) for level in levels]}


def training(directory):
    rows, evaluations = load_table(os.path.join(directory, "learning_curve.csv"), WHOLE_RUN, CURVE), []
    file = os.path.join(directory, "evaluations.csv")
    if os.path.exists(file):
        evaluations = load_table(file, WHOLE_RUN, EVALUATION, least=0)
    charts = [chart("learning curve", "reward, moving average of 250 episodes",
                    [curve("training", rows, "episode", "moving_average_250")]
                    + ([curve("greedy, held-out episodes", evaluations, "episode", "mean_reward")] if evaluations else []),
                    [(FLOOR, "no contact")]),
              chart("errors", "temporal difference, in units of reward", [curve("mean absolute", rows, "episode", "td_error")]),
              chart("Q", "Q, in units of reward", [curve("of the samples", rows, "episode", "q")]),
              chart("exploration", "probability of a random action", [curve("epsilon", rows, "episode", "epsilon")])]
    facts = [["episodes", len(rows)], ["moving average at the end", rows[-1]["moving_average_250"]],
             ["contacts in the last 250", sum(row["contact"] for row in rows[-250:])],
             ["best evaluation", max((row["mean_reward"] for row in evaluations), default="none")]]
    return run_of("training", f"training of {len(rows)} episodes: {directory}", facts, charts=charts,
                  tables=[table_of("evaluations", EVALUATION, evaluations)] if evaluations else [])


def variants_of(record):
    """{name: {"name", "says", "episodes"}}"""
    variants = {variant["name"]: variant for variant in (taken(part, VARIANT) for part in record.parts("variants"))}
    if len(variants) < len(record.parts("variants")):
        record.fail("a variant stands there twice")
    return variants


def of_variants(file, kinds, variants):
    """A table's rows: of each of the variants some, and of no other."""
    rows = load_table(file, WHOLE_RUN, kinds)
    odd = variants.keys() ^ {row["variant"] for row in rows}
    if odd:
        raise LogError(f"{file}: has other variants than experiment.json: {', '.join(sorted(odd))!r}; make the run again")
    return rows


def episodes_to(row, level, variant):
    value = row[f"episodes_to_{level}"]
    return "never" if value > variant["episodes"] else round(value)


def figure(row, name):
    value, low, high = (row[name + end] for end in ("", "_low", "_high"))
    return f"{value:.2f} [{low:.2f}, {high:.2f}]"


def experiment(directory):
    record = load(os.path.join(directory, "experiment.json"), WHOLE_RUN)
    about, variants = taken(record, ABOUT), variants_of(record)
    summary, points = (of_variants(os.path.join(directory, name), kinds, variants)
                       for name, kinds in (("summary.csv", SUMMARY), ("curves.csv", POINT)))
    curves = [curve(variant["says"], [row for row in points if row["variant"] == name], "episode", "moving_average")
              for name, variant in variants.items()]
    levels = [(about["ceiling"], "ceiling"), (FLOOR, "no contact")]
    levels += [] if about["paper_best"] is None else [(about["paper_best"], "the paper's best")]
    columns = ["training", "episodes to 0", "to 50 %", "to 90 %", "best average", "last 1,000", "origin", "anywhere"]
    rows = [[variants[row["variant"]]["says"], *(episodes_to(row, level, variants[row["variant"]]) for level in LEVELS),
             *(figure(row, name) for name in FIGURES)] for row in summary]
    return run_of("experiment", f"experiment, {about['experiment']}: {directory}",
                  [["seeds", about["seeds"]], ["ceiling", about["ceiling"]]],
                  charts=[chart("learning curves", "reward, moving average of 250 episodes", curves, levels)],
                  tables=[{"name": "interquartile means with 95 % intervals", "columns": columns, "rows": rows, "replay": None}])
