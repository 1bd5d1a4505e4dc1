#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The live view of a run on a real vcan0: run it where one exists (tools/with-vcan).
Usage: view_vcan_test.py BIN_DIRECTORY [ViewOnVcan.test_NAME...]"""

import os
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "can"))

import files_case  # noqa: E402
import striker_dbc  # noqa: E402
from vcan_bus import collect, listening, read_log  # noqa: E402
from view_client import Run, Viewer  # noqa: E402

BIN = sys.argv.pop(1)
SIL = os.path.join(BIN, "striker-sil")
EMERGENCY_STOP, FAULT_REPORT, SYNC = (striker_dbc.identifier(name) for name in ("EmergencyStop", "FaultReport", "Sync"))
STOPPED = 4  # striker-sil kick
ON_VCAN = ("--bus", "can:vcan0")


class ViewOnVcan(files_case.FilesCase):
    def firmware(self, *arguments):
        process = subprocess.Popen([os.path.join(BIN, "striker-firmware"), "--can", "vcan0", "--challenge-seed", "0", *arguments],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.terminate)
        process.stdout.readline()  # says when it listens
        return process

    def begin(self, *words):
        run = Run(SIL, self.directory.name, "kick", "--seed", "7", "--log", "bus.log", "--view", *words)
        self.addCleanup(run.close)
        viewer = Viewer(run)
        self.addCleanup(viewer.close)
        return run, viewer

    def test_a_viewer_changes_no_byte_of_a_real_bus(self):
        self.firmware("--clock", "sync")
        run, viewer = self.begin("--episodes", "1", "--view-speed", "max", *ON_VCAN)
        self.assertGreater(len(list(viewer.states())), 3)
        self.assertEqual(run.ended()[0], 0)
        subprocess.run([SIL, "kick", "--seed", "7", "--log", self.file("alone.log"), "--episodes", "1"], check=True,
                       capture_output=True)
        with open(self.file("bus.log"), "rb") as one, open(self.file("alone.log"), "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_what_is_pressed_reaches_the_firmware(self):
        process = self.firmware("--clock", "sync", "--sync-timeout", "60000")
        run, viewer = self.begin("--episodes", "20", *ON_VCAN)
        viewer.until(lambda state: state["deciding"])
        viewer.send(do="pause")
        paused = viewer.until(lambda state: state["paused"])
        with listening(SYNC) as bus:
            self.assertEqual(collect(bus, 0.3), [])
            viewer.send(do="step", ticks=3)
            viewer.until(lambda state: state["tick"] == paused["tick"] + 3)
            self.assertEqual(len(collect(bus, 0.3)), 3)
        viewer.send(do="fault", robot=0, kind="interface_down", ms=100)  # is of the controller's process
        viewer.until(lambda state: "cannot begin" in state["note"][1])
        with listening(EMERGENCY_STOP, FAULT_REPORT) as bus:
            viewer.send(do="stop")
            self.assertEqual(run.ended()[0], STOPPED, run.text())
            heard = [identifier for identifier, _ in collect(bus, 0.3)]
        self.assertEqual(heard.count(EMERGENCY_STOP), 1)
        self.assertIn(FAULT_REPORT, heard)
        process.terminate()
        self.assertIn("fault emergency_stop", process.communicate(timeout=20)[1])

    def test_on_the_wall_clock_time_cannot_be_stopped_but_a_robot_can(self):
        self.firmware("--clock", "realtime")
        run, viewer = self.begin("--episodes", "20", "--realtime", *ON_VCAN)
        before = viewer.until(lambda state: state["robots"][0].get("state") == "standby" or state["deciding"])
        for command in ({"do": "pause"}, {"do": "step"}, {"do": "speed", "x": "max"}):
            viewer.send(**command)
        refused = viewer.until(lambda state: state["note"][0] == 3)
        self.assertIn("the wall clock has the time of this run", refused["note"][1])
        self.assertFalse(viewer.until(lambda state: state["tick"] > before["tick"] + 200)["paused"])
        viewer.send(do="stop")
        self.assertEqual(run.ended()[0], STOPPED, run.text())
        stops = [frame for frame in read_log(self.file("bus.log")) if frame[1] == EMERGENCY_STOP]
        self.assertGreaterEqual(len(stops), 1)


if __name__ == "__main__":
    unittest.main()
