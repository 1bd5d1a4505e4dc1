#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""striker-sil's files and errors, without a bus. Usage: sil_command_line_test.py BIN_DIRECTORY"""

import json
import os
import re
import resource
import signal
import subprocess
import sys
import time
import unittest

import files_case

BIN = sys.argv.pop(1)


def sil(*arguments):
    return subprocess.run([os.path.join(BIN, "striker-sil"), *arguments], capture_output=True, text=True, timeout=120)


class CommandLine(files_case.FilesCase):
    def expect_error(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(os.listdir(self.directory.name), [])

    def test_the_summary_has_every_field_and_row(self):
        result = sil("kick", "--episodes", "3", "--first", "5", "--seed", "9", "--plant", "servo", "--pose",
                     "anywhere", "--json", self.file("a.json"))
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            summary = json.load(stream)
        self.assertLessEqual({"episodes", "mean_reward", "contact_rate", "reward_ci95", "kick_rate", "seed", "plant",
                              "pose", "policy", "realtime_factor", "rows"}, set(summary))
        self.assertEqual((summary["episodes"], summary["seed"], summary["plant"], summary["pose"]),
                         (3, 9, "servo", "anywhere"))
        self.assertEqual([row["episode"] for row in summary["rows"]], [5, 6, 7])
        self.assertRegex(summary["policy"], "^[0-9a-f]{8}$")
        mean = sum(row["reward"] for row in summary["rows"]) / 3
        self.assertAlmostEqual(mean, summary["mean_reward"], places=9)
        self.assertEqual(os.listdir(self.directory.name), ["a.json"])

    def test_the_log_is_candump_format_in_order(self):
        sil("kick", "--episodes", "1", "--log", self.file("a.log"))
        previous = 0.0
        with open(self.file("a.log"), encoding="ascii") as log:
            for line in log:
                match = re.fullmatch(r"\((\d{10}\.\d{6})\) vcan0 [0-9A-F]{3}#([0-9A-F]{2}){1,8}\n", line)
                self.assertTrue(match, line)
                self.assertGreaterEqual(float(match[1]), previous)
                previous = float(match[1])
        self.assertGreater(previous, 2.0)

    def test_ctrl_c_keeps_the_completed_episodes(self):
        process = subprocess.Popen([os.path.join(BIN, "striker-sil"), "kick", "--episodes", "100000", "--json",
                                    self.file("a.json")], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        told = process.communicate(timeout=20)[1]
        self.assertEqual(process.returncode, 130)
        self.assertIn("they are kept", told)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            summary = json.load(stream)
        self.assertEqual(len(summary["rows"]), summary["episodes"])

    def test_errors_name_what_is_wrong_and_leave_nothing(self):
        self.expect_error(sil("kick", "--plant", "steam"), "--plant", "steam")
        self.expect_error(sil("kick", "--episodes", "0"), "--episodes")
        self.expect_error(sil("kick", "--bus", "tcp:1"), "--bus", "can:vcan0")
        self.expect_error(sil(), "subcommand")
        self.expect_error(sil("kick", "--episodes", "1", "--log", "/nonexistent/a.log"), "/nonexistent/a.log")
        self.expect_error(sil("kick", "--episodes", "1", "--json", "/nonexistent/a.json"), "/nonexistent/a.json")
        self.expect_error(sil("kick", "--episodes", "1", "--decisions", "/nonexistent/a.csv"), "/nonexistent/a.csv")

    def test_a_full_disk_is_an_error_that_keeps_the_lines_before(self):
        # A limit on the size of files fails like a full disk; Python ignores its signal, and so does the child.
        result = subprocess.run([os.path.join(BIN, "striker-sil"), "kick", "--episodes", "2", "--log",
                                 self.file("a.log")], capture_output=True, text=True, restore_signals=False,
                                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000)))
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in (self.file("a.log"), "with room", "what was written before is in " + self.file("a.log.part")):
            self.assertIn(word, result.stderr)
        self.assertEqual(os.listdir(self.directory.name), ["a.log.part"])
        self.assertEqual(os.path.getsize(self.file("a.log.part")), 20000)

    def test_no_bus_is_an_error_that_says_what_to_do(self):
        for arguments in (["striker-firmware", "--can", "nocan9"], ["striker-command", "--can", "nocan9", "status"],
                          ["striker-sil", "kick", "--bus", "can:nocan9"]):
            result = subprocess.run([os.path.join(BIN, arguments[0]), *arguments[1:]], capture_output=True, text=True)
            self.assertEqual(result.returncode, 2)
            self.assertIn("CAN interface 'nocan9'", result.stderr)
            self.assertIn("tools/with-vcan", result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
