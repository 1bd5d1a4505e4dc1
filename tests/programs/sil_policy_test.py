#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""striker-sil kick --policy: a policy that no compiler saw plays as the compiled one does. Usage: sil_policy_test.py
BIN_DIRECTORY"""

import json
import os
import re
import subprocess
import sys
import unittest

import files_case

BIN = sys.argv.pop(1)
SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
EXPORTED = os.path.join(SOURCES, "firmware", "policy", "exported")
PAPER = os.path.join(SOURCES, "training", "configs", "paper.toml")


def run(program, *arguments):
    return subprocess.run([os.path.join(BIN, program), *arguments], capture_output=True, text=True, timeout=120)


class SilPolicy(files_case.FilesCase):
    def play(self, name, *arguments):
        """What a run leaves on the bus and in its summary."""
        result = run("striker-sil", "kick", "--episodes", "4", "--seed", "9", "--log", self.file(f"{name}.log"),
                     "--json", self.file(f"{name}.json"), *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.file(f"{name}.log"), encoding="ascii") as log:
            frames = log.read()
        with open(self.file(f"{name}.json"), encoding="utf-8") as stream:
            return frames, json.load(stream)

    def test_the_built_in_policys_header_is_the_built_in_policy_byte_for_byte(self):
        for options in (["--plant", "servo", "--pose", "anywhere"],
                        ["--vary", "mass=0.8,vision_noise_mm=3,command_delay_ms=10"]):
            expected, summary = self.play("built_in", *options)
            frames, read = self.play("read", "--policy", os.path.join(EXPORTED, "kick.hpp"), *options)
            self.assertEqual(frames, expected)
            self.assertEqual((read["rows"], read["policy"], read["policy_name"]),
                             (summary["rows"], summary["policy"], "kick"))

    def test_others_play_otherwise(self):
        built_in, _ = self.play("built_in")
        for name in ("kick_dqn", "aimed"):
            frames, summary = self.play(name, "--policy", os.path.join(EXPORTED, f"{name}.hpp"))
            self.assertNotEqual(frames, built_in)
            self.assertEqual(summary["policy_name"], name)

    def test_a_model_is_the_header_that_is_made_of_it(self):
        """Of one, two and three hidden layers."""
        for hidden, form in (("[64, 64]", "Policy<6, 64, 64, 3, 16> p"), ("[40]", "Policy1<6, 40, 3, 16> p"),
                             ("[24, 20, 16]", "Policy3<6, 24, 20, 16, 3, 16> p")):
            with self.subTest(hidden):
                trained = run("striker-train", "--config", PAPER, "--seed", "1", "--out", self.file("run"), "--force", "--set",
                              "run.episodes=100", "--set", "run.validation_episodes=0", "--set", f"network.hidden={hidden}")
                self.assertEqual(trained.returncode, 0, trained.stderr)
                model = self.file("run/model.safetensors")
                frames, summary = self.play("model", "--policy", model)
                self.assertEqual(run("striker-export", model, "-o", self.file("p.hpp")).returncode, 0)
                with open(self.file("p.hpp"), encoding="utf-8") as stream:
                    self.assertIn(f"inline constexpr {form} = ", stream.read())
                expected, header = self.play("header", "--policy", self.file("p.hpp"))
                self.assertEqual(frames, expected)
                self.assertEqual((summary["policy"], summary["policy_name"]), (header["policy"], "model"))

    def test_what_no_compiler_would_take_is_refused(self):
        with open(os.path.join(EXPORTED, "kick.hpp"), encoding="utf-8") as stream:
            header = stream.read()
        altered = re.sub(r"(\.biases = \{\{-?\d*)", r"\g<1>1", header, count=1)
        self.assertNotEqual(altered, header)
        slow = self.file("slow.toml", "body_mass_g = 1500\nwheel_mass_g = 100\nwheel_radius_um = 40000\naxle_length_um = "
                         "140000\ntorque_limit_mNm = 400\ntop_rim_speed_mm_s = 900\n")
        kick = os.path.join(EXPORTED, "kick.hpp")
        for arguments, said in (([self.file("a.hpp", altered)], "export the model again"),
                                ([self.file("b.hpp", header[:9000])], "damaged"),
                                ([self.file("c.hpp", "int main() {}\n")], "no policy is in it"),
                                ([self.file("d.safetensors", "nothing")], "striker-export made no header"),
                                ([self.file("none.hpp")], "none.hpp"),
                                ([kick, "--robot", slow], "top_rim_speed_mm_s = 900"),
                                ([kick, "--decisions", self.file("d.csv")], "--decisions"),
                                ([kick, "--bus", "can:vcan0"], "--policy")):
            result = run("striker-sil", "kick", "--episodes", "1", "--json", self.file("r.json"), "--policy", *arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(said, result.stderr)
            self.assertFalse(os.path.exists(self.file("r.json")))


if __name__ == "__main__":
    unittest.main(verbosity=2)
