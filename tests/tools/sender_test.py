#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The recipe of firmware/can/README.md, and the sender that follows it: its check vector, and every frame that
tools/examples/camera-and-operator sends on a virtual bus of python3-can, decoded by the committed DBC, checked by another
E2E implementation, and as often as it says. Usage: sender_test.py SOURCE_DIRECTORY"""

import importlib.machinery
import importlib.util
import os
import re
import sys
import unittest

import can

ROOT = sys.argv.pop(1)
sys.path.insert(0, os.path.join(ROOT, "tests", "can"))

import operator_consent  # noqa: E402
import striker_dbc  # noqa: E402

PATH = os.path.join(ROOT, "tools", "examples", "camera-and-operator")
SENDER = importlib.util.module_from_spec(importlib.util.spec_from_loader(
    "sender", importlib.machinery.SourceFileLoader("sender", PATH)))
sys.dont_write_bytecode = True
SENDER.__spec__.loader.exec_module(SENDER)


def heard(seconds, base, says=()):
    """(messages by name, sender) of a run on a virtual bus on which a controller says these frames."""
    with can.Bus(interface="virtual", channel="striker") as ours, can.Bus(interface="virtual", channel="striker") as theirs:
        sender = SENDER.Sender(theirs, base)
        for name, data in says:
            ours.send(can.Message(arbitration_id=striker_dbc.identifier(name) + base, is_extended_id=False, data=data))
        SENDER.run(sender, seconds)
        found = {}
        while (message := ours.recv(timeout=0)) is not None:
            name = next(name for name in striker_dbc.messages() if striker_dbc.identifier(name) + base == message.arbitration_id)
            found.setdefault(name, []).append(bytes(message.data))
        return found, sender


class Recipe(unittest.TestCase):
    def test_the_check_vector_of_the_page(self):
        with open(os.path.join(ROOT, "firmware", "can", "README.md"), encoding="utf-8") as page:
            vector = re.search(r"list 7, counter 1: `([0-9A-F ]+)` becomes `([0-9A-F ]+)`", page.read())
        data, expected = (bytes.fromhex(group) for group in vector.groups())
        self.assertEqual(SENDER.protected(data, 7, 1), expected)
        self.assertEqual(expected[0], 0x13, "check_vector_crc of firmware/can/e2e.hpp")
        self.assertEqual(SENDER.crc8(b"123456789"), 0xDF, "AUTOSAR's check value")


class Frames(unittest.TestCase):
    def test_are_what_the_table_says(self):
        for base in (0, 768):
            found, _ = heard(1.0, base)
            self.assertEqual(set(found), {"VisionPose", "VisionBall"})
            self.assertTrue(15 <= len(found["VisionPose"]) <= 21, len(found["VisionPose"]))
            for name, payloads in found.items():
                for count, payload in enumerate(payloads):
                    self.assertEqual(len(payload), striker_dbc.length(name))
                    self.assertEqual(payload, operator_consent.protect(name, payload, count % 16))
                    self.assertEqual(striker_dbc.raw(name, "frame", payload), count % 16)
            self.assertEqual(striker_dbc.raw("VisionPose", "heading", found["VisionPose"][0]), 0)
            self.assertEqual(striker_dbc.raw("VisionBall", "y", found["VisionBall"][0]), 0)
            self.assertTrue(4000 < striker_dbc.raw("VisionBall", "x", found["VisionBall"][0]) <= 6000, "1.5 m in 1/4 mm")

    def test_it_asks_confirms_and_renews(self):
        status = bytes([0, striker_dbc.value("Status", "state", "standby") << 4] + [0] * 6)
        asked, _ = heard(0.5, 0, [("Status", status)])
        self.assertEqual({striker_dbc.named("ModeCommand", "mode", one) for one in asked["ModeCommand"]}, {"arm"})
        self.assertEqual(striker_dbc.raw("ModeCommand", "challenge", asked["ModeCommand"][0]), 0)
        challenge = bytes([0, 1 << 4]) + (0x12345678).to_bytes(4, "little")
        confirmed, _ = heard(0.1, 0, [("Challenge", challenge)])
        self.assertEqual(confirmed["ModeCommand"], [operator_consent.mode_command("arm", 0x12345678, 0)])
        active = bytes([0, striker_dbc.value("Status", "state", "active") << 4] + [0] * 6)
        renewed, sender = heard(0.5, 0, [("Status", active)])
        self.assertEqual(renewed["ModeCommand"], [operator_consent.mode_command("renew", 0, 0)])
        self.assertTrue(sender.was_armed)

    def test_the_camera_believes_the_wheels(self):
        sender = SENDER.Sender(None, 0)
        sender.wheels_at = SENDER.time.monotonic() - 0.05
        sender.follow_wheels(can.Message(data=SENDER.struct.pack("<BBhh", 0, 0, -140, 140)))
        self.assertAlmostEqual(sender.pose[2], 0.1, delta=0.02)  # 2 rad/s to the left for 50 ms


if __name__ == "__main__":
    unittest.main(verbosity=2)
