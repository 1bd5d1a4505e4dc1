# SPDX-License-Identifier: Apache-2.0
"""The image's instructions by binutils' objdump, and a second opinion by Capstone.

Capstone 4 knows Thumb-2 and its DSP instructions, but nothing of Armv8.1-M: what it cannot decode has one decoder alone, and
is counted.
"""

import re

import capstone

from . import instruction
from .image import binutils
from .refusal import Refusal

LINE = re.compile(r"^\s*([0-9a-f]+):\t([0-9a-f ]+?)\s*\t(\S+)\s*(.*)$")


def disassemble(image):
    """Every line of the listing that is no data, by address."""
    machine = ["-m", "armv8.1-m.main"] if image.is_armv8_1m else []  # without it objdump knows no MVE
    listing = binutils("objdump", image.path, "-d", *machine)
    found = {}
    for line in listing.splitlines():
        match = LINE.match(line)
        if match and not match[3].startswith("."):
            address, size = int(match[1], 16), len(match[2].replace(" ", "")) // 2
            operands = re.split(r"\s*[;@]", match[4])[0].strip()
            found[address] = instruction.parse(address, size, match[3], operands)
    if not found:
        raise Refusal(f"{image.path}: no code")
    return found


# Capstone 4 takes these encodings of Armv8.1-M for others.
ONLY_OBJDUMP = re.compile(r"(lsll|lsrl|asrl|cinc|cinv|cneg|cset|csetm|csel|csinc|csinv|csneg|le|letp|dls.*|wls.*|v.*)$")


def immediates(text):
    """What it says in numbers: immediates, and a branch's target, which objdump writes without a #."""
    numbers = {int(number, 0) & 0xFFFFFFFF for number in re.findall(r"#(-?(?:0x[0-9a-f]+|\d+))", text)}
    return (numbers | {int(number, 16) for number in re.findall(r"\b([0-9a-f]+) <", text)}) - {0}


class SecondDecoder:
    """Agrees, or refuses. What it does not know it counts."""

    # Names of one encoding: objdump's, then Capstone's.
    SAME = {"neg": ("rsb",), "addw": ("add",), "subw": ("sub",), "adr": ("add", "adr"), "add": ("addw", "adr"), "mov": ("movw",),
            "sub": ("subw", "adr"), "nop": ("nop", "hint", "mov"), "push": ("push", "stmdb", "str"), "pop": ("pop", "ldm", "ldr"),
            "ldmia": ("ldm", "pop"), "stmia": ("stm",), "stmdb": ("push",), "lsl": ("mov",), "ror": ("mov",), "lsr": ("mov",),
            "asr": ("mov",), "ldr": ("pop",), "str": ("push",), "movw": ("mov",)}

    def __init__(self, image):
        self.image = image
        self.engine = capstone.Cs(capstone.CS_ARCH_ARM, capstone.CS_MODE_THUMB)
        self.agreed = self.unknown = 0

    def check(self, insn):
        data = self.image.bytes_at(insn.address, insn.size)
        known = data and not (self.image.is_armv8_1m and ONLY_OBJDUMP.match(insn.operation))
        other = next(self.engine.disasm(data, insn.address, 1), None) if known else None
        if other is None:
            self.unknown += 1
            return
        name = instruction.split_mnemonic(other.mnemonic)[0]
        if other.size != insn.size or name != insn.operation and name not in self.SAME.get(insn.operation, ()):
            raise Refusal(f"two decoders disagree at {insn}: {other.mnemonic} {other.op_str}")
        if immediates(insn.text) != immediates(other.op_str):
            raise Refusal(f"two decoders disagree at {insn}: {other.mnemonic} {other.op_str}")
        self.agreed += 1
