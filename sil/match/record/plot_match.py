#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws a match from its records, as SVG and PNG.

Usage: striker-plot-match MATCH -o DIR

Reads match.json, events.jsonl and frames.csv of the directory MATCH, and writes into DIR: positions (where both teams'
robots were, as heat maps), ball (its path, with goals) and timeline (the referee's rulings and the score). Places are in
red's own frame: red plays to the right, in both halves. The same records give the same bytes.
"""

import csv
import math
import os

import matplotlib.pyplot as plt
from matplotlib.colors import LogNorm
from striker_field import draw_field
from striker_pictures import TEAMS, PlotError, parser_of, run, save
from striker_records import FLAG, NUMBER, SCORE, TEXT, WHOLE, load, load_lines

PROGRAM = "striker-plot-match"
EVENTS = {"goal": "goal", "ball_out": "ball out", "crowding": "crowding", "deadlock": "deadlock",
          "sent_out": "sent out", "sent_home": "sent home", "returned": "returned"}
WAY_OUT = "give the directory of a match"
TEAM = lambda value: value is None or value in TEAMS, "neither red nor blue, and not null"  # noqa: E731


def report_of(directory):
    report = load(os.path.join(directory, "match.json"), WAY_OUT)
    return {"complete": report.take("complete", FLAG), "score": report.part("result").take("score", SCORE),
            "sim_s": report.part("flow").take("sim_s", NUMBER),
            "names": {colour: report.part(colour).take("name", TEXT) for colour in TEAMS}}


def is_place(value):
    return isinstance(value, list) and len(value) == 2 and all(map(NUMBER[0], value))


def event_of(line):
    event = {name: line.take(name, kind) for name, kind in
             (("event", TEXT), ("team", TEAM), ("half", WHOLE), ("t_sim_ns", WHOLE), ("score", SCORE))}
    if event["event"] == "goal":
        event["exit_m"] = line.take("exit_m", (is_place, "no place"))
    return event


def frames_of(directory):
    file = os.path.join(directory, "frames.csv")
    try:
        with open(file, encoding="utf-8", newline="") as stream:
            return columns_of(stream)
    except OSError as error:
        raise PlotError(f"{file}: {error.strerror}; {WAY_OUT}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise PlotError(f"{file}: cannot be read ({error}); play the match again") from error


def number_of(text):
    if not math.isfinite(float(text)):
        raise ValueError(f"{text} is no number")
    return float(text)


def columns_of(stream):
    rows = list(csv.DictReader(stream))
    if not rows:
        raise ValueError("it has no frames")
    robots = [(f"robot_{robot}", suffix) for suffix in ("", "_opp") for robot in range(5)]
    places = [f"{robot}_cur_pos{suffix}_{part}" for robot, suffix in robots for part in (0, 1)] + ["ball_pos_0", "ball_pos_1"]
    return {"frame": [int(row["frame"]) for row in rows],
            "active": {name: [{"True": True, "False": False}[row[name]] for row in rows]
                       for name in (f"{robot}_active{suffix}" for robot, suffix in robots)},
            **{name: [number_of(row[name]) for row in rows] for name in places}}


def positions(frames, report, directory, command):
    figure, panels = plt.subplots(1, 2, figsize=(13, 4.2), layout="constrained")
    for axes, colour, suffix in zip(panels, TEAMS, ("", "_opp")):
        x_m, y_m = [], []
        for robot in range(5):
            plays = frames["active"][f"robot_{robot}_active{suffix}"]
            for places, part in ((x_m, 0), (y_m, 1)):
                column = frames[f"robot_{robot}_cur_pos{suffix}_{part}"]
                places.extend(place for place, active in zip(column, plays) if active)
        axes.grid(False)
        if x_m:
            _, _, _, image = axes.hist2d(x_m, y_m, bins=(90, 50), range=((-4.5, 4.5), (-2.5, 2.5)), cmin=1,
                                         cmap="Reds" if colour == "red" else "Blues",
                                         norm=LogNorm())
            figure.colorbar(image, ax=axes, label="frames of its five robots")
        draw_field(axes)
        axes.set_title(f"{colour}: {report['names'][colour]}")
    save(figure, directory, "positions", command)


# A line for each sequence of frames without a gap.
def ball(frames, events, report, directory, command):
    figure, axes = plt.subplots(figsize=(10, 6), layout="constrained")
    draw_field(axes)
    begin = 0
    for end in range(1, len(frames["frame"]) + 1):
        if end == len(frames["frame"]) or frames["frame"][end] != frames["frame"][end - 1] + 1:
            axes.plot(frames["ball_pos_0"][begin:end], frames["ball_pos_1"][begin:end], color="0.4", linewidth=0.5,
                      alpha=0.6)
            begin = end
    for colour in TEAMS:
        goals = [event for event in events if event["event"] == "goal" and event["team"] == colour]
        places = [(event["exit_m"], 1 if event["half"] == 1 else -1) for event in goals]
        axes.plot([side * exit_m[0] for exit_m, side in places], [side * exit_m[1] for exit_m, side in places], "o",
                  color=TEAMS[colour], label=f"goals of {report['names'][colour]} ({colour}): {len(goals)}")
    axes.legend(loc="upper center")
    axes.set_title("path of the ball")
    save(figure, directory, "ball", command)


def timeline(events, report, directory, command):
    figure, (above, below) = plt.subplots(2, 1, figsize=(12, 6), sharex=True, layout="constrained")
    end_s = report["sim_s"]
    for index, colour in enumerate(TEAMS):
        goals = [event for event in events if event["event"] == "goal" and event["team"] == colour]
        times_s = [0.0, *(event["t_sim_ns"] / 1e9 for event in goals), end_s]
        scores = [0, *(event["score"][index] for event in goals), report["score"][index]]
        above.step(times_s, scores, where="post", color=TEAMS[colour], label=f"{report['names'][colour]} ({colour})")
    for event in events:
        if event["event"] in EVENTS:
            row = list(EVENTS).index(event["event"]) + {"red": -0.12, "blue": 0.12, None: 0.0}[event["team"]]
            below.plot([event["t_sim_ns"] / 1e9], [row], "|", color=TEAMS.get(event["team"], "0.3"), markersize=12)
        if event["event"] == "half_over":
            for axes in (above, below):
                axes.axvline(event["t_sim_ns"] / 1e9, color="black", linewidth=0.7, linestyle=":")
    score = report["score"]
    above.set_title(f"{report['names']['red']} {score[0]} : {score[1]} {report['names']['blue']}"
                    + ("" if report["complete"] else " (interrupted)"))
    above.set_ylabel("goals")
    above.yaxis.get_major_locator().set_params(integer=True)
    above.legend(loc="upper left")
    below.set_yticks(range(len(EVENTS)), EVENTS.values())
    below.set_ylim(len(EVENTS) - 0.5, -0.5)
    below.set_xlim(0.0, end_s)
    below.set_xlabel("simulated time, s; an event is of who scored, gets the ball, or whose robot it is")
    save(figure, directory, "timeline", command)


def draw(options, directory, command):
    report, frames = report_of(options.match), frames_of(options.match)
    _, *events = load_lines(os.path.join(options.match, "events.jsonl"), WAY_OUT)
    events = [event_of(line) for line in events]
    positions(frames, report, directory, command)
    ball(frames, events, report, directory, command)
    timeline(events, report, directory, command)


def main():
    parser = parser_of(PROGRAM, __doc__)
    parser.add_argument("match", metavar="MATCH", help="the directory that striker-sil match wrote")
    run(PROGRAM, draw, parser.parse_args())


if __name__ == "__main__":
    main()
