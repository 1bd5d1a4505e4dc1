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

    def test_a_step_is_told_and_written(self):
        forward = os.path.join(files_case.ROBOTS, "forward.toml")
        result = robot("step", forward, "--vary", "mass=0.7", "--step-ms", "300", "--csv", self.file("step.csv"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("rise ", "overshoot ", "slip "):
            self.assertIn(word, result.stdout)
        with open(self.file("step.csv"), encoding="utf-8") as stream:
            lines = stream.read().splitlines()
        self.assertEqual(lines[0], "time_ms,set_point_mm_s,measured_mm_s,rolling_mm_s,torque_mNm,moved_mm_s")
        self.assertEqual(len(lines), 1 + 4 * 300)
        for wrong in (("--set-point", "2.6"), ("--vary", ""), ("--vary", "mass=0.7,"), ("--vary", "mass=1,mass=2")):
            refused = robot("step", forward, *wrong)
            self.assertEqual((refused.returncode, refused.stdout), (2, ""), wrong)
            self.assertEqual(len(refused.stderr.splitlines()), 1, refused.stderr)

    def test_the_steps_are_drawn_to_the_same_bytes(self):
        pictures = []
        for folder in ("a", "b"):
            out = self.file(folder)
            done = subprocess.run([os.path.join(BIN, "striker-plot-steps"),
                                   os.path.join(files_case.ROBOTS, "forward.toml"), "-o", out],
                                  capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(sorted(os.listdir(out)), ["forward_steps.png", "forward_steps.svg"])
            with open(os.path.join(out, "forward_steps.svg"), "rb") as picture:
                pictures.append(picture.read())
        self.assertEqual(*pictures)

    def test_what_cannot_be_drawn_is_told_in_one_line_and_leaves_nothing(self):
        forward = os.path.join(files_case.ROBOTS, "forward.toml")
        wrong = self.file("wrong.toml", "body_mass_g = 2.5\n")
        taken = os.path.join(self.file("taken"), "forward_steps.svg")
        os.makedirs(taken)
        for arguments in ((wrong, "-o", self.file("a")), (forward, wrong, "-o", self.file("a")), (forward, "-o", ""),
                          (forward, "-o", forward), (forward, "-o", "/proc/x"), (forward, "-o", self.file("taken")),
                          (forward, forward, "-o", self.file("a"))):
            done = subprocess.run([os.path.join(BIN, "striker-plot-steps"), *arguments], capture_output=True, text=True,
                                  check=False)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse(os.path.exists(self.file("a")))
        self.assertEqual(os.listdir(self.file("taken")), ["forward_steps.svg"])

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

    # Bytes, since some are no text. {} is the number of body_mass_g, and the rest of its line.
    ODD = (b"1_500", b"1500 # kg\r", b"1500\t", b"1500 # \xc2\xb5", b"0", b"+1500", b"+0", b"-0", b"0x5DC", b"0o2734", b"0b1", b"007",
           b"1_", b"_1", b"1__5", b"1500\r\r", b"15\r00", b"1500 # a\x01b", b"1500 # \x7f", b"1500\x0c", b"1500\x0b", b"1500;",
           b"1500\nbody_mass_g = 1500", b"1500\n'x' = 1", b"'1500'", b"1500.0", b"1.5e3", b"[1500]", b"true", b"inf", b"")

    def builds(self, path):
        script = self.file("write.cmake", "cmake_minimum_required(VERSION 3.25)\n"
                           f"include({files_case.ROBOTS}/robot_header.cmake)\n"
                           f"striker_write_robot({path} {self.file('robot.hpp')})\n")
        return subprocess.run(["cmake", "-P", script], capture_output=True, check=False).returncode == 0

    def test_it_refuses_what_the_firmwares_build_refuses_and_what_is_no_toml_both_refuse(self):
        with open(os.path.join(files_case.ROBOTS, "forward.toml"), "rb") as stream:
            forward = stream.read()
        line = b"body_mass_g = 1500"
        self.assertIn(line, forward)
        files = [forward.replace(line, b"body_mass_g = " + odd) for odd in self.ODD]
        files += [b"\xef\xbb\xbf" + forward, forward.replace(line, b'"body_mass_g" = 1500'), forward.replace(line, b"[robot]\n" + line),
                  forward.replace(line, b"body_mass_g\r = 1500"), forward.replace(b"\n", b"\r\n"), forward.rstrip(b"\n")]
        taken = 0
        for content in files:
            path = self.file("odd.toml")
            with open(path, "wb") as stream:
                stream.write(content)
            checked = robot("check", path).returncode != 2
            if b"= 0\n" not in content:  # the compiler refuses what is out of range
                self.assertEqual(checked, self.builds(path), content)
            taken += checked
        self.assertEqual(taken, 7)


if __name__ == "__main__":
    unittest.main(verbosity=2)
