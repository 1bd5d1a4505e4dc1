#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The pictures of the README files are made again by tools/readme-pictures; what striker-animate and striker-plot-axes
promise, and one line about what they cannot draw.

Usage: pictures_test.py BIN ROOT   (the folder of the programs, and the project's)
"""

import os
import subprocess
import sys
import tempfile
import unittest

from PIL import Image, ImageChops, ImageSequence

BIN, ROOT = sys.argv.pop(1), sys.argv.pop(1)
COMMITTED = os.path.join(ROOT, "sil/record/pictures")
MOST_BYTES = 1_500_000


def run(program, *words):
    return subprocess.run([os.path.join(BIN, program), *words], capture_output=True, text=True, check=False)


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


def shown(file):
    with Image.open(file) as animation:
        return [(frame.info["duration"], frame.convert("RGB")) for frame in ImageSequence.Iterator(animation)]


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.folder = cls.temporary.name
        cls.kicks, cls.match = (os.path.join(cls.folder, name) for name in ("kicks", "match"))
        os.mkdir(cls.kicks)
        for words in (["kick", "--episodes", "3", "--seed", "5", "--log", f"{cls.kicks}/bus.log", "--json",
                       f"{cls.kicks}/kick.json"],
                      ["match", "--first-s", "2", "--seed", "2", "-o", cls.match]):
            played = run("striker-sil", *words)
            assert played.returncode == 0, played.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def refused(self, program, *words):
        done = run(program, *words)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        return done.stderr

    def test_the_pictures_of_the_readme_are_made_again(self):
        drawn = os.path.join(self.folder, "readme")
        done = subprocess.run([f"{ROOT}/tools/readme-pictures", "--bin", BIN, "-o", drawn], capture_output=True, text=True,
                              check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for name in sorted(os.listdir(drawn)):
            if name.endswith(".svg"):
                self.assertEqual(read(drawn, name), read(COMMITTED, name), name)
        self.assertLess(os.path.getsize(f"{COMMITTED}/striker.gif"), MOST_BYTES)
        once, again = shown(f"{COMMITTED}/striker.gif"), shown(f"{drawn}/striker.gif")
        self.assertEqual([duration for duration, _ in once], [duration for duration, _ in again])
        self.assertGreater(len(once), 100)
        for number, ((_, one), (_, other)) in enumerate(zip(once, again)):
            self.assertEqual(one.size, other.size)
            self.assertIsNone(ImageChops.difference(one, other).getbbox(), f"frame {number}")

    def test_an_animation_moves_names_its_command_and_is_the_same_again(self):
        for name in ("one", "other"):
            done = run("striker-animate", self.kicks, self.match, "-o", os.path.join(self.folder, name))
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        animation = read(self.folder, "one", "striker.gif")
        self.assertEqual(animation, read(self.folder, "other", "striker.gif"))
        self.assertIn(b"striker-animate kicks match", animation)
        frames = [frame for _, frame in shown(os.path.join(self.folder, "one", "striker.gif"))]
        moved = [ImageChops.difference(one, other).getbbox() for one, other in zip(frames, frames[1:])]
        self.assertGreater(len(frames), 20)
        self.assertTrue(all(moved[:-1]), moved)  # the last picture is held

    def test_axes_name_their_command_and_units(self):
        done = run("striker-plot-axes", "-o", os.path.join(self.folder, "axes"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        picture = read(self.folder, "axes", "axes.svg")
        for word in (b"striker-plot-axes", b"x, m", b"y, m", b"theta", b"left wheel", b"heading"):
            self.assertIn(word, picture)
        self.assertIn(b"striker-plot-axes", read(self.folder, "axes", "axes.png"))

    def test_what_cannot_be_animated_is_said_in_a_line(self):
        out = os.path.join(self.folder, "none")
        self.assertIn("events.jsonl", self.refused("striker-animate", self.kicks, self.kicks, "-o", out))
        self.assertIn("bus.log", self.refused("striker-animate", self.match, self.match, "-o", out))
        self.assertFalse(os.path.exists(out))
        two = os.path.join(self.folder, "two")
        os.mkdir(two)
        run("striker-sil", "kick", "--episodes", "2", "--seed", "5", "--log", f"{two}/bus.log", "--json", f"{two}/kick.json")
        self.assertIn("at least 3", self.refused("striker-animate", two, self.match, "-o", out))


if __name__ == "__main__":
    unittest.main()
