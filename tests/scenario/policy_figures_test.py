#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The built-in policy on 2,000 held-out episodes over the in-process bus: the figures that a release must keep.
Usage: policy_figures_test.py BIN_DIRECTORY"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

BIN = sys.argv.pop(1)


def play(plant, pose):
    with tempfile.TemporaryDirectory() as directory:
        file = os.path.join(directory, "a.json")
        subprocess.run([os.path.join(BIN, "striker-sil"), "kick", "--episodes", "2000", "--seed", "1000", "--plant",
                        plant, "--pose", pose, "--json", file], check=True, capture_output=True)
        with open(file, encoding="utf-8") as stream:
            return json.load(stream)


class PolicyFigures(unittest.TestCase):
    def test_rewards_and_their_independence_of_the_place(self):
        for plant in ("servo", "drive"):
            origin = play(plant, "origin")
            anywhere = play(plant, "anywhere")
            print(f"{plant}: mean reward {origin['mean_reward']:.3f} at the origin, "
                  f"{anywhere['mean_reward']:.3f} anywhere, kick rate {origin['kick_rate']:.3f}")
            self.assertGreaterEqual(origin["mean_reward"], 6.0)
            self.assertLess(abs(origin["mean_reward"] - anywhere["mean_reward"]), 0.1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
