#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What striker-report reads: whatever value of a record is another, or gone, the run is refused in a line that names the
file, or what is shown is sound; a log that is damaged is refused, and one that is cut is said to be.

Usage: report_input_test.py BIN   (the folder of the programs)
"""

import copy
import gzip
import itertools
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

BIN = sys.argv.pop(1)
sys.dont_write_bytecode = True
sys.path.insert(0, BIN)

import striker_kinds  # noqa: E402
import striker_runs  # noqa: E402
import striker_trainings  # noqa: E402
from striker_logs import LogError  # noqa: E402

GONE = object()
OTHERS = (GONE, None, True, "words", "", " ", [], [1, 2, 3], ["a", "b"], {}, -1, 0.5, 10**400, math.nan, math.inf, -math.inf)
CAMPAIGN = [{"campaign": 3, "policy": "c54f4f7c", "protocol": 4, "git_hash": "477d13aec4b9"},
            {"run": 0, "faults": "flip_bits Status", "outcome": "rides through", "violations": [], "failure": ""},
            {"run": 1, "faults": "wheel_slips, sync_freeze", "outcome": "stops", "failure": "",
             "violations": [{"tick": 4, "invariant": "torque", "text": "too much"}]}]
FIGURES = {"played": 2, "won": 1, "drawn": 0, "lost": 1, "goal_difference": 0.5, "goal_difference_half_width": None}
LEAGUE = {"matches": 2, "incomplete": 0, "git_hash": "477d13aec4b9",
          "teams": [{"team": "rules", "points": 3, **FIGURES}, {"team": "random", "points": 3, **FIGURES}],
          "pairings": [{"first": "rules", "second": "random", **FIGURES}]}
MEASURES = {"step_instructions": 4242, "stack_bytes": 512, "dropped_frames": 0}
FAULTS = {"plan": "built-in", "plant": "servo", "pose": "origin", "bus": "inproc", "seed": 1, "first_episode": 0,
          "rows": [{"name": "SYNC lost", "faults": "sync_lost", "detected_by": "sync", "detected_ms": 5, "zero_torque_ms": None,
                    "outcome": "stops", "reward_kept_percent": 12.5, "violations": 1,
                    "episodes": [{"failure": "it crashed",
                                  "violations": [{"tick": 4, "invariant": "torque", "text": "too much"}]}]}],
          "version": "1.0", "git_hash": "477d13aec4b9", "build_type": "Release"}
EXPERIMENT = {"experiment": "compare", "seeds": 1, "ceiling": 19.5, "paper_best": None,
              "variants": [{"name": "7", "says": "seven", "episodes": 200}]}
TABLES = {  # "never" crosses 90 %
    "summary.csv": "variant,episodes_to_0,episodes_to_50%,episodes_to_90%,best,best_low,best_high,final_1000,final_1000_low,"
                   "final_1000_high,origin,origin_low,origin_high,anywhere,anywhere_low,anywhere_high\n"
                   "7,50.0,100.5,201.0,1.0,0.5,1.5,1.0,0.5,1.5,1.0,0.5,1.5,1.0,0.5,1.5\n",
    "curves.csv": "variant,episode,moving_average,low,high\n7,100,-1.5000,-2.0000,-1.0000\n7,200,2.5000,2.0000,3.0000\n",
    "learning_curve.csv": "episode,moving_average_250,contact,epsilon,td_error,q\n1,-4.000000,0,1.000000,0,0\n"
                          "2,-3.500000,1,0.990000,1e-05,-0.25\n",
    "evaluations.csv": "episode,mean_reward,best\n2,-1.250000,1\n"}
CELLS = ("", " ", "words", "null", "true", "nan", "inf", "1e999", "0.5,1", "[1]", '"', "-")


def run(program, *words):
    return subprocess.run([os.path.join(BIN, program), *words], capture_output=True, text=True, check=False)


def places(value, path=()):
    """The path of each value in it."""
    yield path
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for name, part in inner:
        yield from places(part, (*path, name))


def changed(value, path, other):
    whole = [copy.deepcopy(value)]
    holder, name = whole, 0
    for step in path:
        holder, name = holder[name], step
    if other is GONE:
        del holder[name]
    else:
        holder[name] = other
    return whole[0] if whole else {}


class ReportInput(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.kicks, cls.match, cls.league, cls.campaign = (os.path.join(cls.temporary.name, name) for name in
                                                          ("kicks", "match", "league", "campaign"))
        for folder in (cls.kicks, cls.league, cls.campaign):
            os.mkdir(folder)
        for words in (["kick", "--episodes", "2", "--seed", "5", "--log", f"{cls.kicks}/bus.log", "--json",
                       f"{cls.kicks}/kick.json"], ["match", "--first-s", "2", "--seed", "2", "-o", cls.match]):
            played = run("striker-sil", *words)
            assert played.returncode == 0, played.stderr
        cls.log = cls.text(f"{cls.kicks}/bus.log")
        cls.write(f"{cls.league}/league.json", json.dumps(LEAGUE))
        cls.write(f"{cls.campaign}/runs.jsonl", "".join(f"{json.dumps(line)}\n" for line in CAMPAIGN))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def tearDown(self):
        self.write(f"{self.kicks}/bus.log", self.log)

    @staticmethod
    def write(file, text):
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)

    @staticmethod
    def text(file):
        with open(file, encoding="utf-8") as stream:
            return stream.read()

    def read(self, folder, *files):
        """The run, or None if it was refused, as it must be, for one of the files."""
        try:
            made = striker_kinds.read_run(folder)
        except LogError as error:
            self.assertTrue(str(error).startswith(tuple(f"{folder}/{file}" for file in files)), error)
            self.assertNotIn("\n", str(error))
            return None
        json.dumps(made, allow_nan=False)
        return made

    def every_change(self, folder, file, record, written, must, *others):
        """`must`: without their values it is refused. `others`: files that may be blamed instead."""
        whole = os.path.join(folder, file)
        before = self.text(whole)
        self.assertIsNotNone(self.read(folder, file))
        tried = 0
        for path in places(record):
            for other in OTHERS:
                self.write(whole, written(changed(record, path, other)))
                made = self.read(folder, file, *others)
                tried += 1
                if path in must and other in (GONE, None):
                    self.assertIsNone(made, f"{path}: {other}")
        self.write(whole, before)
        return tried

    def test_any_change_of_a_run_of_kicks(self):
        record = json.loads(self.text(f"{self.kicks}/kick.json"))
        logged = striker_runs.kicks_of(f"{self.kicks}/bus.log", at_pictures=True)
        must = [(name,) for name in ("git_hash", "mean_reward", "seed", "policy", "plant", "undriven_episodes", "rows")]
        must += [("rows", 1, name) for name in ("episode", "reward", "driven", "kicked")]
        with mock.patch.object(striker_runs, "kicks_of", lambda *_, **__: logged):
            self.assertGreater(self.every_change(self.kicks, "kick.json", record, json.dumps, must), 300)
            for reward in (None, True, "words", math.nan, math.inf, [1]):
                self.write(f"{self.kicks}/kick.json", json.dumps(changed(record, ("rows", 0, "reward"), reward)))
                self.assertIsNone(self.read(self.kicks, "kick.json"), reward)
            beyond = json.dumps(changed(record, ("rows", 0, "reward"), "beyond")).replace('"beyond"', "1e999")
            self.write(f"{self.kicks}/kick.json", beyond)
            self.assertIsNone(self.read(self.kicks, "kick.json"))
        self.write(f"{self.kicks}/kick.json", json.dumps(record))

    def test_any_change_of_a_league(self):
        self.assertGreater(self.every_change(self.league, "league.json", LEAGUE, json.dumps, [("matches",), ("teams",)]), 300)

    def test_any_change_of_a_campaign(self):
        def lines(records):
            return "".join(f"{json.dumps(line)}\n" for line in records) if isinstance(records, list) else json.dumps(records)

        must = [(1, name) for name in ("run", "faults", "outcome", "failure")]
        self.assertGreater(self.every_change(self.campaign, "runs.jsonl", CAMPAIGN, lines, must), 200)
        for text in ("", "\n", '{"campaign": 3}', "[]\n", lines(CAMPAIGN)[:-9], lines([CAMPAIGN[0], CAMPAIGN[1], CAMPAIGN[1]])):
            self.write(f"{self.campaign}/runs.jsonl", text)
            self.assertIsNone(self.read(self.campaign, "runs.jsonl"), text)
        self.write(f"{self.campaign}/runs.jsonl", lines([CAMPAIGN[0], CAMPAIGN[2]]))
        self.assertIn("1 are missing", self.read(self.campaign, "runs.jsonl")["notices"][0])
        self.write(f"{self.campaign}/runs.jsonl", lines(CAMPAIGN))
        self.assertEqual(self.read(self.campaign, "runs.jsonl")["notices"], [])

    def test_any_change_of_a_match(self):
        """Of what it shows beside the logs."""
        record = json.loads(self.text(f"{self.match}/match.json"))
        event = json.loads(self.text(f"{self.match}/events.jsonl").split("\n")[1])
        record["robots"] = record["robots"][:1]
        for part in ("rules", "geometry", "physics"):
            del record[part]
        shown = {name: event[name] for name in ("t_sim_ns", "event", "cause", "team", "score")}

        def lines(value):
            return f"{{}}\n{json.dumps(value)}\n"

        must = [(name,) for name in ("teams", "complete", "seed", "result", "red", "robots")]
        with mock.patch.object(striker_runs, "match_replay", lambda _, events, name: [*map(striker_runs.mark_of, events)]):
            whole = {name: self.text(f"{self.match}/{name}") for name in ("match.json", "events.jsonl")}
            self.assertGreater(self.every_change(self.match, "match.json", record, json.dumps, must), 500)
            self.write(f"{self.match}/events.jsonl", lines(shown))
            self.every_change(self.match, "events.jsonl", shown, lines, [("event",), ("score",)])
        for name, text in whole.items():
            self.write(f"{self.match}/{name}", text)

    def test_any_change_of_a_run_on_a_board(self):
        board = self.folder("board")
        for name in ("pil", "sil"):
            shutil.copy(f"{self.kicks}/bus.log", f"{board}/{name}.log")
            shutil.copy(f"{self.kicks}/kick.json", f"{board}/{name}.json")
        self.write(f"{board}/measures.json", json.dumps(MEASURES))
        record = json.loads(self.text(f"{board}/pil.json"))
        logged = striker_runs.kicks_of(f"{board}/pil.log", at_pictures=True)
        rows = [("rows", 1, name) for name in ("episode", "reward", "driven")]
        with mock.patch.object(striker_runs, "kicks_of", lambda *_, **__: logged):
            self.every_change(board, "measures.json", MEASURES, json.dumps, [(name,) for name in MEASURES])
            self.every_change(board, "pil.json", record, json.dumps, [("mean_reward",), ("undriven_episodes",), *rows])
            self.every_change(board, "sil.json", record, json.dumps, [("rows",), ("undriven_episodes",), *rows])
            self.assertEqual(self.read(board, "pil.json")["notices"], [])
            self.write(f"{board}/measures.json", json.dumps({**MEASURES, "dropped_frames": 3}))
            record["rows"][1]["driven"], record["undriven_episodes"] = False, [1]
            self.write(f"{board}/sil.json", json.dumps(record))
            undriven, dropped = self.read(board, "pil.json")["notices"]
        self.assertIn("in one process: 1 of 2 episodes were not driven", undriven)
        self.assertIn("dropped 3 frames", dropped)

    def test_any_change_of_faults(self):
        folder = self.folder("faults")
        self.write(f"{folder}/faults.json", json.dumps(FAULTS))
        violation = ("rows", 0, "episodes", 0, "violations", 0)
        must = [("plan",), ("git_hash",), ("rows",), ("rows", 0, "name"), ("rows", 0, "outcome"), ("rows", 0, "episodes"),
                (*violation[:4], "failure"), (*violation, "tick"), (*violation, "text")]
        self.assertGreater(self.every_change(folder, "faults.json", FAULTS, json.dumps, must), 400)

    def test_any_change_of_an_experiment(self):
        folder = self.folder("experiment")
        self.write(f"{folder}/experiment.json", json.dumps(EXPERIMENT))
        for name in ("summary.csv", "curves.csv"):
            self.write(f"{folder}/{name}", TABLES[name])
        rows = self.read(folder, "experiment.json")["tables"][0]["rows"]
        self.assertEqual(rows, [["seven", 50, 100, "never", *["1.00 [0.50, 1.50]"] * 4]])
        must = [("experiment",), ("ceiling",), ("variants",), ("variants", 0, "says"), ("variants", 0, "episodes")]
        self.every_change(folder, "experiment.json", EXPERIMENT, json.dumps, must, "summary.csv")
        for name in ("summary.csv", "curves.csv"):
            self.every_cell(folder, name)

    def test_any_change_of_a_training(self):
        folder = self.folder("training")
        for name in ("learning_curve.csv", "evaluations.csv"):
            self.write(f"{folder}/{name}", TABLES[name])
        for name in ("learning_curve.csv", "evaluations.csv"):
            self.every_cell(folder, name)
        self.write(f"{folder}/evaluations.csv", TABLES["evaluations.csv"].split("\n", maxsplit=1)[0] + "\n")
        self.assertEqual(self.read(folder, "learning_curve.csv")["tables"], [])

    def folder(self, name):
        made = os.path.join(self.temporary.name, name)
        os.mkdir(made)
        return made

    def every_cell(self, folder, file):
        """A cell that is asked for and no number is refused, and so are a cut line and a missing column."""
        text = TABLES[file]
        header, *lines = [line.split(",") for line in text.split("\n")[:-1]]
        read = {name for kinds in (striker_trainings.CURVE, striker_trainings.EVALUATION, striker_trainings.SUMMARY,
                                   striker_trainings.POINT) for name in kinds}
        for row, column in itertools.product(range(len(lines)), range(len(header))):
            for cell in CELLS:
                changed_lines = copy.deepcopy(lines)
                changed_lines[row][column] = cell
                self.write(f"{folder}/{file}", "".join(f"{','.join(line)}\n" for line in [header, *changed_lines]))
                made = self.read(folder, file)
                if header[column] in read:
                    self.assertIsNone(made, f"{header[column]}: {cell}")
        for bad in (text[:-1], text[:-4], text.replace(header[1], "x", 1), "\n", text.replace("\n", ",\n", 1)):
            self.write(f"{folder}/{file}", bad)
            self.assertIsNone(self.read(folder, file), bad)
        self.write(f"{folder}/{file}", text)
        self.assertIsNotNone(self.read(folder, file))

    def test_the_program_says_it_in_a_line_and_ends_with_2(self):
        self.write(f"{self.league}/league.json", "{}")
        page = os.path.join(self.temporary.name, "none.html")
        done = run("striker-report", self.league, "-o", page)
        self.write(f"{self.league}/league.json", json.dumps(LEAGUE))
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("league.json: matches is missing", done.stderr)
        self.assertFalse(os.path.exists(page))

    def test_a_damaged_log_of_kicks_is_refused_with_its_line(self):
        lines = self.log.splitlines(keepends=True)
        number = next(place for place, line in enumerate(lines) if " 070#" in line)
        sound = lines[number]
        for bad in (sound[:-3] + "\n", sound[:-2] + "\n", sound.replace("070#", "070#00"), sound.replace("#", "#Z")):
            self.write(f"{self.kicks}/bus.log", "".join([*lines[:number], bad, *lines[number + 1:]]))
            with self.assertRaisesRegex(LogError, f"bus.log: line {number + 1}\\b"):
                striker_kinds.read_run(self.kicks)
        self.write(f"{self.kicks}/bus.log", self.log[:-1])
        with self.assertRaisesRegex(LogError, "is cut"):
            striker_kinds.read_run(self.kicks)

    def test_a_log_that_ends_in_a_kick_is_said_to(self):
        self.assertEqual(striker_kinds.read_run(self.kicks)["notices"], [])
        lines = self.log.splitlines(keepends=True)
        last = max(number for number, line in enumerate(lines) if " 110#" in line)  # Decision
        self.write(f"{self.kicks}/bus.log", "".join(lines[:last]))
        made = striker_kinds.read_run(self.kicks)
        self.assertEqual(made["notices"], ["bus.log ends in episode 1: what is shown of it is not all"])
        self.assertIn("cut", made["replays"][1]["name"])
        self.assertNotIn("cut", made["replays"][0]["name"])

    def test_a_damaged_log_of_a_match_is_refused(self):
        file = f"{self.match}/bus/vcan3.log.gz"
        shutil.copy(file, f"{file}.sound")
        with gzip.open(file, "rt") as stream:
            text = stream.read()
        for bad in (text.replace(" 070#", " 070#0", 1), text.replace(" 070#", " 070#FF", 1), text.replace(" 080#", " 080#x", 1)):
            with gzip.open(file, "wt") as stream:
                stream.write(bad)
            with self.assertRaisesRegex(LogError, "vcan3.log.gz: "):
                striker_kinds.read_run(self.match)
        with open(f"{file}.sound", "rb") as sound, open(file, "wb") as cut:
            cut.write(sound.read()[:-200])
        with self.assertRaisesRegex(LogError, "vcan3.log.gz: "):
            striker_kinds.read_run(self.match)
        shutil.move(f"{file}.sound", file)
        self.assertIn("the match was interrupted: its score is no result", striker_kinds.read_run(self.match)["notices"])


if __name__ == "__main__":
    unittest.main()
