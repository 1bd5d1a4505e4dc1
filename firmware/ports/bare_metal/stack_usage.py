#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The worst-case stack of a bare-metal image: the compiler's frame sizes over the call graph that the image has.

Frame sizes come from GCC's -fcallgraph-info=su files (of the library's assembly: from its pushes); calls from the
disassembly of what was linked. Refuses recursion, dynamic frames and indirect calls, as no bound would hold.
"""

import argparse
import bisect
import glob
import os
import re
import subprocess
import sys

# What the hardware pushes when it takes an interrupt: eight words, and one to align them; with the floating-point
# registers, 18 words more (Armv8-M Architecture Reference Manual, "Exception entry").
EXCEPTION_FRAME_BYTES = 36
FLOAT_FRAME_BYTES = 72

LABEL = re.compile(r"^([0-9a-f]+) <(.+)>:$")
INSTRUCTION = re.compile(r"^\s*[0-9a-f]+:\t(\S+)\s*(.*)$")
TARGET = re.compile(r"([0-9a-f]+) <[^>]*>$")
BRANCHES = re.compile(r"^(b|bl|blx|bx|b(eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le))$")


class StackError(Exception):
    """No bound can be given."""


def compiler_frames(build_dir):
    frames = {}
    for path in glob.glob(os.path.join(build_dir, "**", "*.ci"), recursive=True):
        with open(path, encoding="utf-8") as text:
            for title, label in re.findall(r'node: \{ title: "([^"]+)" label: "([^"]*)"', text.read()):
                size = re.search(r"(\d+) bytes \((\w+)\)", label)
                if size:
                    name = title.rsplit(":", 1)[-1] if ".cpp:" in title or ".hpp:" in title else title
                    frames[name] = max(frames.get(name, (0, ""))[0], int(size[1])), size[2]
    return frames


def pushed_bytes(mnemonic, operands):
    if mnemonic.startswith(("push", "vpush")) or mnemonic.startswith("stmdb") and operands.startswith("sp!"):
        names = operands[operands.index("{") + 1:operands.index("}")].split(",")
        each = 8 if names[0].strip().startswith("d") else 4
        count = 0
        for name in names:
            ends = [int(end) for end in re.findall(r"\d+", name)] if "-" in name else [0, 0]
            count += ends[1] - ends[0] + 1
        return each * count
    if mnemonic.startswith("sub") and (found := re.match(r"sp, (?:sp, )?#(\d+)", operands)):
        return int(found[1])
    if mnemonic.startswith("str") and (found := re.search(r"\[sp, #-(\d+)\]!", operands)):
        return int(found[1])
    return 0


def read_image(image):
    """Each function's own pushes and callees."""
    text = subprocess.run(["arm-none-eabi-objdump", "-d", "--no-show-raw-insn", image], check=True,
                          capture_output=True, text=True).stdout
    functions, name = {}, None
    for line in text.splitlines():
        if label := LABEL.match(line):
            if not label[2].startswith(("$", ".")):
                name = label[2]
                functions[name] = {"at": int(label[1], 16), "pushes": 0, "targets": set(), "indirect": [],
                                   "called_at": set()}
        elif name and (found := INSTRUCTION.match(line)):
            mnemonic, operands = found[1].removesuffix(".w").removesuffix(".n"), found[2]
            function = functions[name]
            function["pushes"] += pushed_bytes(mnemonic, operands)
            if BRANCHES.match(mnemonic):
                operands = operands.split("@")[0].strip()
                if target := TARGET.search(operands):
                    function["targets"].add(int(target[1], 16))
                    if mnemonic == "bl":
                        function["called_at"].add(int(target[1], 16))
                elif operands not in ("lr", "r14"):
                    function["indirect"].append(f"{mnemonic} {operands}")
    starts = sorted((function["at"], name) for name, function in functions.items())
    for name, function in functions.items():
        if function["at"] in function["called_at"]:
            raise StackError(f"recursion: {name} calls itself")
        callees = {starts[bisect.bisect_right(starts, (target, "\x7f")) - 1][1] for target in function["targets"]}
        function["calls"] = callees - {name}
    return functions


def worst(functions, frames, name, path=()):
    """(bytes, the path that takes them) from a function down."""
    if name in path:
        raise StackError(f"recursion: {' -> '.join(path + (name,))}")
    function = functions[name]
    if function["indirect"] and name != "reset":
        raise StackError(f"{name}: an indirect call, {function['indirect'][0]}, that nothing lists")
    if "result" not in function:
        own, kind = frames.get(name, (function["pushes"], "static"))
        if kind == "dynamic":
            raise StackError(f"{name}: a stack frame of no fixed size")
        deepest, chain = 0, ()
        for callee in sorted(function["calls"]):
            below, below_chain = worst(functions, frames, callee, path + (name,))
            if below > deepest:
                deepest, chain = below, below_chain
        function["result"] = own + deepest, (f"{name} {own}",) + chain
    return function["result"]


def interrupt_handlers(image, functions):
    """What a Cortex-M's vector table has for the tick and for interrupts, but for the fault of those that nobody handles."""
    text = subprocess.run(["arm-none-eabi-objdump", "-s", "-j", ".vectors", image], check=True, capture_output=True,
                          text=True).stdout
    table = b"".join(bytes.fromhex("".join(line[line.index(" ", 1):].split("  ")[0].split()))
                     for line in text.splitlines() if re.match(r"^ [0-9a-f]+ ", line))
    at = {function["at"]: name for name, function in functions.items()}
    entries = {int.from_bytes(table[i:i + 4], "little") & ~1 for i in range(4 * 15, len(table), 4)}
    return sorted({at[entry] for entry in entries if entry in at} - {"exception"})


def stack_usage(image, build_dir):
    """(bytes, path) of the image's worst case: from reset down, and the deepest of the interrupts, which do not nest, on top
    of the deepest point."""
    functions, frames = read_image(image), compiler_frames(build_dir)
    if not frames:
        raise StackError(f"{build_dir}: no .ci file; build with -fcallgraph-info=su")
    total, path = worst(functions, frames, "reset")
    if "start" in functions:  # the Cortex-R5's reset goes there by a register
        total, path = worst(functions, frames, "start")
    if "tick_interrupt" in functions:
        below = max(worst(functions, frames, name)[0] for name in interrupt_handlers(image, functions))
        has_floats = any("vpush" in line or "vldmia" in line for line in path) or "vldmia" in subprocess.run(
            ["arm-none-eabi-objdump", "-d", image], check=True, capture_output=True, text=True).stdout
        frame = EXCEPTION_FRAME_BYTES + (FLOAT_FRAME_BYTES if has_floats else 0)
        total, path = total + frame + below, path + (f"interrupt {frame + below}",)
    return total, path


def symbols(image):
    text = subprocess.run(["arm-none-eabi-nm", image], check=True, capture_output=True, text=True).stdout
    return {fields[2]: int(fields[0], 16) for fields in map(str.split, text.splitlines()) if len(fields) == 3}


def stack_room(image):
    """The stack that the image sets aside, in bytes."""
    found = symbols(image)
    return found["stack_top"] - found["stack_bottom"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("image", help="an .elf of firmware/ports")
    parser.add_argument("--build-dir", required=True, help="where it was built: its .ci files")
    parser.add_argument("--path", action="store_true", help="print the calls that take it")
    arguments = parser.parse_args()
    try:
        total, path = stack_usage(arguments.image, arguments.build_dir)
    except StackError as error:
        sys.exit(f"stack_usage: {arguments.image}: {error}")
    room = stack_room(arguments.image)
    if total > room:
        sys.exit(f"stack_usage: {arguments.image}: {total} bytes of stack, but the linker script sets {room} aside: "
                 "see STRIKER_CONTROLLER_STACK")
    print(f"worst-case stack: {total} bytes of {room}")
    if arguments.path:
        for step in path:
            print(f"  {step}")


if __name__ == "__main__":
    main()
