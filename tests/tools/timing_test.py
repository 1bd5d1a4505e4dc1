#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tools/timing-test measures, prints and writes; what it measures does not matter here.
Usage: timing_test.py TIMING_TEST BUILD_DIRECTORY"""

import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest

BUILD = sys.argv.pop()
TOOL = sys.argv.pop()


def tool(*arguments):
    return subprocess.run([TOOL, "--build-dir", BUILD, *arguments], capture_output=True, text=True)


class TimingTest(unittest.TestCase):
    def test_both_are_measured_printed_and_written(self):
        with tempfile.TemporaryDirectory() as directory:
            result = tool("--seconds", "1", "--pairs", "2", "--load", "cpu", "--out", directory)
            self.assertEqual(result.returncode, 0, result.stderr)
            for word in ("kernel", "preemption", "SCHED_FIFO 80", "cyclictest", "controller", "p99.99", "over 1 ms",
                         "by pair:"):
                self.assertIn(word, result.stdout)
            self.assertEqual(sorted(os.listdir(directory)),
                             sorted("inproc-cpu" + end for end in (".json", ".csv", "-lateness.svg", "-lateness.png",
                                                                   "-execution.svg", "-execution.png")))
            with open(os.path.join(directory, "inproc-cpu.json"), encoding="utf-8") as stream:
                summary = json.load(stream)
            self.assertEqual(len(summary["p99_9_ratios"]), 2)
            self.assertTrue(summary["limits"])
            with open(os.path.join(directory, "inproc-cpu.csv"), encoding="utf-8") as stream:
                rows = list(csv.reader(stream))
            self.assertEqual(rows[0], ["lateness_us", "cyclictest", "controller"])
            for side in (1, 2):
                self.assertEqual(sum(int(row[side]) for row in rows[1:]), summary[rows[0][side]]["count"])

    def test_wrong_use(self):
        for arguments, word in ((("--load", "heavy"), "heavy"), (("--seconds", "0"), "--seconds"),
                                (("--load", "can", "--bus", "inproc"), "--bus vcan"), (("--cpu", "999"), "--cpu 999")):
            result = tool(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
