#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The examples of the Python package run, and lead from a training to software in the loop. Usage: examples_test.py
BIN_DIRECTORY PACKAGE_DIRECTORY"""

import os
import re
import subprocess
import sys
import unittest

from package_case import BIN, PackageCase

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../training/python/examples")


class Examples(PackageCase):
    def run_example(self, name, *arguments):
        result = subprocess.run([sys.executable, os.path.join(EXAMPLES, name), *arguments], capture_output=True, text=True,
                                check=False, env={**os.environ, "PYTHONPATH": os.environ["STRIKER_PACKAGE"]})
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_from_a_training_to_the_bus(self):
        model, header = self.path("dqn.safetensors"), self.path("dqn.hpp")
        said = self.run_example("train_dqn.py", "-o", model, "--steps", "40000", "--episodes", "300")
        greedy = float(re.search(r"mean reward (-?[0-9.]+)", said)[1])
        self.assertGreater(greedy, -3.3)  # better than any play that does not look
        played = self.must_run("striker-evaluate", "--model", model, "--episodes", 300, "--seed", 1000, "--world", "fast")
        self.assertAlmostEqual(float(re.search(r"mean reward (-?[0-9.]+)", played)[1]), greedy, delta=0.05)
        stations = self.run_example("model_to_sil.py", BIN, model, "-o", header, "--episodes", "20")
        self.assertEqual(re.findall(r"^(float network|integer network|on the bus, servo|on the bus, drive)", stations, re.M),
                         ["float network", "integer network", "on the bus, servo", "on the bus, drive"])
        self.assertTrue(os.path.exists(header))

    def test_a_reward_of_ones_own(self):
        self.assertIn("100 worlds", self.run_example("custom_reward.py"))

    def run_where_installed(self, name, *arguments):
        """The model that an example of another library's learner writes; nothing where the library is missing, and said so."""
        model = self.path("model.safetensors")
        result = subprocess.run([sys.executable, os.path.join(EXAMPLES, name), "-o", model, *arguments], capture_output=True,
                                text=True, check=False, env={**os.environ, "PYTHONPATH": os.environ["STRIKER_PACKAGE"] + ":" +
                                                             os.environ.get("PYTHONPATH", "")})
        if result.returncode != 0:
            self.assertRegex(result.stderr, f"^{name}: No module named .*train_dqn.py\n$")
            self.assertFalse(os.path.exists(model))
            return None
        self.must_run("striker-evaluate", "--model", model, "--episodes", 5, "--seed", 1)
        return model

    def test_stable_baselines(self):
        self.run_where_installed("train_sb3.py", "--steps", "3000", "--episodes", "10")

    def test_cleanrl(self):
        model = self.run_where_installed("train_cleanrl.py", "--steps", "6400")
        if model is not None:
            self.must_run("striker-export", model, "-o", self.path("cleanrl.hpp"))
            with open(self.path("cleanrl.hpp"), encoding="utf-8") as stream:
                self.assertIn("Policy3<6, 64, 64, 32, 3, 16> cleanrl", stream.read())

    def test_speed(self):
        said = self.run_example("speed.py", "--share", "0.002")
        self.assertRegex(said, "KickEnv .* steps/s\nVectorKickEnv,   64 .*\nVectorKickEnv, 1024 .*\n.*times one\nMatchEnv .*real time")


if __name__ == "__main__":
    unittest.main(verbosity=2)
