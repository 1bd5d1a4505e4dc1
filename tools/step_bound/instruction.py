# SPDX-License-Identifier: Apache-2.0
"""One Thumb instruction, taken apart: operation, condition, whether it sets the flags, operands."""

import re
from dataclasses import dataclass
from typing import NamedTuple, Optional, Union

CONDITIONS = ("eq", "ne", "cs", "hs", "cc", "lo", "mi", "pl", "vs", "vc", "hi", "ls", "ge", "lt", "gt", "le")
SAME_CONDITION = {"hs": "cs", "lo": "cc"}
OPPOSITE = {"eq": "ne", "ne": "eq", "cs": "cc", "cc": "cs", "mi": "pl", "pl": "mi", "vs": "vc", "vc": "vs", "hi": "ls",
            "ls": "hi", "ge": "lt", "lt": "ge", "gt": "le", "le": "gt"}
REGISTERS = {**{f"r{i}": f"r{i}" for i in range(13)}, "sb": "r9", "sl": "r10", "fp": "r11", "ip": "r12", "r13": "sp",
             "sp": "sp", "r14": "lr", "lr": "lr", "r15": "pc", "pc": "pc"}

# What may be conditional or set the flags, by its bare name. Everything else keeps its name as it is.
CAN_SET_FLAGS = frozenset("add sub rsb adc sbc and orr orn eor bic mov mvn neg lsl lsr asr ror mul".split())
CAN_BE_CONDITIONAL = CAN_SET_FLAGS | frozenset(
    "addw subw movw movt cmp cmn tst teq mla mls smull umull smlal umlal sdiv udiv ldr ldrb ldrh ldrsb ldrsh ldrd str strb "
    "strh strd ldmia ldmdb stmia stmdb push pop uxtb uxth sxtb sxth uxtab uxtah sxtab sxtah ubfx sbfx bfi bfc clz rbit rev rev16 "
    "revsh ssat usat nop bx b bl blx".split())
ALIASES = {"ldm": "ldmia", "stm": "stmia", "ldmfd": "ldmia", "stmfd": "stmdb", "ldmea": "ldmdb", "stmea": "stmia"}


class Shift(NamedTuple):
    kind: str
    amount: Union[int, str]  # a number or a register


class Memory(NamedTuple):
    """[base, offset << scale], then the base rises by `after`, or becomes the address."""
    base: str
    offset: Union[int, str]
    scale: int
    writes_back: bool
    after: Union[int, str, None]


class RegisterList(NamedTuple):
    names: tuple


class Label(NamedTuple):
    address: int


@dataclass(slots=True)
class Instruction:
    address: int
    size: int
    operation: str
    condition: Optional[str]
    sets_flags: bool
    operands: tuple
    writes_back: bool  # `ldmia r0!, {...}`
    text: str

    @property
    def next(self):
        return self.address + self.size

    def __str__(self):
        return f"{self.address:#x}: {self.text}"


def split_mnemonic(mnemonic):
    """(operation, condition, sets the flags) of `addseq.w`."""
    name = re.sub(r"\.[nw]$", "", mnemonic)
    if name in ("bl", "blx", "bx", "b", "teq", "mls", "smmls"):
        return name, None, False
    if match := re.fullmatch(r"(b)(..)", name):
        if match[2] in CONDITIONS:
            return "b", SAME_CONDITION.get(match[2], match[2]), False
    name = ALIASES.get(name, name)
    if name in CAN_BE_CONDITIONAL:
        return name, None, False
    if name[:-1] in CAN_SET_FLAGS and name.endswith("s"):
        return name[:-1], None, True
    bare, condition = ALIASES.get(name[:-2], name[:-2]), name[-2:]
    if condition in CONDITIONS:
        condition = SAME_CONDITION.get(condition, condition)
        if bare in CAN_BE_CONDITIONAL:
            return bare, condition, False
        if bare[:-1] in CAN_SET_FLAGS and bare.endswith("s"):
            return bare[:-1], condition, True
    return name, None, False


def split_operands(text):
    """At the commas that are not within brackets."""
    found, depth, start = [], 0, 0
    for at, letter in enumerate(text):
        depth += (letter in "[{") - (letter in "]}")
        if letter == "," and depth == 0:
            found.append(text[start:at].strip())
            start = at + 1
    rest = text[start:].strip()
    return found + [rest] if rest else found


def parse_registers(text):
    names = []
    for part in text.strip("{}^ ").split(","):
        first, _, last = part.strip().partition("-")
        if last and first[0] in "rsdq" and first[1:].isdigit():
            names += [first[0] + str(i) for i in range(int(first[1:]), int(last[1:]) + 1)]
        else:
            names.append(REGISTERS.get(first, first))
    return RegisterList(tuple(names))


def parse_number_or_register(text):
    return int(text[1:], 0) if text.startswith("#") else REGISTERS.get(text, text)


def parse_memory(text, after):
    writes_back = text.endswith("!")
    parts = [part.strip() for part in text.rstrip("!").strip("[]").split(",")]
    offset = parse_number_or_register(parts[1].lstrip("-")) if len(parts) > 1 else 0
    scale = int(parts[2].split("#")[1]) if len(parts) > 2 and parts[2].startswith("lsl") else 0
    return Memory(REGISTERS.get(parts[0], parts[0]), offset, scale, writes_back, after)


def parse_operand(text):
    if match := re.fullmatch(r"(lsl|lsr|asr|ror) (#?\w+)", text):
        return Shift(match[1], parse_number_or_register(match[2]))
    if text == "rrx":
        return Shift("rrx", 1)
    if match := re.match(r"([0-9a-f]+) <", text):
        return Label(int(match[1], 16))
    if text.startswith("{"):
        return parse_registers(text)
    if text.startswith("#"):
        return int(text[1:], 0) if re.fullmatch(r"#-?\w+", text) else text
    return REGISTERS.get(text.rstrip("!"), text)


def parse_operands(text):
    parts, operands, at = split_operands(text), [], 0
    while at < len(parts):
        if parts[at].startswith("["):
            has_after = at + 1 < len(parts) and not parts[at].endswith("!")
            operands.append(parse_memory(parts[at], parse_number_or_register(parts[at + 1]) if has_after else None))
            at += 2 if has_after else 1
        else:
            operands.append(parse_operand(parts[at]))
            at += 1
    return tuple(operands)


def parse(address, size, mnemonic, operand_text):
    operation, condition, sets_flags = split_mnemonic(mnemonic)
    operands = parse_operands(operand_text)
    if operation == "mov" and isinstance(operands[-1], Shift):  # `mov r6, r1, lsl #28` is a shift
        operation, operands = operands[-1].kind, (operands[0], operands[1], operands[-1].amount)
    return Instruction(address, size, operation, condition, sets_flags, operands,
                       bool(re.match(r"\w+!", operand_text)), f"{mnemonic} {operand_text}".strip())
