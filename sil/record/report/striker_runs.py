# SPDX-License-Identifier: Apache-2.0
"""A run's directory as what a report shows of it: plain lists and dictionaries, lengths in mm, times in ms, headings in
whole degrees.

  kind       "kicks", "match", "league", "campaign", "faults", "pil", "training", "experiment"
  title      a line
  facts      [[name, value], ...]
  replays    [{"name", "times", "robots": [[[x, y, heading] or null, ...], ...], "ball": [[x, y] or null, ...],
               "log": the file, "lines": [its line for each time], or none where all logs have that stamp,
               "decisions": [[action, Q, next best Q] or null for each time], "marks": [[time, text], ...],
               "plots": [{"y": with its unit, "series": [{"name", "values": [for each time], "dashed"}, ...]}, ...]}, ...]
  charts     [{"name", "x", "y": with their units, "series": [{"name", "x": [...], "y": [...]}, ...],
               "levels": [[value, text], ...]}, ...]
  tables     [{"name", "columns", "rows", "replay": the column that names the row's replay, or null}, ...]
"""

import collections
import itertools
import json
import os

from striker_logs import LogError, kicks_of, places_of, rewards_of, summary_of

KICK_COLUMNS = ["episode", "reward", "contact", "contact_decision", "v_contact_m_s", "ball_speed_m_s", "kicked"]
KICK_FACTS = ["episodes", "mean_reward", "reward_ci95", "contact_rate", "kick_rate", "seed", "plant", "policy", "git_hash"]
FAULT_COLUMNS = ["name", "faults", "detected_by", "detected_ms", "zero_torque_ms", "outcome", "reward_kept_percent", "violations"]


def run_of(kind, title, facts, **parts):
    return {"kind": kind, "title": title, "facts": facts, "replays": [], "charts": [], "tables": [], **parts}


def load(directory, name, parse):
    file = os.path.join(directory, name)
    try:
        with open(file, encoding="utf-8") as stream:
            return parse(stream)
    except OSError as error:
        raise LogError(f"{file}: {error.strerror}; give the directory of a whole run") from error
    except (ValueError, KeyError, TypeError) as error:
        raise LogError(f"{file}: cannot be read ({error}); make the run again") from error


def rounded(value, digits=3):
    return round(value, digits) if isinstance(value, float) else value


def table_of(name, columns, rows, replay=None):
    return {"name": name, "columns": columns, "replay": replay,
            "rows": [[rounded(row.get(column)) for column in columns] for row in rows]}


def at_pictures(times, rows):
    """For each picture the last of `rows` that is not later, without its time."""
    found, place = [], -1
    for time_ms in times:
        while place + 1 < len(rows) and round(rows[place + 1][0] * 1000) <= time_ms:
            place += 1
        found.append(None if place < 0 else rows[place][1:])
    return found


def series(name, rows, column, dashed=False, scale=1):
    return {"name": name, "values": [None if row is None else round(scale * row[column]) for row in rows], "dashed": dashed}


def kick_replay(number, kick, reward, log):
    times = [round(time_s * 1000) for time_s, *_ in kick.robot]
    ball = {round(time_s * 1000): (round(x_m * 1000), round(y_m * 1000)) for time_s, x_m, y_m in kick.ball}
    decisions = {round(time_s * 1000): (round(action), round(best, 2), round(following, 2))
                 for time_s, action, best, following in kick.decisions}
    commands, wheels = at_pictures(times, kick.commands), at_pictures(times, kick.wheels)
    plots = [{"y": "rim speed, mm/s", "series": [
        series("left, set-point", commands, 0, True), series("left, measured", wheels, 0, scale=1000),
        series("right, set-point", commands, 1, True), series("right, measured", wheels, 1, scale=1000)]},
             {"y": "torque, mNm", "series": [series("left", commands, 2), series("right", commands, 3)]}]
    return {"name": f"episode {number}, reward {reward:.3f}", "times": times,
            "robots": [[(round(x_m * 1000), round(y_m * 1000), round(heading_rad * 57.29577951308232))
                        for _, x_m, y_m, heading_rad in kick.robot]],
            "ball": [ball.get(time_ms) for time_ms in times], "log": log, "lines": kick.lines,
            "decisions": [decisions.get(time_ms) for time_ms in times], "marks": [], "plots": plots}


def played_kicks(directory, name, log):
    """Their summary, and their replays."""
    summary = summary_of(os.path.join(directory, name))
    logged = kicks_of(os.path.join(directory, log), at_pictures=True)
    rewards = rewards_of(os.path.join(directory, name), len(logged))
    return summary, [kick_replay(number, kick, reward, log) for number, (kick, reward) in enumerate(zip(logged, rewards))]


def worst_first(summary):
    return table_of("episodes, worst first", KICK_COLUMNS, sorted(summary["rows"], key=lambda row: row["reward"]), replay=0)


def kicks(directory):
    summary, replays = played_kicks(directory, "kick.json", "bus.log")
    return run_of("kicks", f"{len(replays)} kicks: {directory}", [[name, rounded(summary.get(name))] for name in KICK_FACTS],
                  replays=replays, tables=[worst_first(summary)])


def first_difference(directory, one, other):
    """The number of the first line in which two logs differ; none if they are the same."""
    with open(os.path.join(directory, one), "rb") as left, open(os.path.join(directory, other), "rb") as right:
        return next((number for number, pair in enumerate(itertools.zip_longest(left, right), 1) if pair[0] != pair[1]), None)


def pil(directory):
    summary, replays = played_kicks(directory, "pil.json", "pil.log")
    alone = rewards_of(os.path.join(directory, "sil.json"), len(replays))
    measures = load(directory, "measures.json", json.load)
    try:
        line = first_difference(directory, "sil.log", "pil.log")
    except OSError as error:
        raise LogError(f"{error.filename}: {error.strerror}; give the directory of a whole run of tools/pil") from error
    facts = [["on the board and in one process", "the same frames, byte for byte" if line is None else f"differ from line {line} on"],
             *([name, value] for name, value in measures.items()),
             *([name, rounded(summary.get(name))] for name in KICK_FACTS)]
    rows = [[row["episode"], rounded(row["reward"]), rounded(reward), rounded(row["reward"] - reward)]
            for row, reward in zip(summary["rows"], alone)]
    beside = {"name": "rewards beside the run in one process", "columns": ["episode", "board", "one process", "difference"],
              "rows": rows, "replay": 0}
    return run_of("pil", f"processor in the loop, {len(replays)} kicks: {directory}", facts, replays=replays,
                  tables=[beside, worst_first(summary)])


def match_replay(directory, events, name):
    seen = [places_of(os.path.join(directory, "bus", f"vcan{robot}.log.gz")) for robot in range(10)]
    balls = {}
    for _, ball in seen:
        balls.update(ball)
    times = sorted(balls)
    robots = [[[round(value) for value in places[time]] if time in places else None for time in times]
              for places, _ in seen]
    marks = [[event["t_sim_ns"] // 1_000_000,
              f"{event['event']} ({event['cause']})" + (f", {event['team']}" if event["team"] else "")
              + f", {event['score'][0]}:{event['score'][1]}"] for event in events]
    return {"name": name, "times": times, "robots": robots, "ball": [[round(value) for value in balls[time]] for time in times],
            "log": "bus/vcan0.log.gz to vcan9.log.gz", "lines": [], "decisions": [], "marks": marks, "plots": []}


def match(directory):
    report = load(directory, "match.json", json.load)
    events = load(directory, "events.jsonl", lambda stream: [json.loads(line) for line in stream][1:])
    score = report["result"]["score"]
    title = f"{report['teams'][0]} {score[0]} : {score[1]} {report['teams'][1]}"
    facts = [[name, report[name]] for name in ("complete", "seed", "plant", "rule_set", "state_hash", "git_hash")]
    facts += [[name, rounded(value)] for name, value in report["flow"].items() if not isinstance(value, dict)]
    rows = [[f"{part}: {name}", rounded(value), rounded(report["blue"][part][name])]
            for part, values in report["red"].items() if isinstance(values, dict)
            for name, value in values.items() if not isinstance(value, dict)]
    return run_of("match", f"{title}: {directory}", facts, replays=[match_replay(directory, events, title)],
                  tables=[{"name": "what the teams did", "columns": ["figure", "red", "blue"], "rows": rows, "replay": None}])


def league(directory):
    table = load(directory, "league.json", json.load)
    columns = ["team", "played", "won", "drawn", "lost", "points", "goal_difference", "goal_difference_half_width"]
    pairs = ["first", "second", "played", "won", "drawn", "lost", "goal_difference", "goal_difference_half_width"]
    return run_of("league", f"league of {len(table['teams'])}: {directory}",
                  [[name, table[name]] for name in ("matches", "incomplete", "git_hash")],
                  tables=[table_of("table", columns, table["teams"]), table_of("pairings", pairs, table["pairings"])])


def campaign(directory):
    header, *runs = load(directory, "runs.jsonl", lambda stream: [json.loads(line) for line in stream])
    outcomes = collections.Counter((kind.split()[0], run["outcome"]) for run in runs
                                   for kind in run["faults"].split(", ") if kind)
    violated = [run for run in runs if run["violations"] or run["failure"]]
    return run_of("campaign", f"campaign of {len(runs)} runs: {directory}",
                  [*([name, value] for name, value in header.items()), ["runs", len(runs)], ["violated", len(violated)]],
                  tables=[{"name": "violations", "columns": ["run", "faults", "violations", "failure"], "replay": None,
                           "rows": [[run["run"], run["faults"], json.dumps(run["violations"]), run["failure"]]
                                    for run in violated]},
                          {"name": "outcomes by kind of fault", "columns": ["fault", "outcome", "runs"], "replay": None,
                           "rows": [[fault, outcome, count] for (fault, outcome), count in sorted(outcomes.items())]}])


def faults(directory):
    report = load(directory, "faults.json", json.load)
    rows = report["rows"]
    violations = [[row["name"], number, violation["tick"], violation["invariant"], violation["text"]] for row in rows
                  for number, episode in enumerate(row["episodes"]) for violation in episode["violations"]]
    failures = [[row["name"], number, episode["failure"]] for row in rows
                for number, episode in enumerate(row["episodes"]) if episode["failure"]]
    tables = [table_of("faults", FAULT_COLUMNS, rows),
              {"name": "violations", "columns": ["fault", "episode", "tick, ms", "invariant", "what"], "rows": violations,
               "replay": None},
              {"name": "runs that crashed", "columns": ["fault", "episode", "why"], "rows": failures, "replay": None}]
    facts = [[name, value] for name, value in report.items() if name != "rows"] + [["violations", len(violations)]]
    return run_of("faults", f"{len(rows)} faults: {directory}", facts, tables=[table for table in tables if table["rows"]])
