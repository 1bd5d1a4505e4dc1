#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tools/examples/camera-and-operator on a real vcan0, with striker-firmware on its own clock, and drives that this test plays:
it arms, decides, and disarms. Usage: sender_vcan_test.py BIN_DIRECTORY [Sender.test_NAME...]"""

import os
import re
import signal
import struct
import subprocess
import sys
import threading
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests", "can"))

import operator_consent  # noqa: E402
import striker_dbc  # noqa: E402
from vcan_bus import listening, send  # noqa: E402

BIN = sys.argv.pop(1)
WHEEL_STATE, WHEEL_COMMAND = striker_dbc.identifier("WheelState"), striker_dbc.identifier("WheelCommand")


class Drives(threading.Thread):
    """Wheels that take up their set-points in some 20 ms, and tell so every 5 ms: often enough, and a busy host can do it."""

    PERIOD_S = 0.005

    def __init__(self):
        super().__init__(daemon=True)
        self.ended = threading.Event()

    def run(self):
        speeds, wanted, counter = [0.0, 0.0], [0, 0], 0
        with listening(WHEEL_COMMAND) as bus:
            bus.setblocking(False)
            while not self.ended.wait(self.PERIOD_S):
                payload = None
                try:
                    while True:
                        payload = bus.recv(16)[8:]
                except BlockingIOError:
                    pass
                if payload:
                    wanted = [2 * striker_dbc.raw("WheelCommand", f"{side}_set_point", payload) for side in ("left", "right")]
                speeds = [speed + (goal - speed) * 0.25 for speed, goal in zip(speeds, wanted)]
                payload = struct.pack("<BBhh", 0, 0, *map(round, speeds))
                send(bus, WHEEL_STATE, operator_consent.protect("WheelState", payload, counter))
                counter = (counter + 1) % 16


class Sender(unittest.TestCase):
    def test_it_arms_and_the_controller_decides(self):
        firmware = subprocess.Popen([os.path.join(BIN, "striker-firmware"), "--can", "vcan0", "--clock", "realtime", "--scheduler",
                                     "other", "--overrun-limit", "1000"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(firmware.communicate, timeout=20)
        self.addCleanup(firmware.send_signal, signal.SIGTERM)
        firmware.stdout.readline()  # says when it listens
        drives = Drives()
        drives.start()
        self.addCleanup(drives.join)
        self.addCleanup(drives.ended.set)
        told = ""
        for _ in range(6):  # on a busy host these drives are late, which is a fault
            sender = subprocess.run([os.path.join(ROOT, "tools", "examples", "camera-and-operator"), "--seconds", "8"],
                                    capture_output=True, text=True, timeout=100, check=False)
            told += sender.stdout + sender.stderr
            if len(re.findall(r"decision \d+: action \d", told)) >= 3:
                break
        self.assertEqual(sender.returncode, 0, told)
        self.assertRegex(told, "state active, fault 0")
        self.assertRegex(told, r"decision 0: action \d", told)
        status = subprocess.run([os.path.join(BIN, "striker-command"), "--can", "vcan0", "--timeout", "10000", "status"],
                                capture_output=True, text=True, timeout=60, check=False)
        self.assertNotIn("active", status.stdout, "it disarmed at the end")


if __name__ == "__main__":
    unittest.main(verbosity=2)
