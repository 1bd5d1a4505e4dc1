#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The analyser on small programs, each compiled for three instruction sets at three levels of optimisation: the bound is what QEMU counts
on the program's longest run, or within the looseness that is stated here, or the program is refused for the stated reason."""

import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "tools"), os.path.join(ROOT, "tests", "ports")]
sys.dont_write_bytecode = True

import qemu_trace  # noqa: E402
from small_programs import CORES, LEVELS, PROGRAMS  # noqa: E402
from step_bound import abstract_execution, analysis  # noqa: E402
from step_bound.bound import Bound  # noqa: E402
from step_bound.facts import Fact, parse_chain, parse_chains  # noqa: E402
from step_bound.functions import Program  # noqa: E402
from step_bound.image import Image  # noqa: E402
from step_bound.refusal import Refusal  # noqa: E402
from trace_checker import Checker, Contradiction, Walker  # noqa: E402

START = """
.syntax unified
.thumb
.section .vectors, "a"
.word stack_top
.word reset + 1
.text
.thumb_func
.type reset, %function
.global reset
reset:
  ldr r0, =0xe000ed88  @ CPACR: where there are coprocessors, Helium is one
  ldr r1, =0x00f00000
  str r1, [r0]
  dsb
  isb
  bl main
  ldr r1, =0x20026
  movs r0, #0x18
  bkpt 0xab
.size reset, . - reset
"""

SCRIPT = """
MEMORY {{ ROM (rx) : ORIGIN = {rom}, LENGTH = 256K  RAM (rwx) : ORIGIN = {ram}, LENGTH = 16K }}
SECTIONS {{
  .text : {{ KEEP(*(.vectors)) *(.text*) *(.rodata*) }} > ROM
  .data : {{ *(.data*) *(.bss*) *(COMMON) }} > RAM
  stack_top = ORIGIN(RAM) + LENGTH(RAM);
}}
"""


def compile_program(folder, core, level, source):
    """The image, and a board for qemu_trace."""
    def write(name, text):
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    image = os.path.join(folder, "program.elf")
    subprocess.run(["arm-none-eabi-gcc", f"-mcpu={core['cpu']}", "-mthumb", *core["flags"], level, "-ffreestanding", "-nostartfiles", "-static",
                    "-Wl,--no-warn-rwx-segments", "-T", write("script.ld", SCRIPT.format(**core)), write("start.s", START), write("program.c", source),
                    "-o", image], check=True, capture_output=True, text=True)
    return image, {"name": core["cpu"], "qemu": {"system": "qemu-system-arm", "machine": core["machine"], "power_on": None,
                                                 "arguments": ["-kernel", "{image}"]}}


def facts_of(program):
    return [Fact(f"fact {i}", kind, [parse_chain(chain)], most, parse_chains(more.get("plus", [])), "of the program", "QEMU",
                 contexts=more.get("contexts", 0), more=more.get("more", 1))
            for i, (kind, chain, most, more) in enumerate((*fact, {})[:4] for fact in program.get("facts", ()))]


def bound_of(image, program):
    found = Program(Image(image))
    root = found.find("^work$")
    found.reachable(root)
    return Bound(found, root, abstract_execution.run(found, root, aligned_arguments=False), facts_of(program)), root


def run(image, board, bound, root):
    """The longest call of `work`, every call held to the bound's graph."""
    checker = Checker(bound)
    spans = [(0, 0x20000000)]
    with qemu_trace.traced(board, image, [], spans) as lines:
        for instructions, edges in Walker(bound, root).calls(qemu_trace.blocks(lines, bound.program.instructions)):
            checker.check(instructions, edges)
    return checker.longest


def examine(folder, name, program, core, level):
    image, board = compile_program(folder, core, level, program["source"])
    try:
        bound, root = bound_of(image, program)
    except Refusal as refusal:
        if any(reason in str(refusal) for reason in program.get("refused", ())):
            return None, f"refused: {str(refusal)[:90]}"
        return f"refused: {refusal}", ""
    if program.get("always_refused"):
        return "was not refused", ""
    try:
        longest = run(image, board, bound, root)
    except Contradiction as contradiction:
        return f"contradiction: {contradiction}", ""
    loose = bound.total - longest
    verdict = f"proved {bound.total}, ran {longest}"
    return (None if 0 <= loose <= program.get("loose", 0) * max(longest, 1) else verdict), verdict


def check_root(folder):
    """The arguments of a function that --root names may be any numbers."""
    program = PROGRAMS["remainder"]
    image, _ = compile_program(folder, CORES[0], "-O1", program["source"])
    totals = analysis.Analysis(image, "^work$").bound().total, bound_of(image, program)[0].total
    print(f"{'ok' if totals[0] == totals[1] else 'FAILED'}: as --root: {totals[0]} of {totals[1]} instructions")
    return totals[0] != totals[1]


def main():
    with tempfile.TemporaryDirectory() as folder:
        failed = int(check_root(folder))
        for core in CORES:
            for name, program in PROGRAMS.items():
                for level in LEVELS:
                    if program.get("only", core["cpu"]) != core["cpu"]:
                        continue
                    problem, verdict = examine(folder, name, program, core, level)
                    print(f"{'FAILED' if problem else 'ok'}: {core['cpu']} {level} {name}: {problem or verdict}", flush=True)
                    failed += problem is not None
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
