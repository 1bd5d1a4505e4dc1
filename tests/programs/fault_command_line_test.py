#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""striker-sil faults and campaign: files, messages, exit statuses. Usage: fault_command_line_test.py BIN_DIRECTORY"""

import json
import os
import shutil
import subprocess
import sys
import unittest

import files_case

BIN = sys.argv.pop(1)

PLAN = """
[[case]]
name = "frozen wheels"
[[case.fault]]
kind = "replay"
message = "WheelState"
from_ms = 300
until_ms = 900
[[case]]
name = "error passive"
episode = 2
[[case.fault]]
kind = "error_passive"
from_ms = 0
until_ms = 2000
"""


def sil(*arguments, prefix=()):
    return subprocess.run([*prefix, os.path.join(BIN, "striker-sil"), *arguments], capture_output=True, text=True,
                          timeout=300)


class Faults(files_case.FilesCase):
    def test_a_plan_is_played_and_reported(self):
        result = sil("faults", "--plan", self.file("p.toml", PLAN), "--episodes", "2", "--json", self.file("f.json"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("wheel_state", result.stdout)
        with open(self.file("f.json"), encoding="utf-8") as stream:
            report = json.load(stream)
        self.assertLessEqual({"plan", "plant", "pose", "bus", "seed", "version", "git_hash", "build_type"}, set(report))
        self.assertEqual([len(row["episodes"]) for row in report["rows"]], [2, 1])
        self.assertEqual(report["rows"][1]["detected_by"], "nothing needed")
        self.assertEqual(report["rows"][1]["reward_kept_percent"], 100.0)

    def test_two_jobs_say_the_same(self):
        plan = self.file("p.toml", PLAN)
        one, two = sil("faults", "--plan", plan), sil("faults", "--plan", plan, "--jobs", "2")
        self.assertEqual((one.returncode, two.returncode), (0, 0), one.stderr + two.stderr)
        self.assertIn("frozen wheels", one.stdout)
        self.assertEqual(one.stdout, two.stdout)

    def test_errors_name_what_is_wrong(self):
        for arguments, words in ((["faults", "--plan", self.file("q.toml", PLAN.replace("replay", "repley"))],
                                  ["q.toml", "line 5", "case.fault.kind", "repley"]),
                                 (["faults", "--plan", "/nonexistent.toml"], ["/nonexistent.toml"]),
                                 (["faults", "--plan", self.file("a.toml", PLAN), "--all"], ["--all"]),
                                 (["faults", "--plant", "steam"], ["--plant"]),
                                 (["campaign", "--runs", "3"], ["--out"]),
                                 (["campaign", "--runs", "0", "--out", "x"], ["--runs"])):
            result = sil(*arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            for word in words:
                self.assertIn(word, result.stderr)

    def test_a_campaign_is_the_same_under_mpirun(self):
        self.assertEqual(sil("campaign", "--runs", "8", "--out", self.file("one")).returncode, 0)
        mpirun = shutil.which("mpirun")
        if mpirun is None:
            self.skipTest("no mpirun")
        result = sil("campaign", "--runs", "8", "--out", self.file("two"),
                     prefix=(mpirun, "--allow-run-as-root", "--oversubscribe", "-np", "2"))
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.file("one/runs.jsonl"), encoding="utf-8") as one, open(self.file("two/runs.jsonl"),
                                                                             encoding="utf-8") as two:
            self.assertEqual(one.read(), two.read())


if __name__ == "__main__":
    unittest.main(verbosity=2)
