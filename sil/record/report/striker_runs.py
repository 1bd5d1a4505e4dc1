# SPDX-License-Identifier: Apache-2.0
"""A run's directory as what a report shows of it: plain lists and dictionaries, lengths in mm, times in ms, headings in
whole degrees.

  kind       "kicks", "match", "league", "campaign"
  title      a line
  notices    [why the run, or a part of it, is no whole result, ...]
  facts      [[name, value], ...]
  replays    [{"number", "name", "times", "robots": [[[x, y, heading] or null, ...], ...], "ball": [[x, y] or null, ...],
               "notes": [a line for each time], "marks": [[time, text], ...]}, ...]
  tables     [{"name", "columns", "rows", "replay": the column with the number of the row's replay, or null}, ...]
"""

import collections
import json
import os

from striker_logs import OTHER_BUILD, ROW, LogError, doubts_of, kicks_of, places_of, rows_of, summary_of
from striker_records import (FLAG, LIST, NAMES, NUMBER, NUMBER_OR_NULL, OBJECT, SCORE, TEXT, TEXT_OR_NULL, TEXT_OR_NUMBER, WHOLE,
                             WHOLES, load, load_lines)

KNOWN = (("match.json", "match"), ("kick.json", "kicks"), ("league.json", "league"), ("runs.jsonl", "campaign"))


def read_run(directory):
    for name, kind in KNOWN:
        if os.path.exists(os.path.join(directory, name)):
            read = {"kicks": kicks, "match": match, "league": league, "campaign": campaign}[kind]
            return {"notices": [], **read(directory)}
    raise LogError(f"{directory}: is no run; give a directory with one of {', '.join(name for name, _ in KNOWN)}")


WHOLE_RUN = "give the directory of a whole run"
KICK_FACTS = {"episodes": WHOLE, "mean_reward": NUMBER, "reward_ci95": NUMBER, "contact_rate": NUMBER, "kick_rate": NUMBER,
              "seed": WHOLE, "plant": TEXT, "policy": TEXT, "git_hash": TEXT}
MATCH_FACTS = {"complete": FLAG, "seed": WHOLE, "plant": TEXT, "rule_set": TEXT, "state_hash": TEXT, "git_hash": TEXT}
TEAM = {"team": TEXT, "played": WHOLE, "won": WHOLE, "drawn": WHOLE, "lost": WHOLE, "points": WHOLE,
        "goal_difference": NUMBER_OR_NULL, "goal_difference_half_width": NUMBER_OR_NULL}
PAIRING = {"first": TEXT, "second": TEXT, **{name: kind for name, kind in TEAM.items() if name not in ("team", "points")}}
RUN = {"run": WHOLE, "faults": TEXT, "outcome": TEXT, "violations": LIST, "failure": TEXT}


def taken(record, kinds):
    return {name: record.take(name, kind) for name, kind in kinds.items()}


def figures(record):
    """What of it is no part: numbers."""
    return {name: record.take(name, NUMBER_OR_NULL) for name in record.values if name not in record.names(OBJECT)}


def listed(numbers):
    return ", ".join(map(str, numbers[:20])) + (f" and {len(numbers) - 20} more" if len(numbers) > 20 else "")


def rounded(value, digits=3):
    return round(value, digits) if isinstance(value, float) else value


def kick_replay(kick, row):
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
    name = f"episode {row['episode']}, reward {row['reward']:.3f}{doubts_of(row, kick)}"
    return {"number": row["episode"], "name": name, "times": times, "robots": [robot],
            "ball": [ball.get(time_ms) for time_ms in times], "notes": notes, "marks": []}


def kicks(directory):
    file = os.path.join(directory, "kick.json")
    summary, logged = summary_of(file), kicks_of(os.path.join(directory, "bus.log"))
    known = rows_of(file, len(logged))
    columns = list(ROW)
    rows = [[rounded(row[column]) for column in columns] for row in sorted(known, key=lambda row: row["reward"])]
    undriven = [row["episode"] for row in known if not row["driven"]]
    if sorted(summary.take("undriven_episodes", WHOLES)) != undriven:
        summary.fail("undriven_episodes are not those whose rows say so")
    notices = []
    if undriven:
        notices.append(f"{len(undriven)} of {len(known)} episodes were not driven all along, and are no result of a policy, nor "
                       f"are means with them: {listed(undriven)}")
    notices += [f"bus.log ends in episode {row['episode']}: what is shown of it is not all"
                for kick, row in zip(logged, known) if kick.is_cut]
    facts = [[name, rounded(value)] for name, value in taken(summary, KICK_FACTS).items()]
    return {"kind": "kicks", "title": f"{len(known)} kicks: {directory}", "notices": notices, "facts": facts,
            "replays": [kick_replay(kick, row) for kick, row in zip(logged, known)],
            "tables": [{"name": "episodes, worst first", "columns": columns, "rows": rows, "replay": 0}]}


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
            "notes": [f"bus/vcan0.log.gz to vcan9.log.gz at ({time / 1000:017.6f})" for time in times],
            "marks": [mark_of(event) for event in events]}


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
    return {"kind": "match", "title": f"{title}: {directory}", "notices": notices + undriven_robots(report),
            "facts": [[name, rounded(value)] for name, value in {**facts, **figures(report.part("flow"))}.items()],
            "replays": [match_replay(directory, events, title)],
            "tables": [{"name": "what the teams did", "columns": ["figure", "red", "blue"], "rows": rows, "replay": None}]}


def league(directory):
    table = load(os.path.join(directory, "league.json"), WHOLE_RUN)
    facts = taken(table, {"matches": WHOLE, "incomplete": WHOLE, "git_hash": TEXT})
    notices = [f"{facts['incomplete']} matches were interrupted, and are not in the table"] if facts["incomplete"] else []
    return {"kind": "league", "title": f"league of {len(table.parts('teams'))}: {directory}", "notices": notices,
            "facts": [[name, value] for name, value in facts.items()], "replays": [],
            "tables": [{"name": name, "columns": list(kinds), "replay": None,
                        "rows": [[rounded(value) for value in taken(row, kinds).values()] for row in table.parts(key)]}
                       for name, key, kinds in (("table", "teams", TEAM), ("pairings", "pairings", PAIRING))]}


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
    return {"kind": "campaign", "title": f"campaign of {len(runs)} runs: {directory}", "notices": missing_runs(runs, header),
            "facts": [*([name, value] for name, value in facts.items()), ["runs", len(runs)], ["violated", len(violated)]],
            "replays": [],
            "tables": [{"name": "violations", "columns": ["run", "faults", "violations", "failure"], "replay": None,
                        "rows": [[run["run"], run["faults"], json.dumps(run["violations"]), run["failure"]]
                                 for run in violated]},
                       {"name": "outcomes by kind of fault", "columns": ["fault", "outcome", "runs"], "replay": None,
                        "rows": [[fault, outcome, count] for (fault, outcome), count in sorted(outcomes.items())]}]}
