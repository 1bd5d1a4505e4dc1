#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The programs on a vcan0 that goes down, is deleted and made anew, or takes no more frames: run it as root where one
exists (tools/with-vcan). Usage: interface_vcan_test.py BIN_DIRECTORY [Interface.test_NAME...]"""

import json
import os
import random
import re
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "can"))

import files_case  # noqa: E402
import striker_dbc  # noqa: E402
from vcan_bus import collect, listening  # noqa: E402

BIN = sys.argv.pop(1)

STATUS, WHEEL_COMMAND = (striker_dbc.identifier(name) for name in ("Status", "WheelCommand"))
FAULT = striker_dbc.value("Status", "state", "fault")
BUS_FAILED, NOT_DRIVEN = 5, 3  # striker-sil kick
# A loop that leaves the one processor of a guest to the others, on a busy host too.
EASY = ("--scheduler", "other", "--period-us", "4000", "--overrun-limit", "1000")


def program(name, *arguments):
    return subprocess.Popen([os.path.join(BIN, name), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def run(name, *arguments, timeout=200):
    return subprocess.run([os.path.join(BIN, name), *arguments], capture_output=True, text=True, timeout=timeout, check=False)


def stop(process):
    if process.poll() is None:
        process.send_signal(signal.SIGTERM)
    return process.communicate(timeout=30)


def link(*arguments):
    subprocess.run(["ip", "link", *arguments], check=True)


def make_anew():
    link("add", "dev", "vcan0", "type", "vcan")
    link("set", "up", "vcan0")


class Interface(files_case.FilesCase):
    def tearDown(self):
        if subprocess.run(["ip", "link", "show", "vcan0"], capture_output=True, check=False).returncode != 0:
            make_anew()
        link("set", "up", "vcan0")

    def firmware(self, clock, *arguments):
        process = program("striker-firmware", "--can", "vcan0", "--clock", clock, "--challenge-seed", "0", *arguments)
        self.addCleanup(stop, process)
        process.stdout.readline()  # says when it listens
        return process

    @staticmethod
    def command(name):
        return run("striker-command", "--can", "vcan0", "--timeout", "20000", name)

    def test_a_firmware_hears_an_interface_that_was_made_anew_and_drives_nothing_until_it_is_armed(self):
        firmware = self.firmware("realtime", *EASY)
        self.assertEqual(self.command("status").returncode, 0)
        link("delete", "vcan0")
        time.sleep(0.5)
        make_anew()
        time.sleep(2.5)  # longer than any pause between two tries
        with listening() as bus:
            frames = collect(bus, 0.5)
        states = {payload[1] >> 4 for identifier, payload in frames if identifier == STATUS}
        commands = [payload for identifier, payload in frames if identifier == WHEEL_COMMAND]
        self.assertEqual(states, {FAULT})
        self.assertTrue(commands)
        self.assertFalse(any(any(payload[2:]) for payload in commands), "torque 0")
        status = self.command("status")
        self.assertIn("fault bus_off", status.stdout)
        clear = self.command("clear")
        self.assertEqual(clear.returncode, 0, clear.stderr)
        self.assertIn("state standby", clear.stdout)
        _, told = stop(firmware)
        for words in ("fault bus_off: torque 0", "'vcan0' went away or down", "'vcan0' is back: clear the fault, then arm"):
            self.assertEqual(told.count(words), 1, told)

    def test_a_simulator_on_the_wall_clock_goes_on_with_an_interface_that_was_made_anew(self):
        firmware = self.firmware("realtime", *EASY)
        simulator = program("striker-sil", "kick", "--bus", "can:vcan0", "--realtime", "--episodes", "4", "--json",
                            self.file("a.json"))
        time.sleep(2.0)
        link("delete", "vcan0")
        time.sleep(0.5)
        make_anew()
        _, told = simulator.communicate(timeout=200)
        stop(firmware)
        self.assertEqual(simulator.returncode, NOT_DRIVEN, told)
        self.assertIn("went away or down", told)
        self.assertIn("CAN interface 'vcan0' is back", told)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            report = json.load(stream)
        self.assertEqual(len(report["rows"]), 4)
        self.assertGreater(len(report["undriven_episodes"]), 0)

    def test_an_interface_that_stays_away_ends_a_run_on_the_wall_clock(self):
        self.firmware("realtime", *EASY)
        simulator = program("striker-sil", "kick", "--bus", "can:vcan0", "--realtime", "--episodes", "900000", "--json",
                            self.file("a.json"))
        self.await_episodes(1, simulator)
        link("set", "down", "vcan0")
        _, told = simulator.communicate(timeout=100)
        self.assertEqual(simulator.returncode, BUS_FAILED, told)
        self.assertIn("'vcan0': cannot send", told)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            self.assertGreater(len(json.load(stream)["rows"]), 0)

    def narrow(self, rate):
        """Lets vcan0 send at this rate, through a queue that holds 20 frames."""
        module = f"/usr/lib/uml/modules/{os.uname().release}/kernel/net/sched/sch_tbf.ko"
        if os.path.exists(module):
            subprocess.run(["busybox", "insmod", module], capture_output=True, check=False)  # it may be there already
        queue = ["tc", "qdisc", "add", "dev", "vcan0", "root", "tbf", "rate", rate, "burst", "160", "limit", "320"]
        if subprocess.run(queue, capture_output=True, check=False).returncode != 0:
            self.skipTest("this kernel has no sch_tbf")
        self.addCleanup(subprocess.run, ["tc", "qdisc", "del", "dev", "vcan0", "root"], check=True)

    def test_a_queue_that_is_full_is_waited_for_in_lockstep_and_changes_no_byte(self):
        in_process = run("striker-sil", "kick", "--episodes", "1", "--seed", "7", "--log", self.file("a.log"))
        self.assertEqual(in_process.returncode, 0)
        self.narrow("128kbit")
        firmware = self.firmware("sync")
        result = run("striker-sil", "kick", "--bus", "can:vcan0", "--episodes", "1", "--seed", "7", "--log", self.file("b.log"))
        out, told = stop(firmware)
        self.assertEqual((result.returncode, "no answer" in result.stderr), (0, False), result.stderr)
        self.assertIn(" 0 frames dropped", out, told)
        with open(self.file("a.log"), "rb") as one, open(self.file("b.log"), "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_a_queue_that_stays_full_is_named(self):
        self.narrow("8bit")
        result = run("striker-sil", "kick", "--bus", "can:vcan0", "--episodes", "1", "--answer-timeout", "300")
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in ("'vcan0'", "stayed full for 300 ms (ENOBUFS)", "txqueuelen"):
            self.assertIn(word, result.stderr)

    def test_an_interface_that_goes_at_any_moment_loses_no_episode_and_no_line(self):
        chance = random.Random(4)
        whole = run("striker-sil", "kick", "--episodes", "20", "--seed", "7", "--log", self.file("whole.log"), "--json",
                    self.file("whole.json"))
        self.assertEqual(whole.returncode, 0)
        finished = 0
        for _ in range(5):
            for name in os.listdir(self.directory.name):
                if name.startswith("a."):
                    os.remove(self.file(name))
            firmware = self.firmware("sync")
            simulator = program("striker-sil", "kick", "--bus", "can:vcan0", "--episodes", "20", "--seed", "7", "--log",
                                self.file("a.log"), "--json", self.file("a.json"), "--answer-timeout", "30000")
            self.await_episodes(chance.randrange(3), simulator)
            time.sleep(chance.uniform(0.0, 2.0))
            link("set", "down", "vcan0")
            out, told = simulator.communicate(timeout=100)
            stop(firmware)
            link("set", "up", "vcan0")
            finished += self.check_kept(simulator.returncode, out, told)
        self.assertGreater(finished, 0, "no run had an episode to keep: let them run longer")

    def await_episodes(self, count, simulator):
        journal = self.file("a.json.episodes.jsonl")
        deadline = time.monotonic() + 100
        while simulator.poll() is None and time.monotonic() < deadline:
            if os.path.exists(journal):
                with open(journal, encoding="utf-8") as stream:
                    if len(stream.readlines()) >= count:
                        return
            time.sleep(0.1)

    def check_kept(self, status, out, told):
        with open(self.file("whole.log"), "rb") as stream:
            whole_log = stream.read()
        with open(self.file("a.log"), "rb") as stream:
            log = stream.read()
        self.assertTrue(log.endswith(b"\n") or not log)
        self.assertTrue(whole_log.startswith(log), "every line of every tick that was played, and no other")
        self.assertIn("'vcan0': cannot send", told)
        name = "a.json" if status == BUS_FAILED else "a.json.episodes.jsonl"
        with open(self.file(name), encoding="utf-8") as stream:
            rows = json.load(stream)["rows"] if status == BUS_FAILED else [json.loads(line) for line in stream]
        with open(self.file("whole.json"), encoding="utf-8") as stream:
            self.assertEqual(rows, json.load(stream)["rows"][:len(rows)])
        last_ms = int(re.findall(rb"^\((\d{10}\.\d{3})", log, re.MULTILINE)[-1].replace(b".", b"")) if log else 0
        self.assertEqual(len(rows), max(0, last_ms + 1 - 200) // 2200, "as many as the log has whole")
        self.assertEqual(status, BUS_FAILED if rows else 2, told)
        if rows:
            self.assertIn(f"ended after {len(rows)} of 20 episodes; they are kept", told)
            self.assertIn(f"{len(rows)} episodes: mean reward", out)
        return len(rows)


if __name__ == "__main__":
    unittest.main(verbosity=2)
