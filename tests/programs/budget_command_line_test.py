#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""striker-bus-budget, and striker-sil's bus in time. Usage: budget_command_line_test.py BIN_DIRECTORY"""

import json
import os
import subprocess
import sys
import unittest

import files_case

BIN = sys.argv.pop(1)


def budget(*arguments):
    return subprocess.run([os.path.join(BIN, "striker-bus-budget"), *arguments], capture_output=True, text=True)


def kick(*arguments):
    return subprocess.run([os.path.join(BIN, "striker-sil"), "kick", "--episodes", "1", *arguments],
                          capture_output=True, text=True)


class BudgetCommandLine(files_case.FilesCase):
    def test_every_deadline_is_met_at_1_mbit_s(self):
        result = budget("--json", self.file("a.json"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("every deadline is met", result.stdout)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            summary = json.load(stream)
        self.assertEqual(len(summary["messages"]), 17)
        self.assertEqual(summary["missed"], [])
        self.assertTrue(0.3 < summary["utilisation"] < 0.5)
        decision = summary["decision"]
        parts = ("picture_us", "phase_us", "lateness_us", "step_us", "command_us")
        self.assertEqual(decision["total_us"], sum(decision[part] for part in parts))
        for message in summary["messages"]:
            self.assertEqual(message["margin_us"], message["deadline_us"] - message["response_us"])

    def test_at_500_kbit_s_the_misses_are_named(self):
        result = budget("--bitrate", "500000")
        self.assertEqual(result.returncode, 1)
        self.assertIn("deadline missed by WheelCommand, WheelState, VisionPose, VisionBall, WheelOrder, MotionOrder, Status",
                      result.stdout)
        self.assertEqual(sum(line.endswith("MISSED") for line in result.stdout.splitlines()), 7)

    def test_at_250_kbit_s_there_is_no_bound(self):
        result = budget("--bitrate", "250000")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no bound", result.stdout)
        self.assertNotIn("picture to torque", result.stdout)

    def test_the_dbc_gives_the_same_budget(self):
        dbc = self.file("striker.dbc", subprocess.run([os.path.join(BIN, "striker-dbc")], capture_output=True,
                                                      text=True, check=True).stdout)
        for more in ([], ["--lockstep", "--bitrate", "500000"], ["--errors-per-s", "10"]):
            own, read = budget(*more), budget("--dbc", dbc, *more)
            self.assertEqual(own.stdout.splitlines()[1:], read.stdout.splitlines()[1:])
            self.assertEqual(own.returncode, read.returncode)

    def test_errors_and_jitter_lengthen_responses(self):
        def response(*arguments):
            budget(*arguments, "--json", self.file("b.json"))
            with open(self.file("b.json"), encoding="utf-8") as stream:
                return [message["response_us"] for message in json.load(stream)["messages"]]
        for more in (["--errors-per-s", "10"], ["--jitter-us", "200"], ["--step-us", "90"], ["--lateness-us", "300"]):
            self.assertGreater(sum(response(*more)), sum(response()), more)

    def test_errors_that_are_rare_without_end_are_one(self):
        once = budget("--errors-per-s", "0.001").stdout.splitlines()[1:]
        self.assertEqual(budget("--errors-per-s", "1e-300").stdout.splitlines()[1:], once)
        self.assertNotEqual(budget().stdout.splitlines()[1:], once)

    def test_can_fd_has_two_bit_rates(self):
        dbc = self.file("fd.dbc", 'BO_ 1 Fd: 64 A\nBO_ 2147483649 Long: 8 A\nBO_ 2 Short: 8 A\n')
        def frames(*arguments):
            result = budget("--dbc", dbc, "--default-distance-ms", "10", "--json", self.file("f.json"), *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(self.file("f.json"), encoding="utf-8") as stream:
                summary = json.load(stream)
            return summary["data_bitrate"], {message["name"]: message for message in summary["messages"]}
        rate, messages = frames("--bitrate", "500000", "--data-bitrate", "2000000")
        self.assertEqual(rate, 2000000)
        self.assertEqual({name: message["format"] for name, message in messages.items()},
                         {"Long": "ExtendedCAN", "Fd": "StandardCAN_FD", "Short": "StandardCAN"})
        self.assertEqual({name: message["bit_rate_switch"] for name, message in messages.items()},
                         {"Long": False, "Fd": True, "Short": False})
        self.assertEqual([messages[name]["frame_us"] for name in ("Fd", "Long", "Short")],
                         [32 * 2 + (39 + 640) / 2, 160 * 2, 135 * 2])
        self.assertEqual(messages["Long"]["id"], 1)
        self.assertEqual(frames("--data-bitrate", "1000000")[1]["Fd"]["frame_us"], 32 + 39 + 640)
        self.assertEqual(budget("--dbc", dbc, "--default-distance-ms", "10").returncode, 2)

    def test_events_that_nothing_bounds_are_named(self):
        dbc = self.file("e.dbc", 'BO_ 1 Both: 8 A\nBA_DEF_ BO_ "GenMsgSendType" ENUM "Cyclic","CyclicAndEvent";\n'
                        'BA_ "GenMsgSendType" BO_ 1 1;\nBA_ "GenMsgCycleTime" BO_ 1 50;\n')
        result = budget("--dbc", dbc, "--json", self.file("e.json"))
        self.assertIn("sent on events too (give GenMsgDelayTime): Both", result.stdout)
        with open(self.file("e.json"), encoding="utf-8") as stream:
            self.assertEqual(json.load(stream)["events_uncounted"], ["Both"])
        self.assertNotIn("events", budget().stdout)

    def test_the_simulators_log_shows_bus_time_only_when_asked_to(self):
        def stamps_us(*arguments):
            result = kick("--log", self.file("bus.log"), *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(self.file("bus.log"), encoding="ascii") as log:
                return [int(line[1:18].replace(".", "")) for line in log], result.stdout
        plain, told = stamps_us()
        self.assertTrue(all(stamp % 1000 == 0 for stamp in plain))
        self.assertNotIn("bit/s", told)
        timed, told = stamps_us("--bitrate", "500000")
        self.assertEqual(timed, sorted(set(timed)))  # one frame at a time
        self.assertRegex(told, r"bus at 500000 bit/s: busy \d+\.\d %, 0 frames replaced .* over 4\d decisions")
        self.assertGreater(sum(stamps_us("--bitrate", "500000", "--step-us", "400")[0]), sum(timed))

    def test_the_simulator_refuses_what_does_not_go_together(self):
        for arguments, word in ((["--bitrate", "83333"], "'83333'"), (["--step-us", "10"], "--bitrate"),
                                (["--vision-phase-us", "1000", "--bitrate", "1000000"], "--vision-phase-us"),
                                (["--bitrate", "1000000", "--realtime", "--bus", "can:vcan0"], "--bitrate")):
            result = kick(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(word, result.stderr)

    def test_errors_say_what_is_wrong(self):
        for arguments, word in ((["--bitrate", "83333"], "'83333'"), (["--bitrate", "2000000"], "1000000"),
                                (["--dbc", "/nonexistent.dbc"], "/nonexistent.dbc"),
                                (["--json", "/nonexistent/a.json"], "/nonexistent/a.json"),
                                (["--jitter-us", "-1"], "--jitter-us"), (["--jitter-us", "nan"], "--jitter-us"),
                                (["--errors-per-s", "nan"], "--errors-per-s"),
                                (["--lateness-us", "inf"], "--lateness-us"), (["--step-us", "-nan"], "--step-us"),
                                (["--dbc", ""], "--dbc"), (["--json", ""], "--json"),
                                (["--data-bitrate", "3000000"], "'3000000'"),
                                (["--data-bitrate", "500000"], "--data-bitrate 500000 is slower"),
                                (["--lockstep", "--dbc", self.file("a.dbc", "BO_ 1 M: 8 A\n"),
                                  "--default-distance-ms", "5"], "--lockstep")):
            result = budget(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
