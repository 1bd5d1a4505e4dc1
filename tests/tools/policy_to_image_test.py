#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tools/policy-to-image: from a file of weights to a proved image and its card, and what it says where there is no way.
Usage: policy_to_image_test.py SOURCES BUILD"""

import fcntl
import json
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest

SOURCES, BUILD = (os.path.abspath(sys.argv.pop(1)) for _ in range(2))


def write_model(path, hidden=16):
    """safetensors of a small network that nobody trained: its way is what matters here."""
    generator, header, data = random.Random(1), {}, b""
    for name, shape in (("0", (hidden, 6)), ("2", (hidden, hidden)), ("4", (3, hidden))):
        for tensor, size in ((f"{name}.weight", shape), (f"{name}.bias", shape[:1])):
            count = size[0] * (size[1] if len(size) == 2 else 1)
            raw = struct.pack(f"<{count}f", *(generator.gauss(0, 0.3) for _ in range(count)))
            header[tensor] = {"dtype": "F32", "shape": list(size), "data_offsets": [len(data), len(data) + len(raw)]}
            data += raw
    text = json.dumps(header).encode()
    with open(path, "wb") as stream:
        stream.write(struct.pack("<Q", len(text)) + text + data)


class PolicyToImage(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = directory.name
        self.model, self.out = os.path.join(self.directory, "small.safetensors"), os.path.join(self.directory, "the images")
        write_model(self.model)

    def run_tool(self, model, board="mps2-an386", *more):
        return subprocess.run([os.path.join(SOURCES, "tools", "policy-to-image"), model, "--board", board, "--build", BUILD,
                               "--episodes", "20", "-o", self.out, *more], capture_output=True, text=True, check=False)

    def test_the_whole_way(self):
        result = self.run_tool(self.model)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        with open(os.path.join(self.out, "small.json"), encoding="utf-8") as stream:
            card = json.load(stream)
        self.assertEqual((card["name"], card["board"], card["episodes"]), ("small", "mps2-an386", 20))
        # A multiply-accumulate is between a half and four instructions of a Cortex-M4F.
        products = 6 * 16 + 16 * 16 + 16 * 3
        self.assertTrue(0.5 * products < card["inference_instructions"] < 4 * products, card)
        steps = [card[name] for name in ("inference_instructions", "longest_step_found", "proved_step", "step_limit")]
        self.assertEqual(sorted(steps), steps)
        self.assertLess(abs(card["float_reward"] - card["bus_reward"]), card["float_ci95"])
        self.assertLess(abs(card["integer_reward"] - card["integer_against"]), card["float_ci95"])
        self.assertGreater(card["agreement"], 0.98)
        for part in ("flash_bytes", "ram_bytes", "stack_bytes"):
            self.assertTrue(500 < card[part] < 100_000, card)
        self.assertTrue(os.path.exists(card["image"]))
        with open(os.path.join(self.out, "small.hpp"), encoding="utf-8") as stream:
            self.assertIn(card["identity"].lower(), stream.read().lower())
        for said in (f"small: policy {card['identity']}", *(f"mean reward {card[f'{station}_reward']:.3f}"
                                                            for station in ("float", "integer", "bus")),
                     f"{card['proved_step']:,} proved", f"{card['flash_bytes']:,}", f"{card['agreement']:.2%}",
                     f"{card['inference_instructions']:,} instructions", card["image"]):
            self.assertIn(said, result.stdout)

    def test_what_leads_nowhere_is_told_and_leaves_no_card(self):
        nothing = os.path.join(self.directory, "nothing.safetensors")
        with open(nothing, "wb") as stream:
            stream.write(b"\0" * 100)
        upper = os.path.join(self.directory, "Small-1.safetensors")
        os.rename(self.model, upper)
        for arguments, said in (((nothing,), r"nothing.safetensors: .*safetensors"), ((upper,), "'Small-1' cannot be"),
                                ((self.directory + "/none.safetensors",), "no such model"), ((nothing, "z80"), "z80"),
                                ((nothing, "mps2-an386", "--build", self.directory), "boards.json|no .*bin")):
            result = self.run_tool(*arguments)
            self.assertNotEqual(result.returncode, 0, arguments)
            self.assertTrue(re.search(said, result.stderr), result.stderr)
            self.assertNotIn("Traceback", result.stderr)
            self.assertFalse(os.path.exists(os.path.join(self.out, "nothing.json")))

    def test_a_folder_that_cannot_be_is_told(self):
        in_the_way = os.path.join(self.directory, "file")
        with open(in_the_way, "wb"):
            pass
        for out in (in_the_way, os.path.join(in_the_way, "below"), "/proc/striker"):
            result = self.run_tool(self.model, "mps2-an386", "-o", out)
            self.assertRegex(result.stderr, f"policy-to-image: {out}: .*; give a folder that can be written with --out\n$")
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1))

    def test_a_path_that_a_linker_takes_apart_is_told_before_anything_is_made(self):
        for name in ("a,b", "a$b", "a'b", 'a"b', "a;b", "a\nb"):
            out = os.path.join(self.directory, name)
            result = self.run_tool(self.model, "mps2-an386", "-o", out)
            self.assertEqual(result.returncode, 2)
            self.assertIn("take such a path apart", result.stderr)
            self.assertFalse(os.path.exists(out))

    def test_a_second_one_in_the_same_folder_waits_for_nobody(self):
        os.mkdir(self.out)
        folder = os.open(self.out, os.O_RDONLY)
        self.addCleanup(os.close, folder)
        fcntl.flock(folder, fcntl.LOCK_EX)
        result = self.run_tool(self.model)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1))
        self.assertIn("another policy-to-image is at work", result.stderr)

    def test_a_policy_that_a_board_has_no_room_for(self):
        model = os.path.join(self.directory, "wide.safetensors")
        write_model(model, hidden=320)  # 205 KB of weights
        result = self.run_tool(model, "microbit")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr.splitlines()[-1], "^policy-to-image: microbit: its flash is [0-9,]+ bytes too small for striker-")
        self.assertLess(len(result.stderr), 3000)
        self.assertFalse(os.path.exists(os.path.join(self.out, "wide.json")))


if __name__ == "__main__":
    unittest.main(verbosity=2)
