#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Breaks the kernel's promises one by one, in a copy of the sources, and requires that a test notices each time, and says
why. That it passes on the sound sources is seen first, but for the images: those are tests of their own, Image.BOARD."""

import argparse
import functools
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
POLICY = "firmware/policy/exported/kick.hpp"
PILOT = "firmware/core/pilot.hpp"
NODE = "firmware/loop/built_in_node.cpp"  # what instantiates the pilot of the built-in policy
ARGMAX = "firmware/policy/kernel/argmax.hpp"
BRANCH_FREE = "firmware/policy/kernel/branch_free.hpp"

BRANCHING_RELU = """constexpr std::int32_t saturate_relu(std::int32_t value) {
  if (value < 0) {
    return 0;
  }
  return value > greatest_activation ? greatest_activation : value;
}"""


def shell(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


def altered_headers(copy, _):
    return shell(f"{copy}/tests/policy/altered_header_test.sh", copy, f"{copy}/{POLICY}")


def compiles(copy, _):
    return shell("g++", "-std=c++20", "-fsyntax-only", f"-I{copy}", f'-DSTRIKER_POLICY_HEADER="{copy}/{POLICY}"', "-DSTRIKER_POLICY_NAME=kick",
                 f"{copy}/{NODE}")


def host_instructions(copy, _):
    probe = f"{copy}/probe"
    built = shell("g++", "-std=c++20", "-O2", f"-I{copy}", f'-DSTRIKER_POLICY_HEADER="{copy}/{POLICY}"', "-DSTRIKER_POLICY_NAME=kick",
                  f"{copy}/tests/policy/kernel_probe.cpp", "-o", probe)
    return built if built.returncode != 0 else shell(f"{copy}/tests/policy/kernel_instructions_test.sh", probe)


@functools.cache
def image(board):
    def test(copy, arguments):
        return shell(f"{copy}/tests/ports/image_test.py", "--board", board, "--boards",
                     arguments.boards, "--policy", f"{copy}/{POLICY}", "--host",
                     arguments.host, "--recording", arguments.recording, "--build-dir", f"{copy}/build-{board}",
                     "--search", "2000")
    test.seen_elsewhere = True
    return test


# What is broken, where, what is replaced by what (regular expression), and the test that has to notice.
MUTATIONS = (
    ("the overflow proof is not asserted", PILOT, r"static_assert\(policy::sums_fit\(\w+\)", "static_assert(true",
     altered_headers),
    ("the identity is not asserted", PILOT, r"static_assert\(policy::identity_of\(\w+\) == \w+\.identity",
     "static_assert(true", altered_headers),
    ("a golden vector is gone", POLICY, r"(, )16(> kick)([\s\S]*)\n +\{\.raw = [\s\S]*?\},\n(    \}\},\n\};)",
     r"\g<1>15\2\3\n\4", compiles),
    ("argmax branches", ARGMAX, r"const std::int32_t greater = less_mask\(best, sums\[k\]\);",
     'const std::int32_t greater = less_mask(best, sums[k]);\n    if (greater != 0) {\n      asm volatile("nop");\n    }',
     host_instructions),
    ("ReLU branches on the Cortex-M0+", BRANCH_FREE, r"constexpr std::int32_t saturate_relu\([\s\S]*?\n\}", BRANCHING_RELU,
     image("microbit")),
    ("two weights change places on the Cortex-M4", "firmware/policy/kernel/int16/armv7em.hpp",
     r"half_words\(weight_or_zero\(layer, row, 2 \* p \+ 1\), layer\.weights\[row\]\[2 \* p\]\)",
     "half_words(layer.weights[row][2 * p], weight_or_zero(layer, row, 2 * p + 1))", image("mps2-an386")),
    ("two rows of int8 weights change places on the Cortex-M4", "firmware/policy/kernel/int8/armv7em.hpp",
     r"byte\(0, 0\) \| byte\(1, 0\)", "byte(1, 0) | byte(0, 0)", image("mps2-an386")),
)


def copy_sources(to):
    for name in ("firmware", "tests", "tools", "CMakeLists.txt", "CMakePresets.json"):
        source = os.path.join(ROOT, name)
        (shutil.copytree if os.path.isdir(source) else shutil.copy)(source, os.path.join(to, name))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--host", required=True, help="the check program, built for the host")
    parser.add_argument("--recording", required=True)
    parser.add_argument("--boards", required=True, help="boards.json, of the host's build folder")
    arguments = parser.parse_args()
    good = True
    sound_results = {}
    with tempfile.TemporaryDirectory() as copy:
        copy_sources(copy)
        for name, file, old, new, test in MUTATIONS:
            path = os.path.join(copy, file)
            with open(path, encoding="utf-8") as text:
                sound = text.read()
            broken, changes = re.subn(old, new, sound, count=1)
            if changes != 1:
                sys.exit(f"mutation_test: {name}: nothing to change in {file}")
            if test not in sound_results and not hasattr(test, "seen_elsewhere"):
                sound_results[test] = test(copy, arguments)
            before = sound_results.get(test)
            with open(path, "w", encoding="utf-8") as text:
                text.write(broken)
            after = test(copy, arguments)
            with open(path, "w", encoding="utf-8") as text:
                text.write(sound)
            reason = [line for line in (after.stdout + after.stderr).splitlines()
                      if re.search("FAILED|STRIKER POLICY|compiled|but random|error|no readable|ended with status", line)]
            noticed = after.returncode != 0 and bool(reason) and (before is None or before.returncode == 0)
            good &= noticed
            print(("noticed: " if noticed else "NOT NOTICED: ") + name, flush=True)
            print(f"  {reason[0][:160] if reason else ''}", flush=True)
            if before is not None and before.returncode != 0:
                print(f"  the test fails on the sound sources too:\n{before.stdout}{before.stderr}")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
