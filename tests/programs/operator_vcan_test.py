#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""striker-command on a real vcan0: run it where one exists (tools/with-vcan).
Usage: operator_vcan_test.py BIN_DIRECTORY [Operator.test_NAME...]"""

import os
import signal
import subprocess
import sys
import threading
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "can"))

import operator_consent  # noqa: E402
import striker_dbc  # noqa: E402
from vcan_bus import listening, send  # noqa: E402

BIN = sys.argv.pop(1)

EMERGENCY_STOP = striker_dbc.identifier("EmergencyStop")
PATIENT_MS = "10000"  # a busy host makes the controller slow


def command(timeout_ms, name):
    return subprocess.run([os.path.join(BIN, "striker-command"), "--can", "vcan0", "--timeout", timeout_ms, name],
                          capture_output=True, text=True, timeout=120, check=False)


class Operator(unittest.TestCase):
    def start_firmware(self, *arguments):
        process = subprocess.Popen([os.path.join(BIN, "striker-firmware"), "--can", "vcan0", "--clock", "realtime", "--scheduler",
                                    "other", "--overrun-limit", "1000", *arguments], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate, timeout=20)
        self.addCleanup(process.send_signal, signal.SIGTERM)
        process.stdout.readline()  # says when it listens
        return process

    def press_stop(self):
        estop = command(PATIENT_MS, "estop")
        self.assertEqual(estop.returncode, 0, estop.stderr)
        self.assertIn("fault emergency_stop", estop.stdout)

    def test_a_silent_bus_is_told(self):
        unanswered = command("200", "status")
        self.assertEqual(unanswered.returncode, 2)
        self.assertIn("is striker-firmware running", unanswered.stderr)

    def test_what_hinders_an_arm_is_told(self):
        self.start_firmware()
        self.assertEqual(command(PATIENT_MS, "status").returncode, 0)
        arm = command("2000", "arm")
        self.assertEqual(arm.returncode, 1, arm.stderr)
        self.assertIn("vision not ready", arm.stderr)

    def test_a_stop_is_cleared_once_it_no_longer_holds(self):
        self.start_firmware()
        self.press_stop()
        time.sleep(0.5)
        clear = command(PATIENT_MS, "clear")
        self.assertEqual(clear.returncode, 0, clear.stderr)
        self.assertIn("state standby, fault none", clear.stdout)

    def test_wrong_frames_right_behind_a_stop_do_not_hide_it(self):
        process = self.start_firmware()
        press = operator_consent.protect("EmergencyStop", bytes(2), 0)
        with listening() as bus:
            process.send_signal(signal.SIGSTOP)  # so that one tick finds them all
            for frame in (press, bytes(len(press)), b"", press[:-1] + bytes([press[-1] ^ 1])):
                send(bus, EMERGENCY_STOP, frame)
            process.send_signal(signal.SIGCONT)
        status = command(PATIENT_MS, "status")
        self.assertIn("fault emergency_stop", status.stdout)
        self.assertIn("1 wrong length, 2 wrong CRC", status.stdout)

    # The tool believes statuses after 16 of them, 160 ms: a controller that is slow holds a stop for longer than this
    # takes, so that the clear is asked for, and refused, within the hold.
    def test_a_clear_that_comes_too_early_says_how_long_the_stop_still_holds(self):
        self.start_firmware("--period-us", "6000")
        told = ""
        with listening() as bus:
            for turn in range(40):
                send(bus, EMERGENCY_STOP, operator_consent.protect("EmergencyStop", bytes(2), turn % 16))
                early = command(str(1000 + turn % 8 * 40), "clear")
                if early.returncode == 1:
                    told = early.stderr
                    break
        self.assertRegex(told, r"a stop holds for 200 ms after its last frame, this one for another \d+ ms at most: clear again")

    def test_a_button_that_repeats_is_told_and_no_clear_passes_it(self):
        self.start_firmware()
        self.press_stop()
        ended = threading.Event()

        def press():
            with listening() as bus:
                counter = 0
                while not ended.wait(0.02):
                    send(bus, EMERGENCY_STOP, operator_consent.protect("EmergencyStop", bytes(2), counter))
                    counter = (counter + 1) % 16

        button = threading.Thread(target=press)
        button.start()
        try:
            clear = command("2000", "clear")
        finally:
            ended.set()
            button.join()
        self.assertEqual(clear.returncode, 1, clear.stdout + clear.stderr)
        self.assertRegex(clear.stderr, r"stop frames still come, the last one \d+ ms ago: .* clear again")


if __name__ == "__main__":
    unittest.main(verbosity=2)
