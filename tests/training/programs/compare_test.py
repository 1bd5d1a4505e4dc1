#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""striker-experiment compare, with trainings too short to learn anything, and what its figures say: the ceiling is drawn,
"never" is a word, and a level at which nothing differs is left out.

Usage: compare_test.py BIN   (the folder of the programs)
"""

import csv
import os
import subprocess
import sys
import tempfile
import unittest

BIN = sys.argv.pop(1)
EPISODES = 260


def run(program, *words):
    return subprocess.run([os.path.join(BIN, program), *words], capture_output=True, text=True, check=False)


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.folder = cls.temporary.name
        cls.out = os.path.join(cls.folder, "out")
        cls.configs = [cls.config("narrow", 8), cls.config("wide", 16)]
        cls.done = run("striker-experiment", "compare", *cls.configs, "--seeds", "2", "-o", cls.out)
        assert cls.done.returncode == 0, cls.done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def config(cls, name, width, folder=""):
        os.makedirs(os.path.join(cls.folder, folder), exist_ok=True)
        file = os.path.join(cls.folder, folder, f"{name}.toml")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(f"[run]\nepisodes = {EPISODES}\n[learner]\nwarm_up = 100000\n[network]\nhidden = [{width}, {width}]\n")
        return file

    def text_of(self, name):
        with open(os.path.join(self.out, name), encoding="utf-8") as file:
            return file.read()

    def drawn_with(self, **changed):
        """The figures, after the first row of the summary has these values."""
        rows = list(csv.DictReader(self.text_of("summary.csv").splitlines()))
        before = self.text_of("summary.csv")
        rows[0].update(changed)
        file = os.path.join(self.out, "summary.csv")
        with open(file, "w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, rows[0])
            writer.writeheader()
            writer.writerows(rows)
        done = run("striker-plot-experiment", self.out)
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(before)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_names_ceiling_and_units_are_drawn_and_the_same_command_gives_the_same_bytes(self):
        self.drawn_with()
        curves = self.text_of("learning_curves.svg")
        for text in ("narrow", "wide", "ceiling, 8.21", "no contact, -4", "moving average of 250 episodes", "2 seeds",
                     "striker-plot-experiment"):
            self.assertIn(text, curves)
        self.assertNotIn("the paper's best", curves)
        again = run("striker-experiment", "compare", *self.configs, "--seeds", "2", "-o", self.out)
        self.assertEqual((again.returncode, again.stdout), (0, self.done.stdout))
        self.assertEqual(curves, self.text_of("learning_curves.svg"))

    def test_never_is_a_word_and_what_is_constant_is_left_out(self):
        self.assertIn("| never |", self.done.stdout)
        self.assertNotIn(str(EPISODES + 1), self.done.stdout)
        self.drawn_with()
        self.assertFalse(os.path.exists(os.path.join(self.out, "sample_efficiency.svg")))
        self.drawn_with(**{"episodes_to_0": 255, "episodes_to_0_low": 252, "episodes_to_0_high": EPISODES + 1, "reached_0": 1})
        figure = self.text_of("sample_efficiency.svg")
        self.assertEqual([figure.count(text) for text in ("average above 0", "average above -4", "average above 50 %")], [1, 0, 0])
        self.assertIn(">never<", figure)
        self.assertIn("1 of 2 runs", figure)
        self.assertIn("episodes, median", figure)

    def test_the_papers_best_is_drawn_for_the_papers_experiments(self):
        before = self.text_of("experiment.json")
        self.assertIn('"paper_best": null', before)
        with open(os.path.join(self.out, "experiment.json"), "w", encoding="utf-8") as stream:
            stream.write(before.replace('"paper_best": null', '"paper_best": 6.8'))
        self.drawn_with()
        self.assertIn("the paper's best, 6.8", self.text_of("learning_curves.svg"))
        with open(os.path.join(self.out, "experiment.json"), "w", encoding="utf-8") as stream:
            stream.write(before)

    def test_what_cannot_be_compared_is_said_in_a_line(self):
        same, named = self.config("same", 8), self.config("narrow", 12, "elsewhere")
        for words, said in (([self.configs[0], same], "same training as narrow"), ([self.configs[0], named], "another name"),
                            ([self.configs[0], "nowhere.toml"], "nowhere.toml"), (self.configs[:1], "CONFIG")):
            done = run("striker-experiment", "compare", *words, "--seeds", "1", "-o", os.path.join(self.folder, "none"))
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(said, done.stderr)
        done = run("striker-plot-experiment", self.folder)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("experiment.json", done.stderr)


if __name__ == "__main__":
    unittest.main()
