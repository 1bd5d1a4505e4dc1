#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A robot of one's own in the firmware's build (-DSTRIKER_ROBOT=FILE): its numbers reach the controller, and a file that
is no robot, or one that the policy does not fit, is refused with a reason. Usage: robot_build_test.py POLICY_HEADER"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

import image_test

POLICY = sys.argv.pop(1)
OWN = """body_mass_g = 2_500 # with the battery; [2026]
wheel_radius_um = 50_000\r
wheel_mass_g = 120

axle_length_um=200_000
torque_limit_mNm = 600
top_rim_speed_mm_s = 2_600
camera_latency_ms = 35
camera_rate_Hz = 60
"""
# That all of them arrived, and what was left out is as usual.
HOLDS = """#include "firmware/loop/built_in_node.hpp"
static_assert(striker::loop::built_in_description ==
              striker::core::RobotDescription{.body_mass_g = 2500, .wheel_mass_g = 120, .wheel_radius_um = 50'000,
                                              .axle_length_um = 200'000, .torque_limit_mNm = 600,
                                              .top_rim_speed_mm_s = 2600, .camera_latency_ms = 35,
                                              .camera_rate_Hz = 60});
static_assert(striker::loop::built_in_robot.torque_limit_mNm == 600);
static_assert(striker::loop::built_in_robot.picture_period_us == 16'667);
"""

# Drives of another make, and Striker's identifiers out of their way.
ODRIVES = OWN + """drives = "odrive"  # of their own make
identifier_base = 768
drive_left_node = 0
drive_right_node = 1
drive_right_reversed = 1
"""
DRIVES_HOLD = """#include "firmware/loop/built_in_node.hpp"
using namespace striker;
static_assert(loop::built_in_wiring == can::DriveWiring{.kind = can::DriveKind::odrive, .identifier_base = 768, .left_node = 0,
                                                        .right_node = 1, .right_reversed = 1, .wheel_radius_um = 50'000});
static_assert(std::is_same_v<loop::BuiltInNode::Drives, can::OdriveDrives<loop::built_in_wiring>>);
static_assert(can::layout<can::EmergencyStop>.info.id == 0x310 && can::layout<can::Decision>.info.id == 0x410);
static_assert(can::layout<can::Heartbeat>.info.id == 0x700 && can::layout<can::EndOfTick>.info.id == 0x7F0);
"""


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


class RobotBuild(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.folder = directory.name

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w", encoding="utf-8", newline="") as file:
                file.write(text)
        return path

    def header_of(self, robot):
        """The configuration's part: what cmake says, with one space between words, or nothing."""
        script = self.path("write.cmake", "cmake_minimum_required(VERSION 3.25)\n"
                           f"include({image_test.ROOT}/firmware/robots/robot_header.cmake)\n"
                           f"striker_write_robot({self.path('own.toml', robot)} {self.path('own.hpp')})\n"
                           f"file(WRITE {self.path('base')} ${{STRIKER_CAN_BASE}})\n")
        done = run("cmake", "-P", script)
        return " ".join(done.stderr.split()) if done.returncode != 0 else ""

    def compiled(self, robot, source='#include "firmware/loop/built_in_node.hpp"\n', base=None):
        """What the compiler says of a controller for that robot, or nothing. `base`: another than the file's."""
        self.assertEqual(self.header_of(robot), "")
        with open(self.path("base"), encoding="ascii") as file:
            base = base or file.read()
        done = run("g++", "-std=c++20", "-fsyntax-only", f"-DSTRIKER_CAN_BASE={base}", f"-I{image_test.ROOT}", f'-DSTRIKER_POLICY_HEADER="{POLICY}"',
                   "-DSTRIKER_POLICY_NAME=kick", f'-DSTRIKER_ROBOT_HEADER="{self.path("own.hpp")}"', self.path("node.cpp", source))
        return done.stderr if done.returncode != 0 else ""

    def test_its_numbers_reach_the_controller(self):
        self.assertEqual(self.compiled(OWN, HOLDS), "")

    def test_what_is_no_description_is_refused_with_its_place(self):
        for line, told in (("body_mass_g = 2.5", "line 10: 'body_mass_g = 2.5' is no key with a whole number"),
                           ("body_mass_g = 0x7D0", "line 10: "), ("body_mass_g = 07", "line 10: "), ("[robot]", "line 10: "),
                           ("axle_length_um = 1; x = 2", "line 10: "), ("camera_latency_ms = -1", "line 10: "),
                           ("camera_latency_ms = 1", "line 10: camera_latency_ms stands twice"),
                           ("drives = odrive", "line 10: 'drives = odrive' is no name of drives"),
                           ("drives = 'odrive'", "line 10: ")):
            self.assertIn(told, self.header_of(OWN + line + "\n"), line)

    def test_what_no_robot_can_be_does_not_compile(self):
        for changes, told in (({"torque_limit_mNm = 600": ""}, "STRIKER ROBOT: a number is missing or out of range"),
                              ({"2_500": "100"}, "STRIKER ROBOT: a number is missing or out of range"),
                              ({"2_500": "99_999_999_999"}, "narrowing conversion"),
                              ({"camera_rate_Hz = 60": "camera_rate_Hz = 9"}, "STRIKER ROBOT: a number is missing or out of range"),
                              ({"camera_latency_ms": "colour"}, "no member named .colour"),
                              ({"2_500": "100_000", "50_000": "200_000"}, "STRIKER ROBOT: its wheel loops"),
                              ({"2_600": "2_500"}, "STRIKER POLICY: an action goes beyond the robot's top speed")):
            robot = OWN
            for text, other in changes.items():
                self.assertIn(text, robot)
                robot = robot.replace(text, other)
            said = self.compiled(robot)
            self.assertTrue(re.search(told, said), f"{changes}: {said}")

    def test_drives_of_others_are_a_description_away(self):
        self.assertEqual(self.compiled(ODRIVES, DRIVES_HOLD), "")
        cia402 = ODRIVES.replace('"odrive"', '"cia402"').replace("left_node = 0", "left_node = 2")
        self.assertEqual(self.compiled(cia402), "")

    # Which ones do: tests/drives/identifiers_test.cpp.
    def test_identifiers_that_collide_do_not_compile(self):
        collides = "STRIKER DRIVES: a node's identifier is one of Striker's own"
        own_place = ODRIVES.replace("identifier_base = 768\n", "").replace("left_node = 0", "left_node = 20")
        self.assertIn(collides, self.compiled(own_place))
        self.assertEqual(self.compiled(own_place.replace("right_node = 1", "right_node = 21")), "")
        canopen = own_place.replace('"odrive"', '"cia402"').replace("right_node = 1", "right_node = 21")
        self.assertIn(collides, self.compiled(canopen))
        self.assertIn(collides, self.compiled(ODRIVES.replace("right_node = 1", "right_node = 24")))

    def test_drives_that_cannot_be_do_not_compile(self):
        for changes, told in (({'"odrive"': '"moteus"'}, "moteus"),
                              ({"right_node = 1": "right_node = 0"}, "STRIKER DRIVES: a number of the drives is out of range"),
                              ({"right_node = 1": "right_node = 63"}, "STRIKER DRIVES: an ODrive's node is 0 to 62"),
                              ({'"odrive"': '"cia402"'}, "STRIKER DRIVES: a CANopen node is 1 to 127"),
                              ({"_base = 768": "_base = 1_500"}, "STRIKER CAN: identifier_base must be"),
                              ({"_base = 768": "_base = 770"}, "STRIKER CAN: identifier_base must be"),
                              ({"drive_left_node": "drive_middle_node"}, "no member named .middle_node")):
            robot = ODRIVES
            for text, other in changes.items():
                self.assertIn(text, robot)
                robot = robot.replace(text, other)
            said = self.compiled(robot)
            self.assertTrue(re.search(told, said), f"{changes}: {said}")
        self.assertIn("STRIKER DRIVES: identifier_base is not the one", self.compiled(ODRIVES, base=256))


if __name__ == "__main__":
    unittest.main(verbosity=2)
