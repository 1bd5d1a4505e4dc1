#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Logs of a build whose identifiers are moved, of ODrives and of Striker's own drives: the plotters and the report of such a
build show them, others say why they do not, and a build leaves its own DBC beside its programs.

Usage: moved_log_test.py BIN DRIVE_KICKS MOVED_DBC ROOT   (MOVED_DBC: striker-dbc of the base that DRIVE_KICKS has)
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

BIN, KICKS, MOVED_DBC, ROOT = sys.argv[1:5]
del sys.argv[1:5]
ROW = {"contact": False, "contact_decision": None, "v_contact_m_s": None, "ball_speed_m_s": None, "kicked": False, "driven": True}


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=False)


class MovedLog(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def programs_of_the_build(self):
        os.mkdir(self.path("bin"))
        for name in os.listdir(BIN):
            if name.startswith("striker_") or name in ("striker-plot-kick", "striker-report"):
                shutil.copy(os.path.join(BIN, name), self.path("bin"))
        with open(self.path("bin", "striker.dbc"), "wb") as file:
            subprocess.run([MOVED_DBC], stdout=file, check=True)

    def played(self, kind):
        """A folder of two kicks."""
        os.mkdir(self.path(kind))
        log = self.path(kind, "bus.log")
        rewards = [float(line) for line in subprocess.run([KICKS, kind, "2", log], capture_output=True, text=True,
                                                          check=True).stdout.split()]
        rows = [{"episode": number, "reward": reward, **ROW} for number, reward in enumerate(rewards)]
        with open(self.path(kind, "kick.json"), "w", encoding="utf-8") as file:
            json.dump({"episodes": 2, "mean_reward": sum(rewards) / 2, "reward_ci95": 0.0, "contact_rate": 0.0, "kick_rate": 0.0,
                       "seed": 1, "plant": "drive", "policy": "", "git_hash": "", "undriven_episodes": [], "rows": rows}, file)
        return self.path(kind)

    def test_they_are_shown_by_their_own_build(self):
        self.programs_of_the_build()
        for kind in ("odrive", "striker"):
            kicks = self.played(kind)
            drawn = run(self.path("bin", "striker-plot-kick"), f"{kicks}/bus.log", "-o", f"{kicks}/drawn")
            self.assertEqual((drawn.returncode, drawn.stderr), (0, ""))
            with open(f"{kicks}/drawn/kick.svg", encoding="utf-8") as file:
                self.assertEqual("drives of another make" in file.read(), kind != "striker")
            told = run(self.path("bin", "striker-report"), kicks, "-o", f"{kicks}.html")
            self.assertEqual((told.returncode, told.stderr), (0, ""))
            with open(f"{kicks}.html", encoding="utf-8") as file:
                self.assertIn('"replays":[{"number":0', file.read())

    def test_another_build_says_why_it_cannot(self):
        kicks = self.played("odrive")
        for program, words in (("striker-plot-kick", [f"{kicks}/bus.log"]), ("striker-report", [kicks])):
            done = run(os.path.join(BIN, program), *words, "-o", self.path("none"))
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn("identifier_base", done.stderr)

    def test_a_build_prints_its_own_dbc_beside_its_programs(self):
        """And copies none: it comes with striker-dbc, and that with striker-sil."""
        build = self.path("build")
        done = run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DSTRIKER_TESTS=OFF",
                   f"-DSTRIKER_ROBOT={ROOT}/firmware/robots/forward-odrive.toml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(os.path.exists(f"{build}/bin/striker.dbc"))
        commands = run("ninja", "-C", build, "-t", "commands", "striker-sil").stdout
        self.assertIn(f"striker-dbc > {build}/bin/striker.dbc", commands)
        self.assertIn("-DSTRIKER_CAN_BASE=768", commands)


if __name__ == "__main__":
    unittest.main()
