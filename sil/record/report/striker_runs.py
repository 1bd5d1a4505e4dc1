# SPDX-License-Identifier: Apache-2.0
"""A run's directory as what a report shows of it: plain lists and dictionaries, lengths in mm, times in ms, headings in
whole degrees.

  kind       "kicks", "match", "league", "campaign"
  title      a line
  facts      [[name, value], ...]
  replays    [{"name", "times", "robots": [[[x, y, heading] or null, ...], ...], "ball": [[x, y] or null, ...],
               "notes": [a line for each time], "marks": [[time, text], ...]}, ...]
  tables     [{"name", "columns", "rows", "replay": the column that names the row's replay, or null}, ...]
"""

import collections
import json
import os

from striker_logs import LogError, kicks_of, places_of, rewards_of, summary_of

KNOWN = (("match.json", "match"), ("kick.json", "kicks"), ("league.json", "league"), ("runs.jsonl", "campaign"))


def read_run(directory):
    for name, kind in KNOWN:
        if os.path.exists(os.path.join(directory, name)):
            return {"kicks": kicks, "match": match, "league": league, "campaign": campaign}[kind](directory)
    raise LogError(f"{directory}: is no run; give a directory with one of {', '.join(name for name, _ in KNOWN)}")


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


def kick_replay(number, kick, reward):
    decisions = dict((round(time_s * 1000), (action, best, following))
                     for time_s, action, best, following in kick.decisions)
    ball = {round(time_s * 1000): (round(x_m * 1000), round(y_m * 1000)) for time_s, x_m, y_m in kick.ball}
    times, robot, notes = [], [], []
    for (time_s, x_m, y_m, heading_rad), line in zip(kick.robot, kick.lines):
        time_ms = round(time_s * 1000)
        note = f"bus.log line {line}"
        if time_ms in decisions:
            action, best, following = decisions[time_ms]
            note += f"; action {action:.0f}, Q {best:.2f}, next best {following:.2f}"
        times.append(time_ms)
        robot.append([round(x_m * 1000), round(y_m * 1000), round(heading_rad * 57.29577951308232)])
        notes.append(note)
    return {"name": f"episode {number}, reward {reward:.3f}", "times": times, "robots": [robot],
            "ball": [ball.get(time_ms) for time_ms in times], "notes": notes, "marks": []}


def kicks(directory):
    summary = summary_of(os.path.join(directory, "kick.json"))
    logged = kicks_of(os.path.join(directory, "bus.log"))
    rewards = rewards_of(os.path.join(directory, "kick.json"), len(logged))
    worst_first = sorted(range(len(rewards)), key=lambda episode: rewards[episode])
    columns = ["episode", "reward", "contact", "contact_decision", "v_contact_m_s", "ball_speed_m_s", "kicked"]
    rows = [[rounded(summary["rows"][episode].get(column)) for column in columns] for episode in worst_first]
    facts = [[name, rounded(summary[name])] for name in
             ("episodes", "mean_reward", "reward_ci95", "contact_rate", "kick_rate", "seed", "plant", "policy", "git_hash")]
    return {"kind": "kicks", "title": f"{len(rewards)} kicks: {directory}", "facts": facts,
            "replays": [kick_replay(number, kick, reward)
                        for number, (kick, reward) in enumerate(zip(logged, rewards))],
            "tables": [{"name": "episodes, worst first", "columns": columns, "rows": rows, "replay": 0}]}


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
            "notes": [f"bus/vcan0.log.gz to vcan9.log.gz at ({time / 1000:017.6f})" for time in times], "marks": marks}


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
    return {"kind": "match", "title": f"{title}: {directory}", "facts": facts,
            "replays": [match_replay(directory, events, title)],
            "tables": [{"name": "what the teams did", "columns": ["figure", "red", "blue"], "rows": rows, "replay": None}]}


def league(directory):
    table = load(directory, "league.json", json.load)
    columns = ["team", "played", "won", "drawn", "lost", "points", "goal_difference", "goal_difference_half_width"]
    pairs = ["first", "second", "played", "won", "drawn", "lost", "goal_difference", "goal_difference_half_width"]
    return {"kind": "league", "title": f"league of {len(table['teams'])}: {directory}",
            "facts": [[name, table[name]] for name in ("matches", "incomplete", "git_hash")], "replays": [],
            "tables": [{"name": name, "columns": names, "replay": None,
                        "rows": [[rounded(row.get(column)) for column in names] for row in table[key]]}
                       for name, key, names in (("table", "teams", columns), ("pairings", "pairings", pairs))]}


def campaign(directory):
    header, *runs = load(directory, "runs.jsonl", lambda stream: [json.loads(line) for line in stream])
    outcomes = collections.Counter((kind.split()[0], run["outcome"]) for run in runs
                                   for kind in run["faults"].split(", ") if kind)
    violated = [run for run in runs if run["violations"] or run["failure"]]
    return {"kind": "campaign", "title": f"campaign of {len(runs)} runs: {directory}",
            "facts": [*([name, value] for name, value in header.items()), ["runs", len(runs)], ["violated", len(violated)]],
            "replays": [],
            "tables": [{"name": "violations", "columns": ["run", "faults", "violations", "failure"], "replay": None,
                        "rows": [[run["run"], run["faults"], json.dumps(run["violations"]), run["failure"]]
                                 for run in violated]},
                       {"name": "outcomes by kind of fault", "columns": ["fault", "outcome", "runs"], "replay": None,
                        "rows": [[fault, outcome, count] for (fault, outcome), count in sorted(outcomes.items())]}]}
