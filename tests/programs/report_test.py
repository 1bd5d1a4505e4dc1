#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What striker-report makes of runs, seen by a browser: a moment that is named in the address shows what the bus carried
then. The log is read here with nothing of the report's.

Usage: report_test.py BIN   (the folder of the programs)
"""

import gzip
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

BIN = sys.argv.pop(1)
MOST_BYTES_A_KICK = 10_000_000 / 1_000
MOST_BYTES_OF_A_MATCH_A_SECOND = 15_000_000 / 600


def run(program, *words):
    return subprocess.run([os.path.join(BIN, program), *words], capture_output=True, text=True, check=False)


def seen_by_browser(page, moment, profile):
    words = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
             f"--user-data-dir={profile}", "--virtual-time-budget=2000", "--dump-dom", f"file://{page}#{moment}"]
    done = subprocess.run(words, capture_output=True, text=True, check=True, timeout=300)
    return done.stdout


def poses(lines):
    """(line's number, time in ms, x and y in mm) of each VisionPose."""
    for number, line in enumerate(lines, 1):
        stamp, _, frame = line.split()
        if frame.startswith("070#"):
            x_quarter, y_quarter, _ = struct.unpack("<hhh", bytes.fromhex(frame[4:])[2:])
            yield number, round(float(stamp[1:-1]) * 1000), x_quarter / 4, y_quarter / 4


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.folder = cls.temporary.name
        cls.kicks, cls.match, cls.page = (os.path.join(cls.folder, name) for name in ("kicks", "match", "report.html"))
        os.mkdir(cls.kicks)
        for words in (["kick", "--episodes", "4", "--seed", "5", "--log", f"{cls.kicks}/bus.log", "--json",
                       f"{cls.kicks}/kick.json"],
                      ["match", "--half-s", "3", "--seed", "2", "-o", cls.match]):
            played = run("striker-sil", *words)
            assert played.returncode == 0, played.stderr
        made = run("striker-report", cls.kicks, cls.match, "-o", cls.page)
        assert made.returncode == 0, made.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def seen(self, moment):
        return seen_by_browser(self.page, moment, os.path.join(self.folder, "profile"))

    def test_a_moment_of_a_kick_is_what_its_line_of_the_log_says(self):
        with open(f"{self.kicks}/bus.log", encoding="ascii") as log:
            by_line = {number: (x_mm, y_mm) for number, _, x_mm, y_mm in poses(log)}
        page = self.seen("run=0&replay=2&time=700")
        state = page.split('id="state0">')[1].split("</div>")[0]
        number = int(state.split("bus.log line ")[1].split(";")[0].split("\n")[0])
        x_mm, y_mm = by_line[number]
        self.assertIn("episode 2, reward ", state)
        shown_s = float(state.split(": ")[1].split(" s")[0])
        self.assertTrue(0.65 < shown_s <= 0.7, state)
        self.assertIn(f"robot 0 ({round(x_mm)}, {round(y_mm)}) mm", state)

    def test_what_is_plotted_of_a_kick_is_what_the_bus_carried(self):
        with open(self.page, encoding="utf-8") as file:
            replay = json.loads(file.read().split('id="data">')[1].split("</script>")[0])[0]["replays"][2]
        speed, torque = replay["plots"]
        self.assertEqual((speed["y"], torque["y"]), ("rim speed, mm/s", "torque, mNm"))
        with open(f"{self.kicks}/bus.log", encoding="ascii") as log:
            lines = log.read().splitlines()
        compared = 0
        for place, number in enumerate(replay["lines"][2:], 2):
            frame = next(line.split()[2] for line in reversed(lines[:number]) if " 060#" in line)
            left_mm_s, right_mm_s = struct.unpack("<hh", bytes.fromhex(frame[4:])[2:6])
            self.assertEqual([values["values"][place] for values in speed["series"][1::2]], [left_mm_s, right_mm_s])
            compared += 1
        self.assertGreater(compared, 35)

    def test_a_report_of_1000_kicks_or_a_whole_match_would_be_small_enough(self):
        sizes = []
        for run_directory in (self.kicks, self.match):
            page = os.path.join(self.folder, "one.html")
            self.assertEqual(run("striker-report", run_directory, "-o", page).returncode, 0)
            sizes.append(os.path.getsize(page))
        self.assertLess(sizes[0] / 4, MOST_BYTES_A_KICK)
        with open(os.path.join(self.match, "match.json"), encoding="utf-8") as file:
            self.assertLess(sizes[1] / json.load(file)["flow"]["sim_s"], MOST_BYTES_OF_A_MATCH_A_SECOND)

    def test_faults_a_board_a_training_and_an_experiment_have_pages_too(self):
        faults, board, training, experiment = (os.path.join(self.folder, name) for name in ("f", "board", "training", "e"))
        os.mkdir(faults)
        config = os.path.join(self.folder, "short.toml")
        with open(config, "w", encoding="utf-8") as file:
            file.write("[run]\nepisodes = 260\nevaluation_period = 100\nvalidation_episodes = 20\n[learner]\nwarm_up = 100000\n")
        wider = shutil.copy(config, os.path.join(self.folder, "wider.toml"))
        with open(wider, "a", encoding="utf-8") as file:
            file.write("[network]\nhidden = [8, 8]\n")
        for words in (["striker-sil", "faults", "--all", "--episodes", "1", "--json", f"{faults}/faults.json"],
                      ["striker-train", "--config", config, "--seed", "1", "--out", training],
                      ["striker-experiment", "compare", config, wider, "--seeds", "1", "--no-figures", "-o", experiment]):
            done = run(*words)
            self.assertEqual(done.returncode, 0, done.stderr)
        shutil.copytree(self.kicks, board)
        for name in ("pil", "sil"):
            for kind, of_kicks in (("log", "bus.log"), ("json", "kick.json")):
                shutil.copy(os.path.join(board, of_kicks), os.path.join(board, f"{name}.{kind}"))
        with open(os.path.join(board, "measures.json"), "w", encoding="utf-8") as file:
            file.write('{"step_instructions": 4242, "stack_bytes": 1, "dropped_frames": 0}')
        page = os.path.join(self.folder, "all.html")
        made = run("striker-report", faults, board, training, experiment, "-o", page)
        self.assertEqual((made.returncode, made.stderr), (0, ""))
        shown = seen_by_browser(page, "run=1&replay=1&time=500", os.path.join(self.folder, "profile"))
        for text in ("SYNC lost", "sync_lost", "step_instructions: 4242", "the same frames, byte for byte", "pil.log line ",
                     "training of 260 episodes", "held-out episodes", "experiment, compare", "<td>wider</td>", "<td>never</td>"):
            self.assertTrue(text in shown, text)
        self.assertEqual(shown.count("<canvas"), 1 + 3 + 4 + 1)
        with open(os.path.join(board, "pil.log"), "a", encoding="ascii") as log:
            log.write("(9999.000000) vcan0 7F0#\n")
        with open(os.path.join(board, "pil.log"), encoding="ascii") as log:
            last = sum(1 for _ in log)
        self.assertEqual(run("striker-report", board, "-o", page).returncode, 0)
        with open(page, encoding="utf-8") as file:
            self.assertEqual(file.read().count(f"differ from line {last} on"), 1)

    def test_a_moment_of_a_match_is_what_ten_buses_said(self):
        state = self.seen("run=1&time=2500").split('id="state1">')[1].split("</div>")[0]
        for robot in range(10):
            with gzip.open(f"{self.match}/bus/vcan{robot}.log.gz", "rt") as log:
                x_mm, y_mm = next((x_mm, y_mm) for _, time_ms, x_mm, y_mm in poses(log) if time_ms == 2500)
            self.assertIn(f"robot {robot} ({round(x_mm)}, {round(y_mm)}) mm", state)

    def test_worst_episodes_come_first_and_events_are_there(self):
        page = self.seen("")
        rewards = [float(row.split("</td>")[0]) for row in page.split('data-replay="')[1:]
                   for row in [row.split("<td>")[2]]]
        self.assertEqual(len(rewards), 4)
        self.assertEqual(rewards, sorted(rewards))
        self.assertIn("half_over", page)

    def test_the_same_runs_give_the_same_bytes_and_need_no_network(self):
        again = os.path.join(self.folder, "again.html")
        self.assertEqual(run("striker-report", self.kicks, self.match, "-o", again).returncode, 0)
        with open(self.page, "rb") as one, open(again, "rb") as other:
            text = one.read()
            self.assertEqual(text, other.read())
        for way_out in (b"http:", b"https:", b"src=", b"@import"):
            self.assertNotIn(way_out, text)

    def test_what_is_no_run_is_refused_in_a_line_and_nothing_is_written(self):
        odd = os.path.join(self.folder, "odd")
        os.makedirs(odd)
        with open(os.path.join(odd, "faults.json"), "w", encoding="utf-8") as file:
            file.write('{"rows": [{}]}')
        nothing = os.path.join(self.folder, "nothing")
        for broken, named in ((nothing, "is no run"), (os.path.join(self.folder, "half"), "bus.log"), (odd, "faults.json")):
            os.makedirs(broken, exist_ok=True)
            if named == "bus.log":
                with open(os.path.join(broken, "kick.json"), "w", encoding="utf-8") as file:
                    file.write('{"rows": []}')
            page = os.path.join(self.folder, "none.html")
            done = run("striker-report", broken, "-o", page)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(named, done.stderr)
            self.assertFalse(os.path.exists(page))


if __name__ == "__main__":
    unittest.main()
