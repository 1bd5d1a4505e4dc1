#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""striker-robot as a user meets it. Usage: robot_command_line_test.py BIN_DIRECTORY"""

import json
import os
import subprocess
import sys
import unittest

import files_case

BIN = sys.argv.pop(1)


def robot(*arguments):
    return subprocess.run([os.path.join(BIN, "striker-robot"), *arguments], capture_output=True, text=True, check=False)


class Robot(files_case.FilesCase):
    def test_the_forward_is_what_the_policy_is_for(self):
        result = robot("check", os.path.join(files_case.ROBOTS, "forward.toml"), "--json", self.file("a.json"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("1.800 kg", "11.1 m/s^2", "2.55 m/s", "101 rad/s", "67 degrees", "policy         kick ", " fits"):
            self.assertIn(word, result.stdout)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            figures = json.load(stream)
        self.assertAlmostEqual(figures["moved_mass_kg"], 1.8)
        self.assertIs(figures["policy_fits"], True)

    def test_a_slower_robot_is_not(self):
        result = robot("check", os.path.join(files_case.ROBOTS, "goalkeeper.toml"), "--json", self.file("a.json"))
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        for word in ("does not fit", "2550 mm/s", "-DSTRIKER_POLICY=HEADER"):
            self.assertIn(word, result.stdout)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            self.assertIs(json.load(stream)["policy_fits"], False)

    def test_what_is_no_robot_is_refused_in_one_line(self):
        wrong = self.file("wrong.toml", "body_mass_g = 2.5\n")
        for arguments, words in (((), ("subcommand",)), (("check",), ("file",)), (("check", "/none.toml"), ("/none.toml",)),
                                 (("check", wrong), (wrong, "line 1", "body_mass_g")),
                                 (("check", wrong, "--json", wrong), ("--json",)), (("chek", wrong), ("check",))):
            result = robot(*arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""), arguments)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            for word in words:
                self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
