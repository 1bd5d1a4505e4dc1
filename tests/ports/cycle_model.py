# SPDX-License-Identifier: Apache-2.0
"""A cycle estimate from Arm's published instruction timings and an executed trace: zero wait states, no contention.

Tables: Cortex-M0+ Technical Reference Manual (DDI 0484C, table 3-1, fast multiplier), Cortex-M3 (DDI 0337I, table
3-1), Cortex-M4 (DDI 0439D, table 3-1). A taken branch refills the pipeline: those manuals give the M3 and M4 1 to 3
cycles for it, of which 2 are taken here. On the M3 and M4 a single load or store right after another one costs one
cycle less, as it is pipelined. Other processors' timings are not published by Arm as such tables.
"""

import os
import re
import subprocess
import tempfile

import qemu_image

MODELLED = ("cortex-m0plus", "cortex-m3", "cortex-m4")

DISASSEMBLY = re.compile(r"^\s*([0-9a-f]+):\t([a-z0-9.]+)\s*(.*)$")
TRACE = re.compile(r"^Trace \d+: 0x[0-9a-f]+ \[[0-9a-f]+/([0-9a-f]+)/")
GUEST_CODE = re.compile(r"^0x([0-9a-f]+):")


def symbol(image, pattern):
    """Address and size of the one symbol whose demangled name matches."""
    listing = subprocess.run(["arm-none-eabi-nm", "-CS", image], check=True, capture_output=True, text=True).stdout
    found = set()
    for line in listing.splitlines():
        fields = line.split(maxsplit=3)
        if len(fields) == 4 and re.search(pattern, fields[3]):
            found.add((int(fields[0], 16) & ~1, int(fields[1], 16)))
    if len(found) != 1:
        raise qemu_image.ImageError(f"{image}: {len(found)} symbols match {pattern}, but one was expected")
    return found.pop()


def disassemble(image, start, size):
    text = subprocess.run(
        ["arm-none-eabi-objdump", "-d", "--no-show-raw-insn", f"--start-address={start}",
         f"--stop-address={start + size}", image], check=True, capture_output=True, text=True).stdout
    lines = (DISASSEMBLY.match(line) for line in text.splitlines())
    return {int(m[1], 16): (m[2].removesuffix(".w").removesuffix(".n"), m[3]) for m in lines if m}


def register_count(operands):
    inside = operands[operands.index("{") + 1:operands.index("}")]
    return len(inside.split(","))


def is_branch(mnemonic):
    return re.fullmatch(r"(b|bl|bx|blx|cbz|cbnz|b(eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le))", mnemonic) is not None


def is_single_access(mnemonic):
    return mnemonic.startswith(("ldr", "str")) and not mnemonic.startswith(("ldrd", "strd"))


def cycles_of(cpu, mnemonic, operands, taken, after_access):
    small = cpu == "cortex-m0plus"
    refill = 1 if small else 2
    if mnemonic.startswith(("ldm", "stm", "push", "pop")):
        return 1 + register_count(operands) + (refill if "pc" in operands and mnemonic.startswith(("pop", "ldm")) else 0)
    if mnemonic.startswith(("ldrd", "strd")):
        return 3
    if is_single_access(mnemonic):
        return 1 if after_access and not small else 2
    if is_branch(mnemonic):
        return (3 if mnemonic == "bl" else 2) if small and taken else 1 + (refill if taken else 0)
    if mnemonic in ("smull", "umull", "smlal", "umlal"):
        return {"cortex-m3": 5, "cortex-m4": 1}[cpu]
    if mnemonic in ("mla", "mls"):
        return {"cortex-m3": 2, "cortex-m4": 1}[cpu]
    return 1


def trace(board, image, start, size, words):
    """The blocks that ran within the address range, as lists of instruction addresses, in their order."""
    with tempfile.TemporaryDirectory() as folder:
        log = os.path.join(folder, "trace.log")
        line = qemu_image.command(board, image, [os.path.basename(image)] + [str(word) for word in words])
        at = line.index("-icount")
        del line[at:at + 2]  # blocks run whole
        line += ["-d", "in_asm,exec,nochain", "-dfilter", f"{start:#x}+{size:#x}", "-D", log]
        subprocess.run(line, check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, timeout=120)
        blocks, reading, order = {}, None, []
        with open(log, encoding="utf-8", errors="replace") as text:
            for entry in text:
                if entry.startswith("IN:"):
                    reading = []
                elif reading is not None and (code := GUEST_CODE.match(entry)):
                    reading.append(int(code[1], 16))
                    blocks[reading[0]] = reading
                elif found := TRACE.match(entry):
                    reading = None
                    order.append(int(found[1], 16))
    return [blocks[pc] for pc in order]


def model(board, image, pattern, words):
    """(instructions, cycles) of one call of the function that matches, without what it calls."""
    start, size = symbol(image, pattern)
    listing = disassemble(image, start, size)
    instructions = cycles = calls = 0
    blocks = trace(board, image, start, size, words)
    after_access = False
    for block, following in zip(blocks, blocks[1:] + [None]):
        calls += block[0] == start
        for address in block:
            mnemonic, operands = listing[address]
            last = address == block[-1]
            taken = last and (following is None or following[0] != address + 2 and following[0] != address + 4)
            instructions += 1
            cycles += cycles_of(board["cpu"], mnemonic, operands, taken or mnemonic == "bl", after_access)
            after_access = is_single_access(mnemonic)
    if calls == 0 or instructions % calls != 0 or cycles % calls != 0:
        raise qemu_image.ImageError(f"{image}: {calls} calls of {pattern} did not all run alike")
    return instructions // calls, cycles // calls
