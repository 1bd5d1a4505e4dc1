#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""striker-sil match, league and replay, as somebody uses them.
Usage: match_test.py BIN"""

import gzip
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import files_case  # noqa: E402

BIN = sys.argv.pop()
PLAYER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "match", "team", "rules_player.py")
WALL_CLOCK = "timing.json"  # the only file with wall-clock figures


def sil(*arguments, before=()):
    return subprocess.run([*before, os.path.join(BIN, "striker-sil"), *arguments], capture_output=True, text=True, check=False,
                          timeout=300)


def files_in(directory):
    return sorted(os.path.relpath(os.path.join(folder, name), directory)
                  for folder, _, names in os.walk(directory) for name in names)


def content(*path):
    with open(os.path.join(*path), "rb") as stream:
        return stream.read()


class Match(files_case.FilesCase):
    def match(self, out, *arguments, half_s="4"):
        result = sil("match", "--half-s", half_s, "-o", self.file(out), *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def report(self, out):
        return json.loads(content(self.file(out), "match.json"))

    def assert_same_files(self, one, other):
        self.assertEqual(files_in(self.file(one)), files_in(self.file(other)))
        for name in files_in(self.file(one)):
            if name != WALL_CLOCK:
                self.assertEqual(content(self.file(one), name), content(self.file(other), name), name)

    def test_the_same_match_writes_the_same_bytes(self):
        self.match("a", "--red", "rules", "--blue", "striker", "--seed", "7")
        self.match("b", "--red", "rules", "--blue", "striker", "--seed", "7")
        self.assertEqual(len(files_in(self.file("a"))), 5 + 10)
        self.assert_same_files("a", "b")
        self.match("c", "--red", "rules", "--blue", "striker", "--seed", "8")
        self.assertNotEqual(self.report("a")["state_hash"], self.report("c")["state_hash"])

    def test_a_replay_finds_one_altered_frame(self):
        self.match("a", "--red", "rules", "--blue", "random")
        self.assertEqual(sil("replay", self.file("a")).returncode, 0)
        name = os.path.join(self.file("a"), "bus", "vcan6.log.gz")
        with gzip.open(name, "rt") as stream:
            lines = stream.readlines()
        at = next(i for i, line in enumerate(lines) if line.startswith("(0000000003.050000) vcan6 084#"))
        lines[at] = lines[at][:-3] + ("00" if lines[at][-3:-1] != "00" else "11") + "\n"
        with gzip.open(name, "wt") as stream:
            stream.writelines(lines)
        result = sil("replay", self.file("a"))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("frame 61, robot 6", result.stdout)

    def test_a_replay_finds_every_record_that_is_another(self):
        self.match("a", "--red", "rules", "--blue", "random", half_s="2")

        def changed(name, change, status=1, *words):
            path = os.path.join(self.file("a"), name)
            sound = content(path)
            with open(path, "wb") as stream:
                stream.write(change(sound))
            try:
                result = sil("replay", self.file("a"))
                self.assertEqual(result.returncode, status, (name, result.stdout, result.stderr))
                for word in (os.path.basename(name), *words):
                    self.assertIn(word, result.stdout + result.stderr)
            finally:
                with open(path, "wb") as stream:
                    stream.write(sound)

        def packed(change):
            return lambda sound: gzip.compress(change(gzip.decompress(sound)))

        def without_50_lines(text):
            return b"\n".join(text.split(b"\n")[:-50])

        def other_digit(text):
            at = text.rindex(b"1")
            return text[:at] + b"2" + text[at + 1:]

        for name in ("frames.csv", "events.jsonl"):
            changed(name, other_digit, 1, "line")
            changed(name, without_50_lines if name == "frames.csv" else (lambda text: text[:-20]))
            changed(name, lambda text: text + b"\n")
        changed("match.log.gz", packed(lambda text: text[:-1] + b"?"))
        changed("match.log.gz", lambda packed_text: packed_text + b"behind")
        changed("match.log.gz", lambda packed_text: packed_text[:-100])
        changed("match.json", lambda text: text.replace(b'"seed": 1,', b'"seed": 1.0,'))
        changed("match.json", lambda text: text.replace(b'"seed": 1,', b'"seed": 1,\n "seed": 1,'))
        bus = os.path.join("bus", "vcan3.log.gz")
        for change in (lambda text: text.replace(b"\n", b"\0evil\n", 1), lambda text: text + b"\n", lambda text: text[:-1]):
            path = os.path.join(self.file("a"), bus)
            sound = content(path)
            with open(path, "wb") as stream:
                stream.write(gzip.compress(change(gzip.decompress(sound))))
            result = sil("replay", self.file("a"))
            self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
            self.assertIn("robot 3", result.stdout)
            with open(path, "wb") as stream:
                stream.write(sound)
        changed(bus, lambda packed_text: packed_text + b"garbage", 2, "behind its end")
        for name in ("frames.csv", "events.jsonl", "match.log.gz"):
            os.rename(os.path.join(self.file("a"), name), self.file("away"))
            result = sil("replay", self.file("a"))
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(f"{name}: is not there", result.stdout)
            os.rename(self.file("away"), os.path.join(self.file("a"), name))
        self.assertEqual(sil("replay", self.file("a")).returncode, 0)

    def test_an_interrupted_match_is_kept_and_replays(self):
        process = subprocess.Popen([os.path.join(BIN, "striker-sil"), "match", "--half-s", "3000", "-o", self.file("a")],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        log = os.path.join(self.file("a"), "bus", "vcan0.log.gz.part")
        end = time.monotonic() + 60
        while (not os.path.exists(log) or os.path.getsize(log) < 100_000) and time.monotonic() < end:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertFalse(self.report("a")["complete"])
        self.assertFalse([name for name in files_in(self.file("a")) if name.endswith(".part")])
        self.assertEqual(sil("replay", self.file("a")).returncode, 0)

    def test_a_robots_faults_cost_its_team_and_stop_nobody(self):
        plan = self.file("faults.toml", """
[[case]]
name = "robot3"
[[case.fault]]
kind = "loss"
probability = 0.1
from_ms = 0
until_ms = 60000
[[case]]
name = "robot4"
[[case.fault]]
kind = "brown_out"
from_ms = 4000
until_ms = 4500
[[case]]
name = "robot1"
[[case.fault]]
kind = "camera_frozen"
from_ms = 3000
until_ms = 6000
""")
        self.match("a", "--red", "rules", "--blue", "rules", "--faults", plan, half_s="8")
        report = self.report("a")
        self.assertTrue(report["complete"])
        undriven = [robot["undriven_s"] for robot in report["robots"]]
        self.assertGreater(undriven[1], 0.5, "the frozen camera stops it")
        self.assertGreater(undriven[4], 0.3, "it was dead for half a second")
        self.assertEqual(sil("replay", self.file("a")).returncode, 0)
        for text, word in (("[[case]]\nname = \"nobody\"\n[[case.fault]]\nkind = \"loss\"\nfrom_ms = 0\nuntil_ms = 1\n", "nobody"),
                           ("[[case]]\nname = \"robot0\"\nseed = 3\n[[case.fault]]\nkind = \"loss\"\nfrom_ms = 0\nuntil_ms = 1\n", "seed"),
                           ("[[case]]\nname = \"robot0\"\n[[case.fault]]\nkind = \"brown_out\"\nfrom_ms = 0\nuntil_ms = 1\n", "brown_out")):
            result = sil("match", "--faults", self.file("wrong.toml", text))
            self.assertEqual(result.returncode, 2)
            self.assertIn(word, result.stderr)

    def test_a_player_program_plays_as_the_same_rules_inside(self):
        self.match("inside", "--red", "rules", "--blue", "rules")
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        match = subprocess.Popen([os.path.join(BIN, "striker-sil"), "match", "--half-s", "4", "--red", "rules", "--blue",
                                  f"tcp:{port}", "-o", self.file("player")], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 text=True)
        player = None
        try:
            end = time.monotonic() + 30
            while player is None or player.poll() not in (None, 0):
                self.assertLess(time.monotonic(), end)
                time.sleep(0.2)
                player = subprocess.Popen([sys.executable, PLAYER, "127.0.0.1", str(port), "key", self.directory.name],
                                          stderr=subprocess.DEVNULL)
                time.sleep(0.3)
            _, told = match.communicate(timeout=120)
            self.assertEqual(match.returncode, 0, told)
        finally:
            match.kill()
            if player:
                player.kill()
                player.wait()
        self.assertEqual(self.report("player")["state_hash"], self.report("inside")["state_hash"])

    def test_a_player_that_never_comes_costs_its_team_alone(self):
        result = self.match("a", "--red", "rules", "--blue", "tcp:45731", "--answer-timeout", "1", half_s="2")
        self.assertIn("45731", result.stderr)
        report = self.report("a")
        self.assertTrue(report["complete"])
        asked = report["blue"]["orders"]["asked_frames"]
        self.assertGreater(asked, 20)
        self.assertEqual(report["blue"]["orders"]["unanswered_frames"], asked)
        self.assertEqual(report["red"]["orders"]["unanswered_frames"], 0)
        self.assertIn("tcp:45731 is gone in frame", result.stderr)
        self.assertIn(f"tcp:45731 gave no answer in {asked} of {asked} frames", result.stderr)
        self.assertEqual(sil("replay", self.file("a")).returncode, 0)

    def test_wrong_use_is_refused_in_words(self):
        for arguments, word in ((["--red", "nobody"], "rules-published"), (["--red", "tcp:0"], "port"), (["--half-s", "0"], "--half-s"),
                                (["--bus", "can"], "--bus"), (["--slip", "2"], "--slip"), (["--rules", "mine"], "--rules")):
            result = sil("match", *arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(word, result.stderr)
        result = sil("replay", self.directory.name)
        self.assertEqual(result.returncode, 2)
        self.assertIn("match.json", result.stderr)


class League(files_case.FilesCase):
    def league(self, out, *arguments, before=()):
        return sil("league", "--teams", "rules,random", "--pairs", "2", "--half-s", "2", "-o", self.file(out), *arguments,
                   before=before)

    def tables(self, out):
        return {name: content(self.file(out), name)
                for name in ("league.md", "league.csv", "pairings.csv", "league.json", "matches.jsonl")}

    def test_the_table_is_the_same_with_any_number_of_processes(self):
        for out, arguments in (("one", ()), ("two", ("--jobs", "2"))):
            result = self.league(out, *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("rules", result.stdout)
        self.assertEqual(self.tables("one"), self.tables("two"))
        self.assertEqual(json.loads(self.tables("one")["league.json"])["matches"], 4)

    @unittest.skipIf(shutil.which("mpirun") is None, "mpirun is not installed")
    def test_the_table_is_the_same_under_mpirun(self):
        self.assertEqual(self.league("one").returncode, 0)
        result = self.league("mpi", before=("mpirun", "--allow-run-as-root", "--oversubscribe", "-np", "2"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.tables("one"), self.tables("mpi"))

    def test_it_goes_on_where_it_was_interrupted(self):
        self.assertEqual(self.league("whole").returncode, 0)
        self.assertEqual(self.league("cut").returncode, 0)
        with open(os.path.join(self.file("cut"), "matches.jsonl"), encoding="utf-8") as stream:
            lines = stream.readlines()
        with open(os.path.join(self.file("cut"), "matches.jsonl"), "w", encoding="utf-8") as stream:
            stream.writelines(lines[:2] + [lines[3], lines[4][:50]])
        self.assertEqual(self.league("cut").returncode, 0)
        self.assertEqual(self.tables("whole"), self.tables("cut"))

    def test_an_edited_match_is_told_with_file_and_line(self):
        self.assertEqual(self.league("a").returncode, 0)
        path = os.path.join(self.file("a"), "matches.jsonl")
        sound = content(path)
        for edit, line in ((lambda text: re.sub(rb'"score":\[\d+,\d+\]', b'"score":[-9,0]', text, count=1), 2),
                           (lambda text: re.sub(rb'"score":\[\d+,\d+\]', b'"score":[9,0]', text, count=1), 2),
                           (lambda text: text[:text.rindex(b'"state_hash":"')] + text[text.rindex(b'"state_hash":"'):].replace(
                               b'"state_hash":"', b'"state_hash":"Z', 1), 5)):
            with open(path, "wb") as stream:
                stream.write(edit(sound))
            result = self.league("a")
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn(f"matches.jsonl: line {line}: ", result.stderr)

    def test_one_league_at_a_time_is_in_a_directory_and_a_shorter_one_drops_nothing(self):
        long = subprocess.Popen([os.path.join(BIN, "striker-sil"), "league", "--teams", "rules,random", "--pairs", "100000",
                                 "--half-s", "2", "-o", self.file("a")], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        path = os.path.join(self.file("a"), "matches.jsonl")
        try:
            end = time.monotonic() + 120
            while (not os.path.exists(path) or content(path).count(b"\n") < 6) and time.monotonic() < end:
                time.sleep(0.1)
            refused = self.league("a")
            self.assertEqual(refused.returncode, 2, refused.stdout)
            self.assertIn(f"process {long.pid} is at it", refused.stderr)
        finally:
            long.kill()
            long.wait()
        before = content(path).count(b"\n")
        self.assertEqual(self.league("a").returncode, 0)
        self.assertEqual(content(path).count(b"\n"), before)
        self.assertEqual(json.loads(content(self.file("a"), "league.json"))["matches"], 4)

    def test_another_league_is_refused_in_its_directory(self):
        self.assertEqual(self.league("a").returncode, 0)
        result = self.league("a", "--seed", "9")
        self.assertEqual(result.returncode, 2)
        self.assertIn("matches.jsonl", result.stderr)

    def test_wrong_use_is_refused_in_words(self):
        for teams in ("rules", "rules,rules", "rules,nobody"):
            result = sil("league", "--teams", teams, "-o", self.file("x"))
            self.assertEqual(result.returncode, 2, teams)
            self.assertIn("--teams", result.stderr)


if __name__ == "__main__":
    unittest.main()
