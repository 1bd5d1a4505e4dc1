#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The real firmware process in its real-time loop: what it may not do after initialisation.
Usage: hard_real_time_test.py BIN_DIRECTORY NO_ALLOCATION_LIBRARY

A period of 100 us instead of 1 ms makes 100,000 ticks take 10 s; nothing here passes or fails by time."""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

LIBRARY = sys.argv.pop()
BIN = sys.argv.pop()

TICKS = 100_000
# The list of firmware/ports/linux/run_real_time.hpp for a bus without a socket; where the machine has no vDSO clock,
# reading it is a system call too.
LISTED = {"clock_nanosleep", "clock_gettime"}


def firmware(ticks, *arguments):
    return [os.path.join(BIN, "striker-firmware"), "--in-process", "--clock", "realtime", "--period-us", "100",
            "--ticks", str(ticks), "--overrun-limit", "1000", *arguments]


def run(command, **environment):
    return subprocess.run(command, capture_output=True, text=True, env={**os.environ, **environment})


class HardRealTime(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)

    def file(self, name):
        return os.path.join(self.directory.name, name)

    def test_no_page_fault_and_no_allocation_in_100000_ticks(self):
        result = run(firmware(TICKS, "--json", self.file("timing.json")), LD_PRELOAD=LIBRARY, STRIKER_TICKS=str(TICKS))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no_allocation: none", result.stderr)
        with open(self.file("timing.json"), encoding="utf-8") as stream:
            timing = json.load(stream)
        self.assertEqual(timing["ticks"], TICKS)
        self.assertGreater(timing["received_frames"], TICKS / 2)
        self.assertIn("locked memory", timing["settings"], "run as root or grant CAP_IPC_LOCK")
        self.assertEqual((timing["minor_faults"], timing["major_faults"]), (0, 0))

    def test_an_allocation_would_be_noticed(self):
        result = run(firmware(200), LD_PRELOAD=LIBRARY, STRIKER_TICKS="200", STRIKER_PROVOKE="1")
        self.assertEqual(result.returncode, -6)
        self.assertIn("no_allocation: malloc after initialisation", result.stderr)

    def test_the_system_calls_of_100000_ticks(self):
        trace = self.file("trace")
        result = run(["strace", "-f", "-qq", "-o", trace, *firmware(TICKS)])
        self.assertEqual(result.returncode, 0, result.stderr)
        calls = []
        with open(trace, encoding="utf-8", errors="replace") as stream:
            main = None
            for line in stream:
                call = re.match(r"(\d+) +(\w+)\(", line)
                main = main or line.split()[0]
                if call and call[1] == main:
                    calls.append((call[2], line))
        deadlines = [i for i, (name, line) in enumerate(calls)
                     if name == "clock_nanosleep" and "TIMER_ABSTIME" in line]
        self.assertEqual(len(deadlines), TICKS)
        inside = [name for name, _ in calls[deadlines[0]:deadlines[-1]]]
        self.assertEqual(set(inside) - LISTED, set())
        self.assertGreaterEqual(inside.count("clock_nanosleep"), TICKS - 1)

    def test_what_was_asked_of_the_kernel_is_printed(self):
        result = run(firmware(20, "--scheduler", "other", "--cpu", "0", "--frames-per-tick", "9"))
        for line in ("processor 0", "SCHED_OTHER", "a tick every 100 us, at most 9 frames", "fault beyond 1000 missed",
                     "stopped after 20 ticks"):
            self.assertIn(line, result.stdout)
        refused = run(firmware(20, "--cpu", "1023"))
        self.assertIn("processor 1023 refused", refused.stdout)
        self.assertIn("timing is best effort", refused.stderr)

    def test_wrong_use(self):
        for arguments, word in ((["--in-process"], "--clock realtime"), ([], "--can"),
                                (["--in-process", "--can", "vcan0"], "--can"),
                                (["--in-process", "--clock", "realtime", "--period-us", "1"], "--period-us"),
                                (["--in-process", "--clock", "realtime", "--ticks", "5", "--json", "/none/a.json"],
                                 "/none/a.json")):
            result = run([os.path.join(BIN, "striker-firmware"), *arguments])
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
