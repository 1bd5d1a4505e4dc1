#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The programs on a real vcan0: run it where one exists (tools/with-vcan).
Usage: vcan_test.py BIN_DIRECTORY [Vcan.test_NAME...]"""

import os
import re
import signal
import subprocess
import sys
import threading
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "can"))

import files_case  # noqa: E402
import striker_dbc  # noqa: E402
from vcan_bus import collect, listening, read_log, send, wait_until_still  # noqa: E402

BIN = sys.argv.pop(1)

FAULT_REPORT, MODE_COMMAND, WHEEL_COMMAND, WHEEL_STATE, STATUS, SYNC = (
    striker_dbc.identifier(name) for name in ("FaultReport", "ModeCommand", "WheelCommand", "WheelState", "Status", "Sync"))
STANDBY, ACTIVE = (striker_dbc.value("Status", "state", name) for name in ("standby", "active"))
SYNC_LOST = striker_dbc.value("FaultReport", "code", "sync_lost")
NOT_DRIVEN = 3  # striker-sil kick
ERROR_FLAG, ERROR_BUS_OFF = 0x20000000, 0x40  # linux/can.h, linux/can/error.h


def program(name, *arguments, **options):
    return subprocess.Popen([os.path.join(BIN, name), *arguments], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, **options)


def run(name, *arguments, timeout=120):
    return subprocess.run([os.path.join(BIN, name), *arguments], capture_output=True, text=True, timeout=timeout)


def firmware(clock="sync", *arguments):
    process = program("striker-firmware", "--can", "vcan0", "--clock", clock, "--challenge-seed", "0", *arguments)
    process.stdout.readline()  # says when it listens
    return process


def stop(process):
    if process.poll() is None:
        process.send_signal(signal.SIGTERM)
    return process.communicate(timeout=20)


def moves(payload):
    """Does a wheel command carry torque or a set-point?"""
    return any(payload[2:])


class Vcan(files_case.FilesCase):
    maxDiff = 2000

    def tearDown(self):
        """Whatever was recorded arms no controller whose challenges are others."""
        for name in os.listdir(self.directory.name):
            with open(self.file(name), encoding="utf-8", errors="replace") as stream:
                is_of_a_lockstep_run = name.endswith(".log") and f" {SYNC:03X}#" in stream.read()
            if is_of_a_lockstep_run:
                replayed = run("striker-firmware", "--replay", self.file(name), "--challenge-seed", "99")
                self.assertIn(replayed.returncode, (0, 1), replayed.stderr)
                self.assertIn("torque in 0 ticks", replayed.stdout)

    def kick(self, log, *arguments):
        result = run("striker-sil", "kick", "--episodes", "2", "--seed", "7", "--log", self.file(log), *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.file(log), "rb") as stream:
            return stream.read()

    def test_lockstep_gives_the_same_bytes_as_in_process(self):
        for plant in ("drive", "servo"):
            in_process = self.kick("a.log", "--bus", "inproc", "--plant", plant)
            self.assertEqual(in_process, self.kick("b.log", "--bus", "inproc", "--plant", plant))
            process = firmware()
            try:
                self.assertEqual(in_process, self.kick("c.log", "--bus", "can:vcan0", "--plant", plant))
                self.assertEqual(in_process, self.kick("d.log", "--bus", "can:vcan0", "--plant", plant))
            finally:
                stop(process)

    def test_the_bus_in_time_gives_the_same_bytes_and_stamps_too(self):
        in_process = self.kick("a.log", "--bitrate", "500000")
        self.assertNotEqual(in_process, self.kick("b.log"))
        process = firmware()
        try:
            self.assertEqual(in_process, self.kick("c.log", "--bitrate", "500000", "--bus", "can:vcan0"))
        finally:
            stop(process)

    def test_a_paused_firmware_changes_no_byte(self):
        in_process = self.kick("a.log", "--bus", "inproc")
        process = firmware()
        simulator = program("striker-sil", "kick", "--episodes", "2", "--seed", "7", "--bus", "can:vcan0", "--log",
                            self.file("b.log"), "--answer-timeout", "30000")
        pauses = 0
        while simulator.poll() is None:
            process.send_signal(signal.SIGSTOP)
            time.sleep(0.1)
            process.send_signal(signal.SIGCONT)
            time.sleep(0.037)
            pauses += 1
        stop(process)
        self.assertEqual(simulator.wait(), 0, simulator.communicate()[1])
        simulator.communicate()
        self.assertGreater(pauses, 5)
        with open(self.file("b.log"), "rb") as stream:
            self.assertEqual(in_process, stream.read())

    def test_a_killed_firmware_is_told_and_survived_and_a_new_one_waits_for_its_arm(self):
        first = firmware()
        simulator = program("striker-sil", "kick", "--episodes", "12", "--bus", "can:vcan0", "--log",
                            self.file("a.log"), "--answer-timeout", "300")
        time.sleep(2)
        first.kill()
        first.communicate()
        time.sleep(1)
        second = firmware()
        _, told = simulator.communicate(timeout=120)
        stop(second)
        self.assertEqual(simulator.returncode, NOT_DRIVEN, told)
        self.assertRegex(told, r"[12] of 12 episodes were played without a controller that drove all along")
        self.assertIn("running on unanswered", told)
        self.assertIn("answers again", told)
        self.check_silence(read_log(self.file("a.log")))

    def check_silence(self, frames):
        commands = [stamp for stamp, identifier, _ in frames if identifier == WHEEL_COMMAND]
        gaps = [(before, after) for before, after in zip(commands, commands[1:]) if after > before + 1]
        self.assertEqual(len(gaps), 1)
        last, back = gaps[0]
        self.assertGreater(back - last, 20)
        for stamp, identifier, payload in frames:
            if identifier == WHEEL_STATE and last + 11 <= stamp <= back:
                self.assertEqual(payload[1] >> 4 & 1, 1, f"torque not cut at {stamp} ms, last command {last} ms")
        arms = [s for s, identifier, payload in frames if identifier == MODE_COMMAND and payload[1] >> 4 == 1 and s > back]
        until = min(arms, default=frames[-1][0])
        for stamp, identifier, payload in frames:
            if identifier == WHEEL_COMMAND and back <= stamp < until:
                self.assertFalse(moves(payload), f"moved at {stamp} ms before it was armed")

    def test_a_killed_simulator_becomes_a_latched_fault_and_torque_zero(self):
        process = firmware("sync", "--sync-timeout", "500")
        simulator = program("striker-sil", "kick", "--episodes", "50", "--bus", "can:vcan0")
        time.sleep(3)
        with listening() as bus:
            simulator.kill()
            simulator.communicate()
            frames = collect(bus, 2.0)
        _, told = stop(process)
        self.assertIn("fault sync_lost", told)
        reports = [payload for identifier, payload in frames if identifier == FAULT_REPORT]
        self.assertEqual(reports[-1][2], SYNC_LOST)
        commands = [payload for identifier, payload in frames if identifier == WHEEL_COMMAND]
        self.assertFalse(moves(commands[-1]))

    def test_candump_shows_the_bus(self):
        # Its fault at a lost SYNC would be more frames, as long as candump still writes.
        process = firmware("sync", "--sync-timeout", "600000")
        with open(self.file("candump.log"), "wb") as output:
            # One processor serves all: candump needs room for what it cannot read in time.
            candump = subprocess.Popen(["candump", "-L", "-r", "33554432", "vcan0"], stdout=output)
            time.sleep(0.3)
            self.kick("a.log", "--bus", "can:vcan0")
            wait_until_still(self.file("candump.log"))
            candump.terminate()
            candump.wait()
        stop(process)
        with open(self.file("candump.log"), encoding="ascii") as log:
            lines = log.read().splitlines()
        seen = {line.split()[2][:3] for line in lines}
        absent = {"EmergencyStop", "FaultReport", "WheelOrder", "MotionOrder"}  # a kick has no team
        self.assertLessEqual({f"{striker_dbc.identifier(name):03X}" for name in set(striker_dbc.messages()) - absent}, seen)
        with open(self.file("a.log"), encoding="ascii") as log:
            logged = [line.split()[2] for line in log]
        shown = [line.split()[2] for line in lines]
        self.assertEqual(shown[-len(logged):], logged)

    def test_bad_frames_are_ignored_and_counted_on_the_real_bus(self):
        process = firmware("realtime")
        with listening() as bus:
            for name in ("EmergencyStop", "ModeCommand", "WheelState", "VisionPose", "VisionBall"):
                send(bus, striker_dbc.identifier(name), bytes(striker_dbc.length(name)))
                send(bus, striker_dbc.identifier(name), b"\x01")
            time.sleep(1)
        status = run("striker-command", "--can", "vcan0", "status")
        stop(process)
        self.assertIn("state standby, fault none", status.stdout)
        self.assertIn("5 wrong length, 5 wrong CRC, 0 wrong counter, 0 out of range", status.stdout)

    def test_real_time_runs_and_reports_and_stays_safe(self):
        process = firmware("realtime")
        result = run("striker-sil", "kick", "--bus", "can:vcan0", "--realtime", "--episodes", "2", "--log",
                     self.file("a.log"))
        out, told = stop(process)
        self.assertIn(result.returncode, (0, NOT_DRIVEN), result.stderr)  # a machine that stalls makes faults
        self.assertRegex(result.stdout, r"simulator's clock: \d+ ticks, \d+ periods missed, lateness mean")
        self.assertRegex(out, r"stopped after \d+ ticks; \d+ periods missed; lateness mean .* max")
        state = None
        for stamp, identifier, payload in read_log(self.file("a.log")):
            if identifier == STATUS:
                state = payload[1] >> 4
            if identifier == WHEEL_COMMAND and moves(payload):
                self.assertIn(state, (STANDBY, ACTIVE), f"moved in fault at {stamp} ms: {told}")

    def test_a_recorded_run_is_repeated_on_the_bus(self):
        self.kick("a.log")
        process = firmware()
        try:
            replayed = run("striker-sil", "replay", self.file("a.log"), "--bus", "can:vcan0")
        finally:
            stop(process)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        self.assertIn("4601 ticks: the answers of 4601 are the recorded ones, 0 differ", replayed.stdout)

    def record_a_run_on_the_wall_clock(self):
        """The frames of one that was driven: on a machine that stalls, not every one is, even with room for that."""
        for _ in range(5):
            process = firmware("realtime", "--scheduler", "other", "--period-us", "4000", "--overrun-limit", "1000")
            try:
                result = run("striker-sil", "kick", "--bus", "can:vcan0", "--realtime", "--episodes", "2", "--log",
                             self.file("a.log"))
            finally:
                stop(process)
            self.assertIn(result.returncode, (0, NOT_DRIVEN), result.stderr)
            recorded = read_log(self.file("a.log"))
            if any(identifier == WHEEL_COMMAND and moves(payload) for _, identifier, payload in recorded):
                return recorded
        self.fail("none of 5 runs was driven")

    def test_a_recorded_run_on_the_wall_clock_arms_no_other_controller(self):
        recorded = self.record_a_run_on_the_wall_clock()
        with open(self.file("world.log"), "w", encoding="ascii") as stream:
            for stamp, identifier, payload in recorded:
                if identifier not in striker_dbc.sent_by("Controller"):
                    stream.write(f"({stamp // 1000:010}.{stamp % 1000 * 1000:06}) vcan0 {identifier:03X}#{payload.hex()}\n")
        process = program("striker-firmware", "--can", "vcan0", "--clock", "realtime")
        process.stdout.readline()
        try:
            with listening() as bus:
                player = subprocess.Popen(["canplayer", "-I", self.file("world.log")])
                frames = collect(bus, 6)
                player.wait(timeout=60)
        finally:
            stop(process)
        self.assertTrue(any(identifier == MODE_COMMAND for identifier, _ in frames), "the operator was played too")
        states = {payload[1] >> 4 for identifier, payload in frames if identifier == STATUS}
        self.assertIn(STANDBY, states)
        self.assertNotIn(ACTIVE, states)

    # As with a controller that recovers by itself: the next frame on the bus is right behind the error.
    def test_a_bus_off_that_is_soon_over_is_a_fault(self):
        for _ in range(5):
            process = firmware("realtime")
            time.sleep(0.5)
            with listening() as bus:
                send(bus, ERROR_FLAG | ERROR_BUS_OFF, bytes(8))
                send(bus, WHEEL_STATE, bytes(striker_dbc.length("WheelState")))
            time.sleep(0.3)
            _, told = stop(process)
            self.assertIn("bus_off", told)

    def test_the_loop_calls_the_kernel_for_nothing_but_what_is_listed(self):
        trace = self.file("trace")
        result = subprocess.run(["strace", "-f", "-qq", "-o", trace, os.path.join(BIN, "striker-firmware"), "--can",
                                 "vcan0", "--clock", "realtime", "--ticks", "100", "--overrun-limit", "1000"],
                                capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(trace, encoding="utf-8", errors="replace") as stream:
            lines = stream.readlines()
        main = lines[0].split()[0]
        calls = [match[1] for match in (re.match(main + r" +(\w+)\(", line) for line in lines) if match]
        first = calls.index("clock_nanosleep")
        last = len(calls) - 1 - calls[::-1].index("clock_nanosleep")
        inside = calls[first:last]
        self.assertEqual(set(inside), {"clock_nanosleep", "recvmsg", "recvmmsg", "sendmmsg"} | ({"clock_gettime"} & set(inside)))
        for call in ("clock_nanosleep", "recvmsg", "recvmmsg", "sendmmsg"):
            self.assertEqual(inside.count(call), 99)

    def test_a_stopped_firmware_leaves_torque_zero(self):
        process = firmware()
        simulator = program("striker-sil", "kick", "--episodes", "50", "--bus", "can:vcan0", "--answer-timeout", "200")
        time.sleep(3)
        frames = []
        with listening(WHEEL_COMMAND) as bus:
            reader = threading.Thread(target=lambda: frames.extend(collect(bus, 3)))
            reader.start()
            stop(process)
            reader.join()
        simulator.kill()
        simulator.communicate()
        commands = [payload for identifier, payload in frames if identifier == WHEEL_COMMAND]
        self.assertFalse(moves(commands[-1]))

    def test_an_interface_that_is_not_there(self):
        for arguments in (("striker-firmware", "--can", "vcan9"), ("striker-command", "--can", "vcan9", "status"),
                          ("striker-sil", "kick", "--bus", "can:vcan9")):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn("'vcan9': no such interface", result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
