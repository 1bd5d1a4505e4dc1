#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What striker-plot-kick makes of a bus log: the pictures that it promises, the same bytes again, what it drew found again
in the picture, and one line about what it cannot draw.

Usage: plot_kick_test.py BIN   (the folder of the programs)
"""

import os
import subprocess
import sys
import tempfile
import unittest

BIN = sys.argv.pop(1)
PICTURES = sorted(f"{name}.{kind}" for name in ("paths", "kick") for kind in ("svg", "png"))


def run(program, *words):
    return subprocess.run([os.path.join(BIN, program), *words], capture_output=True, text=True, check=False)


class PlotKick(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.log, cls.summary = (os.path.join(cls.folder.name, name) for name in ("bus.log", "kick.json"))
        played = run("striker-sil", "kick", "--episodes", "3", "--seed", "5", "--log", cls.log, "--json", cls.summary)
        assert played.returncode == 0, played.stderr

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def draw(self, name, *words):
        folder = os.path.join(self.folder.name, name)
        done = run("striker-plot-kick", *words, "-o", folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        contents = {}
        for picture in os.listdir(folder):
            with open(os.path.join(folder, picture), "rb") as file:
                contents[picture] = file.read()
        self.assertEqual(sorted(contents), PICTURES)
        return contents

    def refused(self, *words):
        done = run("striker-plot-kick", *words, "-o", os.path.join(self.folder.name, "refused"))
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_the_same_log_gives_the_same_bytes_and_says_by_what(self):
        once = self.draw("once", self.log, "--json", self.summary)
        self.assertEqual(once, self.draw("again", self.log, "--json", self.summary))
        for name, picture in once.items():
            self.assertGreater(len(picture), 10_000, name)
            self.assertIn(b"striker-plot-kick bus.log --json kick.json", picture, name)
            self.assertNotIn(b"<dc:date>", picture, name)

    def test_every_episode_has_its_panel_and_its_reward(self):
        with open(self.summary, encoding="utf-8") as file:
            text = file.read()
        paths = self.draw("rewards", self.log, "--json", self.summary)["paths.svg"].decode()
        for episode in range(3):
            self.assertIn(f"episode {episode}: reward ", paths)
        self.assertIn('"episodes": 3', text)

    def test_without_rewards_too_and_another_episode(self):
        first = self.draw("first", self.log, "--episode", "0")["kick.svg"]
        self.assertIn(b"kick 0 of the log", first)
        self.assertNotEqual(first, self.draw("second", self.log, "--episode", "1")["kick.svg"])

    def test_what_it_cannot_draw_is_said_in_a_line(self):
        self.assertIn("nowhere.log", self.refused(os.path.join(self.folder.name, "nowhere.log")))
        self.assertIn("0 to 2", self.refused(self.log, "--episode", "3"))
        self.assertIn("kick.json", self.refused(self.summary))
        broken = os.path.join(self.folder.name, "broken.log")
        with open(broken, "w", encoding="ascii") as file:
            file.write("(0.0) vcan0 100#FB10000000000000\n(0.0) vcan0 zzz\n")
        self.assertIn("line 2", self.refused(broken))
        with open(broken, "w", encoding="ascii") as file:
            file.write("(0.0) vcan0 100#FB10000000000000\n")
        self.assertIn("no kick", self.refused(broken))
        with open(broken, "w", encoding="ascii") as file:
            file.write('{"rows": [{"reward": 1.0}]}')
        self.assertIn("has 1 episodes, the log has 3", self.refused(self.log, "--json", broken))


if __name__ == "__main__":
    unittest.main()
