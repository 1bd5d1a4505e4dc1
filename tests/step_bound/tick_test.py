#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The whole tick of a controller's image is bounded, above its step; without a fact about the port it is refused with its place; and the arithmetic of the response time, by
an example that can be reckoned by hand. The flow facts for OTAWA are well formed, and have each loop's number."""

import json
import os
import re
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "tools"), os.path.join(ROOT, "tests", "ports")]
sys.dont_write_bytecode = True

import image_test  # noqa: E402
import qemu_image  # noqa: E402
from step_bound import analysis, cycles as cycles_of, ffx, instruction, tick  # noqa: E402
from step_bound.cycles import ARCHITECTURES  # noqa: E402
from step_bound.functions import Block  # noqa: E402
from step_bound.refusal import Refusal  # noqa: E402

failed = 0


def expect(holds, text):
    global failed
    failed += not holds
    print(("ok: " if holds else "FAILED: ") + text)


def refusal_of(call):
    try:
        call()
    except Refusal as refusal:
        return str(refusal)
    return "was not refused"


def check_response_times():
    # 40 us of work; 10 us every 50, 5 us every 20: 40 + 10 + 2 * 5 + ... = 40, 60, 75, 80, 80.
    expect(tick.response_us(40, [(50, 10), (20, 5)]) == 80, "40 us between interrupts of 10 every 50 and 5 every 20 take 80")
    expect(tick.response_us(40, []) == 40, "without interrupts they take 40")
    expect("more time than there is" in refusal_of(lambda: tick.response_us(1, [(10, 6), (10, 5)])), "interrupts that fill all the time are refused")
    expect("--every spi=" in refusal_of(lambda: tick.periods(["spi"], {})), "an interrupt that is not known is refused")
    expect("no such interrupt" in refusal_of(lambda: tick.periods([], {"spi": 7.0})), "so is one that is not there")
    expect(tick.periods(["spi"], {"spi": 7.0}) == {"spi": 7.0}, "or told")


def check_cycles():
    """The examples of DDI 0337I, "Load/store timings", and what it says of the rest."""
    for text, cycles in (("ldr r0, [r1]; ldr r1, [r2]", 3), ("ldr r0, [r1, r2]; str r0, [r3, #20]", 3), ("ldr r0, [r1, r5]; ldr r1, [r2]; ldr r2, [r3, #4]", 4),
                         ("ldr r0, [r1]; ldr r2, [r0]", 4), ("add r1, r1, #4; ldr r0, [r1]", 4), ("str r0, [r1, #4]", 1), ("str r0, [r1, #4]; str r2, [r1, #8]", 3),
                         ("str r0, [r1, #4]; ldr r2, [r1, #8]", 3), ("str r0, [r1, r2]; ldr r3, [r4]", 4), ("ldr r0, [r1], #4; ldr r2, [r3]", 4), ("ldr r0, [pc, #8]", 3),
                         ("ldr r0, [r1]; ldr pc, [r2]", 7), ("tbb [pc, r0]", 6), ("sub sp, sp, #8; push {r0, r1}", 5), ("dsb", 4)):
        lines = [line.split(" ", 1) for line in text.split("; ")]
        insns = [instruction.parse(2 * i, 2, line[0], line[1] if len(line) > 1 else "") for i, line in enumerate(lines)]
        found = cycles_of.Cycles("cortex-m3").block(Block(0, insns))
        expect(found == cycles, f"{text}: {found} cycles")


def check_wrong_use(image):
    for words, text in ((["--all", "--ffx", "x"], "--ffx"), ([image, "--tick", "--missed", "-1"], "--missed"), ([image, "--tick", "--every", "spi"], "--every"),
                        ([image, "--tick", "--every", "spi=0"], "--every"), ([image, "--tick", "--every", "spi=nan"], "--every"), ([image, "--every", "spi=7"], "--tick"),
                        ([image, "--clock-mhz", "0"], "--clock-mhz"), ([image, "--clock-mhz", "nan"], "--clock-mhz"), ([image, "--wait-states", "-1"], "--wait-states"),
                        ([image, "--frames", "100000000000"], "--frames"), ([image, "--root", "("], "--root")):
        done = subprocess.run([os.path.join(ROOT, "tools", "step-bound"), *words], capture_output=True, text=True, check=False)
        expect(done.returncode == 2 and text in done.stderr, f"{' '.join(words[-2:])}: {done.stderr.splitlines()[-1]}")
    done = subprocess.run([os.path.join(ROOT, "tools", "step-bound"), "--all", "--root", "no_such_function"], capture_output=True, text=True, check=False)
    told = [name for name in ("microbit", "mps2-an386", "stm32f405", "zcu102-r5") if name in done.stderr]
    expect(done.returncode == 1 and len(told) == 4, f"--all names each image that is refused: {', '.join(told)}")


def check_wrong_images():
    with tempfile.TemporaryDirectory() as folder:
        for name, words, text in (("object.o", ["-mcpu=cortex-m4"], "linked image"), ("big.elf", ["-mcpu=cortex-m4", "-mbig-endian", "-nostdlib", "-Wl,-e,0"], "little endian"),
                                  ("empty.elf", ["-mcpu=cortex-m4", "-nostdlib", "-Wl,-e,0"], "no code")):
            path = os.path.join(folder, name)
            subprocess.run(["arm-none-eabi-gcc", *words, *(["-c"] if name.endswith(".o") else []), "-x", "c", "/dev/null", "-o", path], check=True)
            told = refusal_of(lambda path=path: analysis.Analysis(path))
            expect(text in told, f"{name}: {told.replace(folder, '')}")


def check_vectors(found):
    """Each interrupt has to lead to a function: none is left out in silence."""
    image = found.program.image
    tables, functions = image.sized_objects, image.functions
    image.sized_objects = []
    expect(not image.has_vectors or "tables of interrupts" in refusal_of(lambda: tick.handlers(image)), "without its table it is refused")
    image.sized_objects, image.functions = tables, [function for function in functions if function[0] != "tick_interrupt"]
    expect(not image.has_vectors or "no function that is known" in refusal_of(lambda: tick.handlers(image)), "a handler without a name is refused")
    image.functions = functions
    expect("cortex-m0plus" in refusal_of(lambda: found.bound(24, "cortex-m0plus")) or image.architecture in ARCHITECTURES["cortex-m0plus"], "another processor's cycles are refused")


def without(fact):
    """The facts' file but for one, as text."""
    with open(analysis.FACTS, encoding="utf-8") as file:
        parts = re.split(r"^(?=\[)", file.read(), flags=re.MULTILINE)
    left = [part for part in parts if not part.startswith(f"[{fact}]")]
    assert len(left) == len(parts) - 1, fact
    return "".join(left)


def bound_without(image, fact):
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(without(fact))
        file.flush()
        return analysis.Analysis(image, tick.TURN, facts=file.name).bound(24)


def check_tick(image, cpu, interrupts, needed):
    late = analysis.delays_commands(image)
    whole = analysis.Analysis(image, tick.TURN, late)
    step = analysis.Analysis(image, late=late).bound(24).total
    total = whole.bound(24).total
    expect(step < total, f"{total:,} instructions a tick, of which a step is {step:,}")
    after_missed = analysis.Analysis(image, tick.TURN, late, missed=10).bound(24).total
    expect(total < after_missed, f"{after_missed:,} where 10 ticks were missed before it")
    check_vectors(whole)
    names = tick.handlers(whole.program.image)
    expect(names == interrupts, f"its interrupts are {', '.join(names) or 'none'}")
    for fact, place in needed.items():
        told = refusal_of(lambda fact=fact: bound_without(image, fact))
        expect("no bound, and no fact" in told and place in told, f"without [{fact}]: {told[:100]}")
    command = [os.path.join(ROOT, "tools", "step-bound"), image, "--cpu", cpu, "--tick", "--clock-mhz", "160"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    expect(done.returncode == 0 and f"{total:,} instructions" in done.stdout, f"tools/step-bound --tick says so: {done.stderr}")


def check_flow_facts(image):
    found = analysis.Analysis(image, late=analysis.delays_commands(image))
    bound = found.bound(24)
    root = ElementTree.fromstring(ffx.write(found, 24))
    seen = {}

    def visit(element, context):
        for child in element:
            at = int(child.get("address"), 16)
            if child.tag == "loop":
                seen[(context, at)] = child.get("maxcount")
            elif child.tag == "call":
                visit(child, context + (at,))
            elif child.tag == "function":
                visit(child, context)
    visit(root, ())
    tags = {(parent.tag, child.tag) for parent in root.iter() for child in parent}
    allowed = {("flowfacts", "multibranch"), ("multibranch", "target"), ("flowfacts", "noreturn"), ("flowfacts", "function"), ("function", "loop"),
               ("function", "call"), ("call", "function")}
    expect(tags <= allowed, f"{len(seen)} loops for OTAWA, of elements that it knows")
    missing = [key for key, turns in bound.turns.items() if seen.get((key[0], key[1] & ~1)) != str(turns)]
    expect(not missing, f"each with its number: {missing[:2]}")


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--images", required=True, help="the board's build folder")
    parser.add_argument("--policy", help="build the controller there, with this one")
    parser.add_argument("--interrupt", action="append", default=[], help="that the board has; may be repeated")
    parser.add_argument("--needs", action="append", default=[], metavar="FACT=FUNCTION", help="a fact without which FUNCTION is refused; may be repeated")
    arguments = parser.parse_args()
    with open(arguments.boards, encoding="utf-8") as file:
        board = next(board for board in json.load(file) if board["name"] == arguments.board)
    if arguments.policy:
        image_test.build(board, arguments.policy, arguments.images, ("striker-controller",))
    check_response_times()
    check_cycles()
    check_wrong_use("image.elf")
    check_wrong_images()
    check_tick(os.path.join(arguments.images, "bin", "striker-controller.elf"), board["cpu"], sorted(arguments.interrupt),
               dict(need.split("=") for need in arguments.needs))
    bench = os.path.join(arguments.images, "bin", "striker-bench.elf")
    if os.path.exists(bench):
        check_flow_facts(bench)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
