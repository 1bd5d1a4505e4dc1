#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tools/new-robot, copied to where building, learning and playing are stand-ins: what it refuses, in which order it does
what, where it stops, and its table. Usage: new_robot_test.py ROOT"""

import json
import os
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "programs"))

import files_case  # noqa: E402

ROOT = sys.argv.pop()

# Writes what it was called with, then what is behind its option --json or -o.
STAND_IN = """
echo "$(basename "$0") $*" >>"{told}"
case "$*" in {failing}) echo "$(basename "$0"): no" >&2; exit {status} ;; esac
plant=; json=
while [ $# -gt 0 ]; do
  case $1 in --plant) plant=$2 ;; --json) json=$2 ;; esac
  shift
done
[ -z "$json" ] || cp "{figures}/$(basename "$json")" "$json"
"""


def rates(reward):
    return {"mean_reward": reward, "contact_rate": 0.8, "kick_rate": 0.5}


class NewRobot(files_case.FilesCase):
    def setUp(self):
        super().setUp()
        for folder in ("tools", "path", "build/bin", "training/configs", "figures", "out/mine/build/bin"):
            os.makedirs(self.file(folder))
        shutil.copy(os.path.join(ROOT, "tools/new-robot"), self.file("tools/new-robot"))
        self.file("build/CMakeCache.txt", "")
        self.file("training/configs/kick.toml", "")
        self.file("mine.toml", "body_mass_g = 2500\n")
        self.stand_ins()
        for name, figures in (("robot", {}), ("float", rates(5.0)), ("servo", rates(4.9)), ("drive", rates(4.4)),
                              ("ceiling", {"mean_reward": 6.0, "replay": {"better": rates(5.99)},
                                           "rivals": {"planner": rates(5.5)}})):
            self.file(f"figures/{name}.json", json.dumps(figures))

    def stand_ins(self, failing="nothing", status=0):
        """All of them; those whose arguments match the pattern `failing` end with that status."""
        text = STAND_IN.format(told=self.file("told"), figures=self.file("figures"), failing=failing, status=status)
        programs = [f"build/bin/striker-{name}" for name in ("robot", "train", "ceiling", "evaluate", "export")]
        for name in (*programs, "path/cmake", "out/mine/build/bin/striker-sil"):
            os.chmod(self.file(name, f"#!/bin/sh\n{text}"), 0o755)

    def tool(self, *arguments):
        environment = {**os.environ, "PATH": self.file("path") + ":" + os.environ["PATH"]}
        return subprocess.run([self.file("tools/new-robot"), *arguments], capture_output=True, text=True, check=False,
                              timeout=60, env=environment)

    def told(self):
        if not os.path.exists(self.file("told")):
            return []
        with open(self.file("told"), encoding="utf-8") as stream:
            return stream.read().splitlines()

    def test_wrong_use_is_refused_before_anything_is_touched(self):
        mine = self.file("mine.toml")
        for arguments, complaint in (((), "give a robot's description"), ((self.file("none.toml"),), "none.toml"),
                                     ((self.file("tools"),), "no such description"), ((mine, mine), "too many"),
                                     ((mine, "--sed", "1"), "--sed"), ((mine, "--seed"), "--seed needs a value"),
                                     ((mine, "--seed", "-1"), "--seed '-1'"), ((mine, "--seed", "1.5"), "--seed"),
                                     ((mine, "--episodes", "0"), "--episodes '0'"),
                                     ((mine, "--episodes", "900001"), "--episodes"),
                                     ((mine, "--training", "x"), "--training 'x'"),
                                     ((mine, "--training", "10000001"), "--training"),
                                     ((mine, "--config", "none.toml"), "--config: no such file: 'none.toml'"),
                                     ((mine, "--out", mine), "is no folder")):
            result = self.tool(*arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""), (arguments, result.stderr))
            self.assertTrue(result.stderr.startswith("new-robot: "), result.stderr)
            self.assertIn(complaint, result.stderr)
            self.assertIn("tools/new-robot --help", result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1)
        self.assertEqual(self.told(), [])

    def test_help_names_every_option(self):
        result = self.tool("--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("FILE", "--out", "--seed", "--config", "--training", "--episodes", "Exit status", "kick.hpp"):
            self.assertIn(word, result.stdout)

    def test_everything_is_the_robots(self):
        result = self.tool(self.file("mine.toml"), "--seed", "7", "--training", "1000", "--episodes", "20")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        robot, out = self.file("mine.toml"), self.file("out/mine")
        told = self.told()
        self.assertEqual([line.split()[0] for line in told],
                         ["cmake", "striker-robot", "striker-train", "striker-ceiling", "striker-evaluate", "striker-export",
                          "cmake", "cmake", "striker-sil", "striker-sil"])
        self.assertIn(f"--robot {robot} --set run.episodes=1000 --seed 7 --out {out}/training", told[2])
        self.assertIn(f"--robot {robot} --episodes 20 --seed 1000 --rivals", told[3])
        self.assertIn(f"--model {out}/training/model.safetensors --episodes 20 --seed 1000", told[4])
        self.assertIn(f"-DSTRIKER_ROBOT={robot} -DSTRIKER_POLICY={out}/kick.hpp", told[6])
        self.assertIn(f"-B {out}/build ", told[6])
        for line, plant in zip(told[8:], ("servo", "drive")):
            self.assertIn(f"kick --robot {robot} --plant {plant} --episodes 20 --seed 1000", line)

    def test_a_robot_with_drives_of_others_is_played_with_torque_drives_alone(self):
        for drives, plants in (("striker", ["servo", "drive"]), ("odrive", ["drive"])):
            self.file("mine.toml", f'body_mass_g = 2500\ndrives = "{drives}"\n')
            self.stand_ins("*--plant?servo*" if plants == ["drive"] else "nothing", 2)
            result = self.tool(self.file("mine.toml"))
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            played = [line.split("--plant ")[1].split()[0] for line in self.told() if line.startswith("striker-sil")]
            self.assertEqual(played[-len(plants):], plants)
            self.assertIn("SIL with torque drives", result.stdout)
            self.assertEqual("SIL with servos" in result.stdout, "servo" in plants)

    def test_the_best_network_is_taken_where_there_is_one(self):
        os.makedirs(self.file("out/mine/training"))
        self.file("out/mine/training/best.safetensors", "")
        self.assertEqual(self.tool(self.file("mine.toml")).returncode, 0)
        self.assertIn("training/best.safetensors", self.told()[4])

    def test_the_table_has_shares_of_the_way_from_no_contact(self):
        table = self.tool(self.file("mine.toml")).stdout
        for row, reward, score in (("best possible", "6.000", "100.0"), ("planner", "5.500", "95.0"),
                                   ("float network", "5.000", "90.0"), ("SIL with servos", "4.900", "89.0"),
                                   ("SIL with torque drives", "4.400", "84.0")):
            self.assertRegex(table, rf"{row} +{reward} +{score} % +80.0 % +50.0 %\n")

    def test_it_ends_where_something_fails(self):
        self.stand_ins("check*", 2)
        self.assertEqual(self.tool(self.file("mine.toml")).returncode, 2)
        self.assertEqual(self.told()[-1].split()[:2], ["striker-robot", "check"])
        self.stand_ins("check*", 1)
        self.assertEqual(self.tool(self.file("mine.toml")).returncode, 0, "the other build's policy is for another robot")
        for failing, complaint in (("--build*", "the build failed"), ("*run.episodes*", "the training failed"),
                                   ("*--rivals*", "the search"), ("*--model*", "the evaluation failed"),
                                   ("*--report*", "the export failed"), ("*STRIKER_ROBOT*", "could not be configured"),
                                   ("*--target*striker-sil*", "the robot's build failed"),
                                   ("*--plant*drive*", "plant drive")):
            self.stand_ins(failing, 3)
            result = self.tool(self.file("mine.toml"))
            self.assertEqual(result.returncode, 1, failing)
            self.assertIn("new-robot: ", result.stderr)
            self.assertIn(complaint, result.stderr)
            self.assertNotIn("best possible  ", result.stdout)


if __name__ == "__main__":
    unittest.main()
