#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The logs of kicks with ODrives and with drives of CiA 402, decoded twice: by canmatrix with the committed DBC, and by a
decoder that is written here from the manuals (CANSimple's structs; CANopen's PDO mapping out of the committed EDS). Both
find the same in every frame, and what they find is what such drives may be told: nothing moves, and nothing is enabled,
unless Striker's Status says that it is active. Usage: decode_test.py DRIVE_KICKS SOURCE_DIRECTORY"""

import configparser
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest

import canmatrix.formats

KICKS, ROOT = sys.argv[1:3]
del sys.argv[1:3]
sys.path.insert(0, os.path.join(ROOT, "tests", "can"))

import striker_dbc  # noqa: E402

BASE = 768  # identifier_base of both descriptions
DRIVES = os.path.join(ROOT, "firmware", "can", "drives")
CANSIMPLE = {0x01: ("<IBBB", ("Axis_Error", "Axis_State", "Procedure_Result", "Trajectory_Done_Flag")),
             0x03: ("<II", ("Active_Errors", "Disarm_Reason")), 0x07: ("<I", ("Axis_Requested_State",)),
             0x09: ("<ff", ("Pos_Estimate", "Vel_Estimate")), 0x0B: ("<II", ("Control_Mode", "Input_Mode")),
             0x0E: ("<f", ("Input_Torque",)), 0x18: ("<B", ("Identify",))}
FORMATS = {0x02: "b", 0x03: "h", 0x04: "i", 0x05: "B", 0x06: "H", 0x07: "I"}  # CiA 301: of a data type's number


def moved(identifier):
    return identifier + BASE if identifier < 0x700 else identifier


def recorded(kind):
    """[(milliseconds, identifier, payload)] of two kicks."""
    with tempfile.TemporaryDirectory() as folder:
        log = os.path.join(folder, "bus.log")
        subprocess.run([KICKS, kind, "2", log], check=True, capture_output=True)
        with open(log, encoding="ascii") as lines:
            parts = [re.fullmatch(r"\((\d+)\.(\d{6})\) \S+ ([0-9A-F]{3})#([0-9A-F]*)", line.strip()) for line in lines]
    return [(int(part[1]) * 1000 + int(part[2]) // 1000, int(part[3], 16), bytes.fromhex(part[4])) for part in parts]


def cansimple(identifier, payload):
    form, names = CANSIMPLE[identifier & 0x1F]
    return dict(zip(names, struct.unpack(form, payload[:struct.calcsize(form)])))


class Canopen:
    """Nodes 1 and 2, as their data sheet has them."""

    def __init__(self):
        self.sheet = configparser.ConfigParser()
        self.sheet.read(os.path.join(DRIVES, "cia402.eds"))
        self.pdos = {}
        for node in (1, 2):
            for communication, mapping in (("1400", "1600"), ("1800", "1A00")):
                self.pdos[self.number(communication + "sub1", node)] = self.mapped(mapping)

    def number(self, section, node=0):
        return sum(node if part == "$NODEID" else int(part, 0) for part in self.sheet[section]["DefaultValue"].split("+"))

    def mapped(self, mapping):
        entries = []
        for sub in range(1, 9):
            if f"{mapping}sub{sub}" in self.sheet:
                entry = self.number(f"{mapping}sub{sub}")
                described = self.sheet[f"{entry >> 16:04X}"]
                form = FORMATS[int(described["DataType"], 16)]
                assert struct.calcsize(form) * 8 == entry & 0xFF, described["ParameterName"]
                entries.append((described["ParameterName"].replace(" ", "_").title(), form))
        return entries

    def decode(self, identifier, payload):
        if identifier in self.pdos:
            form = "<" + "".join(form for _, form in self.pdos[identifier])
            return dict(zip((name for name, _ in self.pdos[identifier]), struct.unpack(form, payload)))
        return {0x000: lambda: {"Command": payload[0], "Node": payload[1]}, 0x080: dict,
                0x081: lambda: {"Error_Code": payload[0] | payload[1] << 8, "Error_Register": payload[2]},
                0x701: lambda: {"NMT_State": payload[0]}}[{0x082: 0x081, 0x702: 0x701}.get(identifier, identifier)]()


class Decoded(unittest.TestCase):
    def frames_of(self, kind, decode):
        """[(ms, identifier, signals, active)]: both decoders agree, and every frame is someone's."""
        matrix = canmatrix.formats.loadp_flat(os.path.join(DRIVES, f"{kind}.dbc"))
        known = {frame.arbitration_id.id: frame for frame in matrix.frames}
        own = {moved(striker_dbc.identifier(name)): striker_dbc.length(name) for name in striker_dbc.messages()}
        self.assertFalse(known.keys() & own.keys())
        status = moved(striker_dbc.identifier("Status"))
        active, found = False, []
        for ms, identifier, payload in recorded(kind):
            if identifier in own:
                self.assertEqual(len(payload), own[identifier])
                if identifier == status:
                    active = striker_dbc.named("Status", "state", payload) == "active"
                continue
            frame = known[identifier]
            self.assertEqual(len(payload), frame.size, frame.name)
            ours = decode(identifier, payload)
            theirs = frame.decode(payload) if frame.signals else {}
            self.assertEqual(set(ours), set(theirs), frame.name)
            for name, value in ours.items():
                self.assertEqual(value, theirs[name].raw_value, f"{frame.name}.{name}")
            found.append((ms, identifier, ours, active))
        self.assertGreater(len(found), 10000)
        return found

    def test_odrive(self):
        frames = self.frames_of("odrive", cansimple)
        moved_frames = 0
        for _, identifier, signals, active in frames:
            torque = signals.get("Input_Torque", 0.0)
            self.assertTrue(math.isfinite(torque) and abs(torque) < 0.400001)
            self.assertTrue(active or torque == 0.0)
            self.assertTrue(active or signals.get("Axis_Requested_State", 1) == 1, f"{identifier:03X}")
            moved_frames += torque != 0.0
        self.assertGreater(moved_frames, 3000)
        for node in (0, 1):
            heartbeats = [ms for ms, identifier, _, _ in frames if identifier == node << 5 | 0x01]
            self.assertEqual({b - a for a, b in zip(heartbeats, heartbeats[1:])}, {10})
            states = {signals["Axis_State"] for _, identifier, signals, _ in frames if identifier == node << 5 | 0x01}
            self.assertEqual(states, {1, 8})

    def test_cia402(self):
        canopen = Canopen()
        frames = self.frames_of("cia402", canopen.decode)
        moved_frames = 0
        for _, identifier, signals, active in frames:
            if identifier in (0x201, 0x202):
                torque, word = signals["Target_Torque"], signals["Control_Word"]
                self.assertTrue(active or (torque == 0 and not word & 8), f"{identifier:03X}")
                self.assertEqual(signals["Mode_Of_Operation"], 10)
                self.assertLessEqual(abs(torque), 1000)
                moved_frames += torque != 0
        self.assertGreater(moved_frames, 3000)
        self.assertEqual({(s["Command"], s["Node"]) for _, i, s, _ in frames if i == 0x000}, {(1, 1), (1, 2)})
        self.assertEqual({s["NMT_State"] for _, i, s, _ in frames if i == 0x702}, {5, 127})


if __name__ == "__main__":
    unittest.main(verbosity=2)
