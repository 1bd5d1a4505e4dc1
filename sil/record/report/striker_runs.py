# SPDX-License-Identifier: Apache-2.0
"""A run's directory as what a report shows of it: plain lists and dictionaries, lengths in mm, times in ms, headings in
whole degrees.

  kind       "kicks", "match", "league", "campaign", "faults", "pil", "training", "experiment"
  title      a line
  notices    [why the run, or a part of it, is no whole result, ...]
  facts      [[name, value], ...]
  replays    [{"number", "name", "times", "robots": [[[x, y, heading] or null, ...], ...], "ball": [[x, y] or null, ...],
               "log": the file, "lines": [its line for each time], or none where all logs have that stamp,
               "decisions": [[action, Q, next best Q] or null for each time], "marks": [[time, text], ...],
               "plots": [{"y": with its unit, "series": [{"name", "values": [for each time], "dashed"}, ...]}, ...]}, ...]
  charts     [{"name", "x", "y": with their units, "series": [{"name", "x": [...], "y": [...]}, ...],
               "levels": [[value, text], ...]}, ...]
  tables     [{"name", "columns", "rows", "replay": the column with the number of the row's replay, or null}, ...]
"""

import collections
import itertools
import json
import os

from striker_logs import OTHER_BUILD, ROW, LogError, doubts_of, kicks_of, places_of, rows_of, summary_of
from striker_records import (FLAG, LIST, NAMES, NUMBER, NUMBER_OR_NULL, OBJECT, SCORE, TEXT, TEXT_OR_NULL, TEXT_OR_NUMBER, WHOLE,
                             WHOLES, load, load_lines)

WHOLE_RUN = "give the directory of a whole run"
WHOLE_PIL = f"{WHOLE_RUN} of tools/pil"
KICK_FACTS = {"episodes": WHOLE, "mean_reward": NUMBER, "reward_ci95": NUMBER, "contact_rate": NUMBER, "kick_rate": NUMBER,
              "seed": WHOLE, "plant": TEXT, "policy": TEXT, "git_hash": TEXT}
MATCH_FACTS = {"complete": FLAG, "seed": WHOLE, "plant": TEXT, "rule_set": TEXT, "state_hash": TEXT, "git_hash": TEXT}
TEAM = {"team": TEXT, "played": WHOLE, "won": WHOLE, "drawn": WHOLE, "lost": WHOLE, "points": WHOLE,
        "goal_difference": NUMBER_OR_NULL, "goal_difference_half_width": NUMBER_OR_NULL}
PAIRING = {"first": TEXT, "second": TEXT, **{name: kind for name, kind in TEAM.items() if name not in ("team", "points")}}
RUN = {"run": WHOLE, "faults": TEXT, "outcome": TEXT, "violations": LIST, "failure": TEXT}
MEASURES = {"step_instructions": WHOLE, "stack_bytes": WHOLE, "dropped_frames": WHOLE}
FAULT_FACTS = ("plan", "plant", "pose", "bus", "seed", "first_episode", "git_hash")
FAULT = {"name": TEXT, "faults": TEXT, "detected_by": TEXT, "detected_ms": NUMBER_OR_NULL, "zero_torque_ms": NUMBER_OR_NULL,
         "outcome": TEXT, "reward_kept_percent": NUMBER_OR_NULL, "violations": WHOLE}
VIOLATION = {"tick": WHOLE, "invariant": TEXT, "text": TEXT}


def run_of(kind, title, facts, **parts):
    return {"kind": kind, "title": title, "notices": [], "facts": [[name, rounded(value)] for name, value in facts], "replays": [],
            "charts": [], "tables": [], **parts}


def taken(record, kinds):
    return {name: record.take(name, kind) for name, kind in kinds.items()}


def figures(record):
    """What of it is no part: numbers."""
    return {name: record.take(name, NUMBER_OR_NULL) for name in record.values if name not in record.names(OBJECT)}


def listed(numbers):
    return ", ".join(map(str, numbers[:20])) + (f" and {len(numbers) - 20} more" if len(numbers) > 20 else "")


def rounded(value, digits=3):
    return round(value, digits) if isinstance(value, float) else value


def table_of(name, columns, rows, replay=None):
    return {"name": name, "columns": list(columns), "replay": replay,
            "rows": [[rounded(row[column]) for column in columns] for row in rows]}


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


def kick_replay(kick, row, log):
    times = [round(time_s * 1000) for time_s, *_ in kick.robot]
    ball = {round(time_s * 1000): (round(x_m * 1000), round(y_m * 1000)) for time_s, x_m, y_m in kick.ball}
    decisions = {round(time_s * 1000): (round(action), round(best, 2), round(following, 2))
                 for time_s, action, best, following in kick.decisions}
    commands, wheels = at_pictures(times, kick.commands), at_pictures(times, kick.wheels)
    plots = [{"y": "rim speed, mm/s", "series": [
        series("left, set-point", commands, 0, True), series("left, measured", wheels, 0, scale=1000),
        series("right, set-point", commands, 1, True), series("right, measured", wheels, 1, scale=1000)]},
             {"y": "torque, mNm", "series": [series("left", commands, 2), series("right", commands, 3)]}]
    name = f"episode {row['episode']}, reward {row['reward']:.3f}{doubts_of(row, kick)}"
    return {"number": row["episode"], "name": name, "times": times,
            "robots": [[(round(x_m * 1000), round(y_m * 1000), round(heading_rad * 57.29577951308232))
                        for _, x_m, y_m, heading_rad in kick.robot]],
            "ball": [ball.get(time_ms) for time_ms in times], "log": log, "lines": kick.lines,
            "decisions": [decisions.get(time_ms) for time_ms in times], "marks": [], "plots": plots}


def not_driven(summary, rows):
    undriven = [row["episode"] for row in rows if not row["driven"]]
    if sorted(summary.take("undriven_episodes", WHOLES)) != undriven:
        summary.fail("undriven_episodes are not those whose rows say so")
    return [f"{len(undriven)} of {len(rows)} episodes were not driven all along, and are no result of a policy, nor "
            f"are means with them: {listed(undriven)}"] if undriven else []


def played_kicks(directory, name, log):
    """What is known of each episode, facts, and what a run of kicks has beside them."""
    file = os.path.join(directory, name)
    summary, logged = summary_of(file), kicks_of(os.path.join(directory, log), at_pictures=True)
    rows = rows_of(file, len(logged))
    notices = not_driven(summary, rows)
    notices += [f"{log} ends in episode {row['episode']}: what is shown of it is not all"
                for kick, row in zip(logged, rows) if kick.is_cut]
    worst_first = table_of("episodes, worst first", ROW, sorted(rows, key=lambda row: row["reward"]), replay=0)
    return rows, taken(summary, KICK_FACTS), {"notices": notices, "tables": [worst_first], "replays": [
        kick_replay(kick, row, log) for kick, row in zip(logged, rows)]}


def kicks(directory):
    rows, facts, parts = played_kicks(directory, "kick.json", "bus.log")
    return run_of("kicks", f"{len(rows)} kicks: {directory}", facts.items(), **parts)


def first_difference(directory, one, other):
    """The number of the first line in which two logs differ; none if they are the same."""
    with open(os.path.join(directory, one), "rb") as left, open(os.path.join(directory, other), "rb") as right:
        return next((number for number, pair in enumerate(itertools.zip_longest(left, right), 1) if pair[0] != pair[1]), None)


def pil(directory):
    rows, facts, parts = played_kicks(directory, "pil.json", "pil.log")
    file = os.path.join(directory, "sil.json")
    alone = rows_of(file, len(rows))
    if alone[0]["episode"] != rows[0]["episode"]:
        raise LogError(f"{file}: its first episode is {alone[0]['episode']}, the board's {rows[0]['episode']}; give those of one run")
    measures = taken(load(os.path.join(directory, "measures.json"), WHOLE_PIL), MEASURES)
    try:
        line = first_difference(directory, "sil.log", "pil.log")
    except OSError as error:
        raise LogError(f"{error.filename}: {error.strerror}; {WHOLE_PIL}") from error
    parts["notices"] += [f"in one process: {notice}" for notice in not_driven(summary_of(file), alone)]
    if measures["dropped_frames"]:
        parts["notices"].append(f"the board dropped {measures['dropped_frames']} frames: the run is no result")
    same = "the same frames, byte for byte" if line is None else f"differ from line {line} on"
    beside = {"name": "rewards beside the run in one process", "columns": ["episode", "board", "one process", "difference"],
              "rows": [[row["episode"], rounded(row["reward"]), rounded(other["reward"]), rounded(row["reward"] - other["reward"])]
                       for row, other in zip(rows, alone)], "replay": 0}
    return run_of("pil", f"processor in the loop, {len(rows)} kicks: {directory}",
                  [["on the board and in one process", same], *measures.items(), *facts.items()],
                  **{**parts, "tables": [beside, *parts["tables"]]})


def match_replay(directory, events, name):
    seen = [places_of(os.path.join(directory, "bus", f"vcan{robot}.log.gz")) for robot in range(10)]
    balls = {}
    for _, ball in seen:
        balls.update(ball)
    times = sorted(balls)
    if not times:
        raise LogError(f"{directory}/bus: tells no place of the ball; {OTHER_BUILD}")
    robots = [[[round(value) for value in places[time]] if time in places else None for time in times]
              for places, _ in seen]
    return {"number": 0, "name": name, "times": times, "robots": robots,
            "ball": [[round(value) for value in balls[time]] for time in times],
            "log": "bus/vcan0.log.gz to vcan9.log.gz", "lines": [], "decisions": [],
            "marks": [mark_of(event) for event in events], "plots": []}


def mark_of(event):
    team, (red, blue) = event.take("team", TEXT_OR_NULL), event.take("score", SCORE)
    return [event.take("t_sim_ns", WHOLE) // 1_000_000,
            f"{event.take('event', TEXT)} ({event.take('cause', TEXT)})" + (f", {team}" if team else "") + f", {red}:{blue}"]


def undriven_robots(report):
    seconds = [robot.take("undriven_s", NUMBER) for robot in report.parts("robots")]
    told = [f"robot {number} {value:.1f} s" for number, value in enumerate(seconds) if value > 0]
    return [f"not driven while they might play: {', '.join(told)}"] if told else []


def match(directory):
    report = load(os.path.join(directory, "match.json"), WHOLE_RUN)
    _, *events = load_lines(os.path.join(directory, "events.jsonl"), WHOLE_RUN)
    teams, score = report.take("teams", NAMES), report.part("result").take("score", SCORE)
    title = f"{teams[0]} {score[0]} : {score[1]} {teams[1]}"
    facts = taken(report, MATCH_FACTS)
    notices = [] if facts["complete"] else ["the match was interrupted: its score is no result"]
    red, blue = report.part("red"), report.part("blue")
    rows = [[f"{part}: {name}", rounded(value), rounded(blue.part(part).take(name, NUMBER_OR_NULL))]
            for part in red.names(OBJECT) for name, value in figures(red.part(part)).items()]
    return run_of("match", f"{title}: {directory}", {**facts, **figures(report.part("flow"))}.items(),
                  notices=notices + undriven_robots(report), replays=[match_replay(directory, events, title)],
                  tables=[{"name": "what the teams did", "columns": ["figure", "red", "blue"], "rows": rows, "replay": None}])


def league(directory):
    table = load(os.path.join(directory, "league.json"), WHOLE_RUN)
    facts = taken(table, {"matches": WHOLE, "incomplete": WHOLE, "git_hash": TEXT})
    notices = [f"{facts['incomplete']} matches were interrupted, and are not in the table"] if facts["incomplete"] else []
    return run_of("league", f"league of {len(table.parts('teams'))}: {directory}", facts.items(), notices=notices,
                  tables=[table_of(name, kinds, [taken(row, kinds) for row in table.parts(key)])
                          for name, key, kinds in (("table", "teams", TEAM), ("pairings", "pairings", PAIRING))])


def missing_runs(runs, header):
    numbers = {run["run"] for run in runs}
    if len(numbers) < len(runs):
        header.fail("a run stands there twice")
    if len(numbers) == max(numbers, default=-1) + 1:
        return []
    return [f"of the runs up to {max(numbers)}, {max(numbers) + 1 - len(numbers)} are missing: the campaign was stopped, or goes on"]


def campaign(directory):
    header, *lines = load_lines(os.path.join(directory, "runs.jsonl"), WHOLE_RUN)
    facts = taken(header, {"campaign": WHOLE, **{name: TEXT_OR_NUMBER for name in header.values if name != "campaign"}})
    runs = [taken(line, RUN) for line in lines]
    outcomes = collections.Counter((kind.split()[0], run["outcome"]) for run in runs
                                   for kind in run["faults"].split(", ") if kind.strip())
    violated = [run for run in runs if run["violations"] or run["failure"]]
    return run_of("campaign", f"campaign of {len(runs)} runs: {directory}",
                  [*facts.items(), ["runs", len(runs)], ["violated", len(violated)]], notices=missing_runs(runs, header),
                  tables=[{"name": "violations", "columns": ["run", "faults", "violations", "failure"], "replay": None,
                           "rows": [[run["run"], run["faults"], json.dumps(run["violations"]), run["failure"]]
                                    for run in violated]},
                          {"name": "outcomes by kind of fault", "columns": ["fault", "outcome", "runs"], "replay": None,
                           "rows": [[fault, outcome, count] for (fault, outcome), count in sorted(outcomes.items())]}])


def faults(directory):
    report = load(os.path.join(directory, "faults.json"), WHOLE_RUN)
    rows = [taken(row, FAULT) for row in report.parts("rows")]
    played = [(row.take("name", TEXT), number, episode) for row in report.parts("rows")
              for number, episode in enumerate(row.parts("episodes"))]
    violations = [[name, number, *taken(violation, VIOLATION).values()] for name, number, episode in played
                  for violation in episode.parts("violations")]
    failures = [[name, number, failure] for name, number, episode in played if (failure := episode.take("failure", TEXT))]
    tables = [table_of("faults", FAULT, rows),
              {"name": "violations", "columns": ["fault", "episode", "tick, ms", "invariant", "what"], "rows": violations,
               "replay": None},
              {"name": "runs that crashed", "columns": ["fault", "episode", "why"], "rows": failures, "replay": None}]
    facts = taken(report, dict.fromkeys([*FAULT_FACTS, *(name for name in report.values if name != "rows")], TEXT_OR_NUMBER))
    return run_of("faults", f"{len(rows)} faults: {directory}", [*facts.items(), ["violations", len(violations)]],
                  tables=[table for table in tables if table["rows"]])
