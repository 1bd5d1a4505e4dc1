#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A match over CAN: ten striker-firmware on vcan0 to vcan9, and the same frames as in one process.
Usage: match_vcan_test.py BIN [unittest's arguments]"""

import os
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import files_case  # noqa: E402

BIN = sys.argv.pop(1)
ROLES = ("goalkeeper", "defender", "defender", "forward", "forward")


def ip_link(*arguments):
    return subprocess.run(["ip", "link", *arguments], capture_output=True, check=False)


class MatchOnVcan(files_case.FilesCase):
    def setUp(self):
        super().setUp()
        for robot in range(10):
            if ip_link("show", "dev", f"vcan{robot}").returncode != 0:
                ip_link("add", "dev", f"vcan{robot}", "type", "vcan")
                self.addCleanup(ip_link, "delete", f"vcan{robot}")
            ip_link("set", "up", f"vcan{robot}")
        for robot in range(10):
            firmware = subprocess.Popen([os.path.join(BIN, "striker-firmware"), "--can", f"vcan{robot}", "--clock", "sync",
                                         "--role", ROLES[robot % 5], "--challenge-seed", "0"], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
            self.addCleanup(firmware.wait)
            self.addCleanup(firmware.terminate)

    def match(self, out, *arguments):
        result = subprocess.run([os.path.join(BIN, "striker-sil"), "match", "--red", "rules", "--blue", "striker", "--first-s", "3",
                                 "-o", self.file(out), *arguments], capture_output=True, text=True, check=False, timeout=250)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_ten_buses_carry_the_frames_of_one_process(self):
        self.match("vcan", "--bus", "can:vcan")
        self.match("inproc")
        for robot in range(10):
            logs = []
            for out in ("vcan", "inproc"):
                with open(os.path.join(self.file(out), "bus", f"vcan{robot}.log.gz"), "rb") as stream:
                    logs.append(stream.read())
            self.assertEqual(logs[0], logs[1], f"vcan{robot}")


if __name__ == "__main__":
    unittest.main()
