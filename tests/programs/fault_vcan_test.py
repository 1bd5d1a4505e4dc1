#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""striker-sil faults on a real vcan0: run it where one exists (tools/with-vcan).
Usage: fault_vcan_test.py BIN_DIRECTORY"""

import json
import os
import signal
import subprocess
import sys
import unittest

import files_case

BIN = sys.argv.pop(1)

FOREIGN = """
[[case]]
name = "frames of other formats"
""" + "".join(f"""
[[case.fault]]
kind = "{kind}"
from_ms = 0
until_ms = 2000
""" for kind in ("remote_frames", "extended_frames", "fd_frames"))

FROZEN = """
[[case]]
name = "frozen wheel state"
[[case.fault]]
kind = "replay"
message = "WheelState"
from_ms = 300
until_ms = 1500
"""


class FaultVcan(files_case.FilesCase):
    def setUp(self):
        super().setUp()
        self.firmware = subprocess.Popen([os.path.join(BIN, "striker-firmware"), "--can", "vcan0", "--clock", "sync"],
                                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.firmware.stdout.readline()  # says when it listens
        self.addCleanup(self.firmware.communicate)
        self.addCleanup(self.firmware.send_signal, signal.SIGTERM)

    def row(self, plan, bus):
        files = [self.file("plan.toml", plan), self.file("report.json")]
        result = subprocess.run([os.path.join(BIN, "striker-sil"), "faults", "--plan", files[0], "--episodes", "1",
                                 "--bus", bus, "--json", files[1]], capture_output=True, text=True, timeout=280)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(files[1], encoding="utf-8") as stream:
            return json.load(stream)["rows"][0]

    def test_frames_of_other_formats_disturb_nothing(self):
        row = self.row(FOREIGN, "can:vcan0")
        self.assertEqual((row["detected_by"], row["outcome"], row["reward_kept_percent"]),
                         ("nothing needed", "rides through", 100.0))

    def test_a_fault_is_the_same_on_the_bus_as_in_process(self):
        self.assertEqual(self.row(FROZEN, "can:vcan0"), self.row(FROZEN, "inproc"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
