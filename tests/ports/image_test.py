#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the images for one board and holds them, on its emulation, to the host's answers and to limits.json."""

import json
import os
import re
import subprocess
import sys

import qemu_image

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "firmware", "ports", "bare_metal"), os.path.join(ROOT, "tools")]

import stack_usage  # noqa: E402
from step_bound import analysis  # noqa: E402
from step_bound.refusal import Refusal  # noqa: E402

# The network that limits.json is for, 6-64-64-3: others may take as much for each multiply-accumulate, a neuron counting as
# some of them, and a quarter more.
MULTIPLY_ACCUMULATES = 6 * 64 + 64 * 64 + 64 * 3
NEURONS = 64 + 64 + 3
A_NEURON = 12


def build(board, policy, build_dir, targets=("all",)):
    for command in (
        ["cmake", "-G", "Ninja", "-S", ROOT, "-B", build_dir, "-DCMAKE_BUILD_TYPE=Release", f"-DSTRIKER_BOARD={board['name']}",
         f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/firmware/ports/arm-none-eabi.cmake", f"-DSTRIKER_POLICY={policy}"],
        ["cmake", "--build", build_dir, "--target", *targets],
    ):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise qemu_image.ImageError(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")


def image(build_dir, name):
    return os.path.join(build_dir, "bin", f"striker-{name}.elf")


def inference_limit(board, macs, policy):
    """limits.json's for the board's processor, or in proportion for another network: of an inference, of a step. The step's
    is 1 % above what tools/step-bound proves of the paper's network."""
    with open(os.path.join(HERE, "limits.json"), encoding="utf-8") as text:
        limits = json.load(text)[board["cpu"]]
    with open(policy, encoding="utf-8") as stream:
        text = stream.read()
    form = "_int8" if ", std::int8_t> " in text else ""
    inference = limits["inference" + form]
    if macs != MULTIPLY_ACCUMULATES:
        sizes = [int(size) for size in re.search(r"constexpr Policy[13]?<([0-9, ]*[0-9])", text)[1].split(", ")]
        work = macs + A_NEURON * sum(sizes[1:-1])  # without the inputs and the golden vectors
        inference = inference * work * 5 // ((MULTIPLY_ACCUMULATES + A_NEURON * NEURONS) * 4)
    return inference, limits["step" + form] + max(0, inference - limits["inference" + form])


def proved_step(bench):
    return analysis.Analysis(bench, late=analysis.delays_commands(bench)).bound().total


# A heap, floating point, or exceptions.
FORBIDDEN = re.compile(r"^(malloc|calloc|realloc|free|_sbrk|_?malloc_r|_Zn[wa].*|_Zd[la].*|__cxa_.*|_Unwind_.*"
                       r"|__aeabi_[cfd](f|d|add|sub|mul|div|cmp|2|r).*|__aeabi_(u?[il]2[fd]|f2.*|d2.*))$")


def expect(holds, text):
    print(("ok: " if holds else "FAILED: ") + text)
    return holds


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--policy", required=True)
    parser.add_argument("--host", required=True, help="the check program, built for the host")
    parser.add_argument("--recording", help="a run of the simulator with this policy")
    parser.add_argument("--build-dir", required=True)
    parser.add_argument("--inputs", type=int, default=200)
    parser.add_argument("--search", type=int, default=20000)
    arguments = parser.parse_args()
    good = True
    try:
        board = qemu_image.read_board(arguments.boards, arguments.board)
        build(board, arguments.policy, arguments.build_dir)
        words = ["recording", arguments.recording] if arguments.recording else []
        host = subprocess.run([arguments.host] + words, capture_output=True, text=True, check=True).stdout
        target = qemu_image.run(board, image(arguments.build_dir, "check"), words)
        print(target, end="")
        good &= expect(target == host, "the same answers as on the host, to the letter")

        measured = qemu_image.numbers(qemu_image.run(
            board, image(arguments.build_dir, "bench"),
            ["inputs", arguments.inputs, "search", arguments.search, "seed", 2]))
        least, greatest = measured["inference min"], measured["inference max"]
        limit, step_limit = inference_limit(board, measured["multiply-accumulates"], arguments.policy)
        good &= expect(least == greatest, f"{least} to {greatest} instructions an inference, whatever the input")
        good &= expect(greatest <= limit, f"{greatest} instructions an inference, of {limit}")
        longest = measured["search max"]
        proved = proved_step(image(arguments.build_dir, "bench"))
        good &= expect(longest <= proved <= step_limit, f"{longest} instructions in the longest step found, {proved} proved, of {step_limit}")
        good &= expect(measured["search decisions"] > 0, f"{measured['search decisions']} steps decided")

        controller = image(arguments.build_dir, "controller")
        bound, path = stack_usage.stack_usage(controller, arguments.build_dir)
        room = stack_usage.stack_room(controller)
        forbidden = [name for name in stack_usage.symbols(controller) if FORBIDDEN.match(name)]
        good &= expect(not forbidden, f"no heap, float helper or exception in the image: {forbidden}")
        good &= expect(bound <= room, f"worst-case stack {bound} bytes, of {room}: {' > '.join(path)}")
    except (qemu_image.ImageError, stack_usage.StackError, Refusal) as error:
        sys.exit(f"image_test: {error}")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
