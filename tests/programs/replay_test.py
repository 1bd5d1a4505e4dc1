#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Recorded runs given to a controller again: the same answers to the bit, in the firmware's program and in the
simulator; and nobody is armed by a recording. Usage: replay_test.py BIN_DIRECTORY"""

import os
import subprocess
import sys
import unittest

import files_case

BIN = sys.argv.pop(1)
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))

RUNS = (("--plant", "drive"), ("--plant", "servo"), ("--pose", "anywhere", "--seed", "7"), ("--bitrate", "1000000"))


def run(name, *arguments):
    return subprocess.run([os.path.join(BIN, name), *arguments], capture_output=True, text=True, timeout=120)


class Replay(files_case.FilesCase):
    def log(self, *arguments, name="run.log"):
        result = run("striker-sil", "kick", "--episodes", "2", "--log", self.file(name), *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.file(name)

    def lines(self, log):
        with open(log, encoding="ascii") as stream:
            return stream.read().splitlines()

    def refuse(self, log, *words):
        for command in (("striker-firmware", "--replay", log), ("striker-sil", "replay", log)):
            result = run(*command)
            self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
            for word in words:
                self.assertIn(word, result.stderr)

    def test_every_answer_is_the_recorded_one(self):
        for arguments in RUNS:
            log = self.log(*arguments)
            for command in (("striker-firmware", "--replay", log), ("striker-sil", "replay", log)):
                result = run(*command)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                self.assertIn("4601 ticks: the answers of 460", result.stdout)
                self.assertNotIn("torque in 0 ticks", result.stdout)

    def test_another_robots_run_needs_its_description(self):
        with open(os.path.join(ROOT, "firmware", "robots", "forward.toml"), encoding="utf-8") as forward:
            robot = self.file("heavy.toml", forward.read().replace("body_mass_g = 1500", "body_mass_g = 1900"))
        log = self.log("--robot", robot)
        self.assertEqual(run("striker-sil", "replay", log, "--robot", robot).returncode, 0)
        other = run("striker-sil", "replay", log)
        self.assertEqual(other.returncode, 1, other.stdout)
        refused = run("striker-sil", "replay", log, "--robot", robot, "--bus", "can:vcan0")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--robot", refused.stderr)

    def test_a_recording_arms_no_controller_that_challenges_otherwise(self):
        for arguments in RUNS:
            log = self.log(*arguments)
            for seed in ("1", "2", "4294967295"):
                result = run("striker-firmware", "--replay", log, "--challenge-seed", seed)
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertIn("torque in 0 ticks", result.stdout)

    def test_one_bit_of_an_answer_is_told_with_its_line(self):
        lines = self.lines(self.log())
        at = next(i for i, line in enumerate(lines) if i > 5000 and " 050#" in line)
        head, last = lines[at][:-1], int(lines[at][-1], 16)
        lines[at] = f"{head}{last ^ 1:X}"
        result = run("striker-firmware", "--replay", self.file("altered.log", "\n".join(lines) + "\n"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("4600 are the recorded ones, 1 differ", result.stdout)
        self.assertIn(f"line {at + 1}: {lines[at].split()[2]} then, ", result.stdout)

    def test_a_missing_and_an_additional_answer_are_told(self):
        lines = self.lines(self.log())
        at = next(i for i, line in enumerate(lines) if i > 5000 and " 050#" in line)
        for changed in (lines[:at] + lines[at + 1:], lines[:at] + [lines[at]] + lines[at:]):
            result = run("striker-firmware", "--replay", self.file("altered.log", "\n".join(changed) + "\n"))
            self.assertEqual(result.returncode, 1)
            self.assertIn("no frame", result.stdout)

    def test_a_log_that_was_cut_off_is_compared_as_far_as_it_goes(self):
        lines = self.lines(self.log())
        result = run("striker-firmware", "--replay", self.file("cut.log", "\n".join(lines[:1001]) + "\n"))
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertRegex(result.stdout, r"^239 ticks: the answers of 23[89] are the recorded ones, 0 differ")

    def test_other_writers_lines_are_read_and_other_frames_are_left_out(self):
        lines = self.lines(self.log())
        foreign = ["(0000000000.000000) vcan0 12345678#00", "(0000000000.000000) vcan0 123##0112233",
                   "(0000000000.000000) vcan0 050#R8", "(0000000000.000000) vcan0 20000004#0000000000000000"]
        text = "\r\n".join(foreign + [line + " R" for line in lines]) + "\r\n"
        result = run("striker-firmware", "--replay", self.file("other.log", text))
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("4 frames that are no classic data frames", result.stdout)

    def test_two_interfaces_need_a_choice(self):
        lines = self.lines(self.log())
        both = self.file("two.log", "\n".join(lines + [line.replace("vcan0", "vcan1") for line in lines]) + "\n")
        self.refuse(both, "two.log: line 19290: frames of vcan0 and of vcan1", "--interface")
        for command in (("striker-firmware", "--replay", both), ("striker-sil", "replay", both)):
            self.assertEqual(run(*command, "--interface", "vcan1").returncode, 0)

    def test_what_is_no_log_is_refused_with_its_place(self):
        sound = "(0000000000.000000) vcan0 030#000000000000\n"
        for line in ("hello", "(1.5) vcan0 030#00", "(0000000000.000000) vcan0", "(0000000000.000000) vcan0 030",
                     "(0000000000.000000) vcan0 30#00", "(0000000000.000000) vcan0 030#0", "(0000000000.000000) vcan0 030#zz",
                     "(0000000000.000000) vcan0 030#001122334455667788", "(0000000000.000000) vcan0 930#00"):
            self.refuse(self.file("bad.log", sound + line + "\n"), "bad.log: line 2: ", "mend or remove the line")
        self.refuse(self.file("empty.log", ""), "no SYNC in it", "--log")
        self.refuse(self.file("none.log"), "none.log", "cannot be read")


if __name__ == "__main__":
    unittest.main()
