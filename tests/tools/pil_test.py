#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tools/pil from outside: boards give the kicks of the run in one process, and nothing is left behind.
Usage: pil_test.py BUILD_FOLDER [TEST...]"""

import contextlib
import io
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

BUILD = sys.argv.pop(1)
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tools"))

import pil_compare  # noqa: E402

PIL = os.path.join(ROOT, "tools", "pil")
INTERRUPTED = 130


def started_with(text):
    """The command lines of this machine's processes that have the text in them."""
    found = []
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/cmdline", "rb") as file:
                line = file.read().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if text in line and int(process) != os.getpid():
            found.append(line)
    return found


class Pil(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.out = os.path.join(directory.name, "out")

    def command(self, *arguments):
        return [PIL, "--no-sil-build", "--build-dir", BUILD, "--out", self.out, *arguments]

    def test_zcu102_r5_on_its_can_gives_the_same_bytes(self):
        self.gives_the_same_bytes("zcu102-r5")

    def test_mps2_an386_over_slcan_gives_the_same_bytes(self):
        self.gives_the_same_bytes("mps2-an386")

    def test_mps2_an500_over_slcan_gives_the_same_bytes(self):
        self.gives_the_same_bytes("mps2-an500")

    def test_netduinoplus2_over_slcan_gives_the_same_bytes(self):
        self.gives_the_same_bytes("netduinoplus2")

    def gives_the_same_bytes(self, board):
        done = subprocess.run(self.command("--board", board, "--episodes", "2"), capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        print(done.stdout)
        for row in ("actions", "wheel commands", "rewards", "frames"):
            self.assertRegex(done.stdout, rf"(?m)^  {row} +[1-9][\d,]* +[1-9][\d,]* +the same, byte for byte$")
        deep, bound, room = map(int, re.search(r"stack +([\d,]+) bytes deep, computed bound ([\d,]+), of ([\d,]+)",
                                               done.stdout).expand(r"\1 \2 \3").replace(",", "").split())
        self.assertLessEqual(deep, bound)
        self.assertLessEqual(bound, room)

    def test_the_r5_withstands_faults(self):
        done = subprocess.run(self.command("--faults"), capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(re.findall(r"(?m)^ok: ([^:]*)", done.stdout),
                         ["vision lost", "corrupt frames", "babble on WheelState", "SYNC lost", "reset in mid-run", "altered weights",
                          "bus-off", "undefined instruction", "stack overflow"])

    def test_an_interrupt_ends_everything(self):
        with subprocess.Popen(self.command("--episodes", "60"), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as run:
            for _ in range(3000):
                if os.path.exists(os.path.join(self.out, "pil.log.part")):
                    break
                time.sleep(0.1)
            else:
                run.terminate()
                self.fail("it did not come to play within 300 s")
            run.send_signal(signal.SIGINT)
            told, _ = run.communicate(timeout=60)
        self.assertEqual(run.returncode, INTERRUPTED, told)
        time.sleep(1)
        self.assertEqual(started_with(self.out), [])

    def compared(self, line, reward):
        """Two runs of three frames, the second with another third frame and reward; what is said, and the verdict."""
        os.makedirs(self.out, exist_ok=True)
        begin = "(0000000000.001000) vcan0 050#0102030405060708\n(0000000000.001000) vcan0 110#01\n"
        for name, last, paid in (("sil", "(0000000000.002000) vcan0 050#0102030405060708", 1.5), ("pil", line, reward)):
            with open(os.path.join(self.out, f"{name}.log"), "w", encoding="ascii") as log:
                log.write(begin + last + "\n" if last else begin)
            with open(os.path.join(self.out, f"{name}.json"), "w", encoding="utf-8") as file:
                json.dump({"rows": [{"reward": paid}]}, file)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            same = pil_compare.compare(self.out, "sil", "pil")
        return said.getvalue(), same

    def test_the_first_difference_is_told(self):
        said, same = self.compared("(0000000000.002000) vcan0 050#0102030405060708", 1.5)
        self.assertTrue(same, said)
        for line, reward, rows in (("(0000000000.002000) vcan0 050#0102030405060709", 1.5, {"wheel commands", "frames"}),
                                   ("(0000000000.002001) vcan0 050#0102030405060708", 1.5, {"wheel commands", "frames"}),
                                   ("", 1.5, {"wheel commands", "frames"}),
                                   ("(0000000000.002000) vcan0 050#0102030405060708", 1.25, {"rewards"})):
            said, same = self.compared(line, reward)
            self.assertFalse(same, said)
            self.assertEqual(set(re.findall(r"(?m)^  (\w+(?: \w+)*) .*DIFFERENT", said)), rows)
        self.assertRegex(said, r"rewards .* DIFFERENT, first at 0: 1.5 \| 1.25")

    def test_wrong_use_is_told(self):
        for arguments, told in ((("--board", "mps2-an999"), "'mps2-an999' is none of"), (("--episodes", "0"), "--episodes goes from 1"),
                                (("--seed", "-1"), "--seed goes from 0")):
            done = subprocess.run(self.command(*arguments), capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(told, done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
