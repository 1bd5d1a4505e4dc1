#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What striker-plane and striker-plot-policy make of a policy: the same bytes again, the choices of the network that
striker-evaluate plays, and one line about what they cannot draw.

Usage: plot_policy_test.py BIN   (the folder of the programs)
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

BIN = sys.argv.pop(1)


def run(program, *words):
    return subprocess.run([os.path.join(BIN, program), *words], capture_output=True, text=True, check=False)


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


class PlotPolicy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.folder = cls.temporary.name
        config = os.path.join(cls.folder, "short.toml")
        with open(config, "w", encoding="utf-8") as file:
            file.write("[run]\nepisodes = 30\n")
        trained = run("striker-train", "--config", config, "--seed", "1", "--out", os.path.join(cls.folder, "run"))
        assert trained.returncode == 0, trained.stderr
        cls.model = os.path.join(cls.folder, "run", "model.safetensors")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def refused(self, program, *words):
        done = run(program, *words)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        return done.stderr

    def test_the_same_model_gives_the_same_bytes_and_says_by_what(self):
        words = ["--cells", "9", "--x", "ball_vx_m_s=-3:1", "--hold", "decisions_left=12"]
        for name in ("once", "again"):
            done = run("striker-plot-policy", self.model, *words, "-o", os.path.join(self.folder, name))
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        for kind in ("svg", "png"):
            picture = read(self.folder, "once", f"policy.{kind}")
            self.assertEqual(picture, read(self.folder, "again", f"policy.{kind}"))
            self.assertIn(b"striker-plot-policy model.safetensors --cells 9 --x ball_vx_m_s=-3:1", picture)
        for text in (b"along the heading, m/s", b"ball to the robot's left, m", b"decisions left 12", b"no plan meets the ball",
                     b"Q, in units of reward"):
            self.assertIn(text, read(self.folder, "once", "policy.svg"))

    def test_what_differs_is_counted_and_what_is_held_is_said(self):
        file = os.path.join(self.folder, "plane.json")
        done = run("striker-plane", self.model, "--cells", "21", "--weights", "int8", "-o", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        plane = json.loads(read(file))
        cells = 21 * 21
        self.assertTrue(all(len(plane[key]) == cells for key in ("float_action", "integer_q", "planned", "touches")))
        differ = sum(one != other for one, other in zip(plane["float_action"], plane["integer_action"]))
        self.assertIn(f"{cells} cells, float and integers differ in {differ}", done.stdout)
        self.assertGreater(differ, 0)
        self.assertEqual([plane["x"]["values"][place] for place in (0, 10, 20)], [-1.0, 1.0, 3.0])
        self.assertEqual(plane["held"], {"robot_speed_m_s": 0.0, "ball_vx_m_s": -0.5, "ball_vy_m_s": -1.5, "decisions_left": 30.0})
        for kind in ("float", "integer"):
            for action, q in zip(plane[f"{kind}_action"], plane[f"{kind}_q"]):
                self.assertAlmostEqual(q[action], max(q), delta=1 / 256)

    def test_what_cannot_be_asked_is_said_in_a_line(self):
        file = os.path.join(self.folder, "none.json")
        for words, said in ((["--x", "ball_z_m=0:1"], "ball_y_m, robot_speed_m_s"), (["--x", "ball_x_m=1"], "FROM:TO"),
                            (["--x", "ball_x_m=2:1"], "less than"), (["--y", "ball_x_m=0:1"], "two different"),
                            (["--hold", "robot_speed_m_s=9"], "-2.55 to 2.55"), (["--hold", "decisions_left=nan"], "1 to 40")):
            self.assertIn(said, self.refused("striker-plane", self.model, *words, "-o", file))
            self.assertIn(said, self.refused("striker-plot-policy", self.model, *words, "-o", os.path.join(self.folder, "none")))
        self.assertIn("nowhere", self.refused("striker-plot-policy", "nowhere", "-o", os.path.join(self.folder, "none")))
        self.assertFalse(os.path.exists(file) or os.path.exists(os.path.join(self.folder, "none")))


if __name__ == "__main__":
    unittest.main()
