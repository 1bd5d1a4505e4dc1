#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What striker-report makes of runs, seen by a browser: a moment that is named in the address shows what the bus carried
then. The log is read here with nothing of the report's.

Usage: report_test.py BIN   (the folder of the programs)
"""

import gzip
import os
import struct
import subprocess
import sys
import tempfile
import unittest

BIN = sys.argv.pop(1)


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
        for broken, named in ((self.folder, "is no run"), (os.path.join(self.folder, "half"), "bus.log")):
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
