#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What programs do with files, numbers and names that are not as they should be, and with ends that nobody planned:
nothing that was there is lost, nothing that was done is lost, and nothing false ends with 0.
Usage: nothing_lost_test.py BIN_DIRECTORY"""

import json
import os
import random
import re
import resource
import signal
import stat
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import files_case

BIN = sys.argv.pop(1)
ROBOT = os.path.join(files_case.ROBOTS, "forward.toml")

LINE = re.compile(r"\(\d{10}\.\d{6}\) vcan0 [0-9A-F]{3}#([0-9A-F]{2})*")


def run(name, *arguments, **options):
    return subprocess.run([os.path.join(BIN, name), *arguments], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          timeout=120, **({"stdout": subprocess.PIPE} | options))


def budget(*arguments, **options):
    return run("striker-bus-budget", *arguments, **options)


class Files(files_case.FilesCase):
    def test_a_device_stays_one_and_takes_the_output(self):
        for device in ("/dev/null", "/dev/stdout"):
            before = os.stat(device)
            result = budget("--json", device)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(stat.S_IFMT(os.stat(device).st_mode), stat.S_IFMT(before.st_mode))
        self.assertIn('"messages"', budget("--json", "/dev/stdout").stdout)

    def test_a_fifo_stays_one_and_takes_the_output(self):
        fifo = self.file("pipe")
        os.mkfifo(fifo)
        read = []
        reader = threading.Thread(target=lambda: read.append(subprocess.run(["cat", fifo], capture_output=True, text=True).stdout))
        reader.start()
        result = budget("--json", fifo)
        reader.join(timeout=20)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(stat.S_ISFIFO(os.stat(fifo).st_mode))
        self.assertIn("messages", json.loads(read[0]))

    def test_a_link_stays_one_and_its_file_is_replaced(self):
        os.mkdir(self.file("there"))
        for target in ("there/old.json", "there/new.json"):
            link = self.file("link-" + os.path.basename(target))
            os.symlink(target, link)
            if "old" in target:
                self.file(target, "old")
            self.assertEqual(budget("--json", link).returncode, 0)
            self.assertEqual(os.readlink(link), target)
            with open(self.file(target), encoding="utf-8") as stream:
                self.assertIn("messages", json.load(stream))
        self.assertEqual(sorted(os.listdir(self.file("there"))), ["new.json", "old.json"])

    def test_mode_and_owner_are_kept(self):
        path = self.file("a.json", "old")
        os.chmod(path, 0o640)
        owner = (1234, 1235) if os.getuid() == 0 else (os.getuid(), os.getgid())
        os.chown(path, *owner)
        self.assertEqual(budget("--json", path).returncode, 0)
        after = os.stat(path)
        self.assertEqual((stat.S_IMODE(after.st_mode), (after.st_uid, after.st_gid)), (0o640, owner))
        self.assertGreater(after.st_size, 10)

    def test_a_file_is_not_written_twice_nor_over_what_is_read(self):
        log = self.file("run.log")
        self.assertEqual(run("striker-sil", "kick", "--episodes", "1", "--log", log).returncode, 0)
        os.symlink("run.log", self.file("same"))
        plan = self.file("plan.toml", '[[case]]\nname = "none"\nepisode = 1\n[[case.fault]]\nkind = "error_passive"\n'
                         'from_ms = 0\nuntil_ms = 1\n')
        for name, *arguments in (("striker-sil", "kick", "--log", log, "--json", log),
                                 ("striker-sil", "kick", "--log", log, "--json", self.file("same")),
                                 ("striker-sil", "kick", "--log", log, "--decisions", os.path.relpath(log)),
                                 ("striker-sil", "faults", "--plan", plan, "--json", plan)):
            with open(log, "rb") as stream:
                before = stream.read()
            result = run(name, *arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn("name two files", result.stderr)
            with open(log, "rb") as stream:
                self.assertEqual(stream.read(), before)
        with open(plan, encoding="utf-8") as stream:
            self.assertIn("error_passive", stream.read())

    def test_an_export_does_not_write_over_its_model(self):
        model = self.file("m.safetensors", "a model")
        result = run("striker-export", model, "-o", model)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("name two files", result.stderr)
        with open(model, encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "a model")

    def test_where_nothing_can_be_written_is_said_before_the_run(self):
        os.mkdir(self.file("folder"))
        for path, word in ((self.file("none/a.json"), "there is no folder"), (self.file("folder"), "is a folder"),
                           ("", "is empty"), ("/proc/a.json", "cannot be written")):
            for name, *arguments in (("striker-sil", "kick", "--episodes", "900000", "--json"),
                                     ("striker-sil", "kick", "--episodes", "900000", "--log"),
                                     ("striker-sil", "faults", "--json"), ("striker-bus-budget", "--json"),
                                     ("striker-robot", "check", ROBOT, "--json"),
                                     ("striker-firmware", "--in-process", "--clock", "realtime", "--json")):
                if path == "/proc/a.json" and os.getuid() == 0:
                    continue  # root's access is not asked there
                result = run(name, *arguments, path)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn(word, result.stderr)

    def test_output_that_nobody_took_is_no_success(self):
        for name, *arguments in (("striker-bus-budget",), ("striker-bus-budget", "--help"), ("striker-dbc",),
                                 ("striker-robot", "check", ROBOT),
                                 ("striker-sil", "kick", "--episodes", "1"), ("striker-sil", "--version"),
                                 ("striker-ceiling", "--help"), ("striker-train", "--help"), ("striker-export", "--help"),
                                 ("striker-evaluate", "--help"), ("striker-experiment", "--help"),
                                 ("striker-command", "--help"), ("striker-firmware", "--help")):
            with open("/dev/full", "w", encoding="utf-8") as full:
                result = run(name, *arguments, stdout=full)
            self.assertEqual(result.returncode, 2, name)
            self.assertIn("standard output cannot be written", result.stderr)


class Ends(files_case.FilesCase):
    """A run that is ended in any moment keeps what it had finished."""

    def start(self, **options):
        return subprocess.Popen([os.path.join(BIN, "striker-sil"), "kick", "--episodes", "900000", "--log", self.file("a.log"),
                                 "--json", self.file("a.json")], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                **options)

    def wait_for_an_episode(self):
        journal = self.file("a.json.episodes.jsonl")
        end = time.monotonic() + 60
        while not os.path.exists(journal) or os.path.getsize(journal) == 0:
            self.assertLess(time.monotonic(), end, "no episode within a minute")
            time.sleep(0.05)

    def check_log(self, path):
        with open(path, encoding="ascii") as stream:
            text = stream.read()
        lines = text.split("\n")
        self.assertEqual(lines.pop(), "", "whole lines")
        self.assertTrue(all(LINE.fullmatch(line) for line in lines[:1000] + lines[-1000:]))
        return len(lines)

    def check_episodes(self, path):
        with open(path, encoding="utf-8") as stream:
            rows = [json.loads(line) for line in stream]
        self.assertEqual([row["episode"] for row in rows], list(range(len(rows))))
        return len(rows)

    def test_a_kill_at_any_moment_keeps_every_line_and_episode(self):
        chance = random.Random(1)
        for _ in range(6):
            process = self.start()
            time.sleep(chance.uniform(0.3, 1.5))
            process.kill()
            process.communicate()
            lines = self.check_log(self.file("a.log.part"))
            episodes = self.check_episodes(self.file("a.json.episodes.jsonl"))
            self.assertFalse(os.path.exists(self.file("a.log")))
            # Four frames and more a tick, 2,200 ticks an episode: the log is as far as the journal.
            self.assertGreater(lines, 4 * 2200 * episodes)
            self.assertLess(lines, 6 * 2200 * (episodes + 2))

    def test_a_signal_keeps_whole_files(self):
        for number in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
            process = self.start()
            self.wait_for_an_episode()
            process.send_signal(number)
            _, told = process.communicate(timeout=20)
            self.assertEqual(process.returncode, 130, told)
            self.assertIn("they are kept", told)
            self.check_log(self.file("a.log"))
            with open(self.file("a.json"), encoding="utf-8") as stream:
                self.assertGreater(len(json.load(stream)["rows"]), 0)
            self.assertEqual(sorted(os.listdir(self.directory.name)), ["a.json", "a.log"])

    def test_a_hang_up_is_ignored_under_nohup(self):
        process = self.start(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        time.sleep(0.4)
        process.send_signal(signal.SIGHUP)
        time.sleep(0.3)
        self.assertIsNone(process.poll())
        process.kill()
        process.communicate()

    def test_a_full_disk_keeps_every_finished_episode(self):
        limit = 3_000_000  # bytes of the log, as a disk that is full
        process = self.start(restore_signals=False,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        out, told = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 5, told)
        self.assertIn("a.log", told)
        self.assertIn("a.log.part", told)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            rows = len(json.load(stream)["rows"])
        self.assertGreater(rows, 2)
        self.assertIn(f"{rows} episodes: mean reward", out)


class CommandLine(unittest.TestCase):
    def refuse(self, *words, command):
        result = run(*command)
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertTrue(result.stderr.startswith(command[0] + ": "), result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_a_number_is_a_finite_one_and_no_other_than_was_written(self):
        for command in (("striker-bus-budget", "--errors-per-s"), ("striker-bus-budget", "--jitter-us"),
                        ("striker-bus-budget", "--lateness-us"), ("striker-bus-budget", "--step-us"),
                        ("striker-sil", "kick", "--bitrate", "500000", "--step-us")):
            for value in ("nan", "NAN", "-nan", "inf", "-inf", "1e999"):
                self.refuse(command[-1], command=(*command, value))
        for command in (("striker-sil", "kick", "--seed"), ("striker-sil", "kick", "--first"), ("striker-sil", "faults", "--seed"),
                        ("striker-sil", "campaign", "--out", "x", "--seed"),
                        ("striker-firmware", "--in-process", "--challenge-seed"),
                        ("striker-firmware", "--in-process", "--clock", "realtime", "--ticks")):
            for value in ("-1", "18446744073709551616", "1.5", "1e3", "0x10", "", " 1"):
                self.refuse(command[-1], command=(*command, value))

    def test_the_greatest_seed_is_one(self):
        result = run("striker-sil", "kick", "--episodes", "1", "--seed", "18446744073709551615")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_name_that_is_nearly_right_is_answered_with_the_right_one(self):
        for command, name in ((("striker-sil", "kick", "--episode", "3"), "--episodes"), (("striker-sil", "kik"), "kick"),
                              (("striker-bus-budget", "--bit-rate", "1"), "--bitrate"),
                              (("striker-firmware", "--can", "vcan0", "--schedular", "fifo"), "--scheduler"),
                              (("striker-command", "--can", "vcan0", "estopp"), "estop")):
            self.refuse(f"did you mean {name}?", command=command)

    def test_an_option_that_would_be_ignored_is_refused(self):
        realtime, sync = ("--clock", "realtime"), ("--clock", "sync")
        for name, *arguments in (*(("striker-firmware", "--can", "vcan0", *sync, option, value) for option, value in
                                   (("--ticks", "3"), ("--json", "/tmp/x.json"), ("--period-us", "900"),
                                    ("--frames-per-tick", "3"), ("--overrun-limit", "3"))),
                                 ("striker-firmware", "--can", "vcan0", *realtime, "--sync-timeout", "9"),
                                 ("striker-firmware", "--in-process", *realtime, "--scheduler", "other", "--priority", "9"),
                                 ("striker-firmware", "--in-process", *realtime, "--runtime-us", "90"),
                                 ("striker-firmware", "--in-process", *realtime, "--interface", "vcan0"),
                                 ("striker-firmware", "--replay", "/dev/null", "--ticks", "3"),
                                 ("striker-sil", "kick", "--realtime", "--bus", "can:vcan0", "--answer-timeout", "9"),
                                 ("striker-sil", "kick", "--realtime", "--bus", "can:vcan0", "--start-timeout", "9"),
                                 ("striker-sil", "kick", "--realtime", "--bus", "can:vcan0", "--bitrate", "500000"),
                                 ("striker-sil", "kick", "--answer-timeout", "9"),
                                 ("striker-sil", "kick", "--bus", "can:vcan0", "--decisions", "/tmp/x.csv"),
                                 ("striker-sil", "replay", "/dev/null", "--start-timeout", "9"),
                                 ("striker-sil", "faults", "--bus", "can:vcan0", "--jobs", "2")):
            self.refuse(arguments[-2], "means nothing but with ", "leave it out", command=(name, *arguments))

    def test_the_firmware_takes_one_bus(self):
        for buses in ((), ("--can", "vcan0", "--in-process"), ("--replay", "/dev/null", "--can", "vcan0")):
            self.refuse("--can", "--in-process", "--replay", "exactly one", command=("striker-firmware", *buses))
        self.refuse("--in-process", "--clock realtime", command=("striker-firmware", "--in-process"))

    def test_help_fits_a_terminal_and_says_first_what_the_program_is_for(self):
        for command in (("striker-sil",), ("striker-sil", "kick"), ("striker-sil", "faults"), ("striker-sil", "campaign"),
                        ("striker-sil", "replay"), ("striker-firmware",), ("striker-command",), ("striker-command", "arm"),
                        ("striker-bus-budget",), ("striker-dbc",), ("striker-train",), ("striker-evaluate",),
                        ("striker-export",), ("striker-experiment",), ("striker-ceiling",)):
            text = run(*command, "--help").stdout
            lines = text.split("\n")
            self.assertRegex(lines[0], r"^[A-Z]")
            self.assertLessEqual(max(map(len, lines)), 100, text)
            self.assertNotRegex(text, r"U?INT:|FLOAT:|TEXT:|Needs:|Excludes:|Option Group")
            self.assertLess(text.index("Usage: "), text.index("Options:"))
            if "Exit status" in text:
                self.assertGreater(text.index("Exit status"), text.index("Options:"))

    def test_reports_name_the_policy(self):
        identity = re.search(r"policy kick ([0-9a-f]{8})$", run("striker-sil", "--version").stdout.strip())[1]
        with tempfile.TemporaryDirectory() as directory:
            for name, *arguments in (("striker-sil", "kick", "--episodes", "1"),
                                     ("striker-firmware", "--in-process", "--clock", "realtime", "--ticks", "3")):
                file = os.path.join(directory, "a.json")
                result = run(name, *arguments, "--json", file)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(f"policy kick {identity}\n", result.stdout)
                with open(file, encoding="utf-8") as stream:
                    report = json.load(stream)
                self.assertEqual((report["policy_name"], report["policy"]), ("kick", identity))

    def test_options_stand_before_or_behind_the_subcommand(self):
        for arguments in (("--can", "none9", "status"), ("status", "--can", "none9")):
            self.assertIn("none9", run("striker-command", *arguments).stderr)


if __name__ == "__main__":
    unittest.main()
