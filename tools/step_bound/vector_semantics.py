# SPDX-License-Identifier: Apache-2.0
"""Floating-point and Helium instructions: no loop's bound comes out of them, but they move addresses and core registers."""

import re

from .instruction import Memory, RegisterList
from .state import STACK
from .values import MASK, Pointer, add

BYTES = {"s": 4, "d": 8, "q": 16}
INTERLEAVED = re.compile(r"v(ld|st)[24][0-3]\.(8|16|32)$")
KNOWN = re.compile(
    r"v(push|pop|ldmia|ldmdb|stmia|stmdb|(ldr|str)([bhwd]?)(\.\w+)?|mov[nlx]?[bt]?(\.\w+)?|mvn|dup\.\w+|ml[as]d?a?v?a?x?\.\w+|mlal?va?\.\w+"
    r"|mlal?d?a?v?a?\.\w+|add(v|va|lv|lva)?\.\w+|sub\.\w+|mul[hl]?[bt]?\.\w+|max\.\w+|min\.\w+|abs\.\w+|neg\.\w+|and|orr|eor|bic|orn"
    r"|q?r?shr?n?[bt]?\.\w+|q?r?shrnb\.\w+|qrshrn[bt]\.\w+|shl\.\w+|shr\.\w+|q?dmulh\.\w+|qrdmulh\.\w+|qmovn[bt]\.\w+|cmp\.\w+|pst|pt\w*\.\w+"
    r"|psel|ctp\.\w+|mrs|msr|rev\w+\.\w+|hadd\.\w+|idup\.\w+)$")


def registers_bytes(names):
    return sum(BYTES[name[0]] for name in names)


def execute(state, insn):
    """False if it is not known."""
    name = insn.operation
    unpredicated = re.sub(r"[te](?=\.)", "", name, count=1)  # in a VPT block: it may do as much, or less
    if not (INTERLEAVED.match(name) or KNOWN.match(name) or KNOWN.match(unpredicated)):
        return False
    operands = insn.operands
    lists = [operand for operand in operands if isinstance(operand, RegisterList)]
    memory = next((operand for operand in operands if isinstance(operand, Memory)), None)
    if name in ("vpush", "vpop"):
        size = registers_bytes(lists[0].names)
        state.put(STACK, add(state.registers.get(STACK), (size if name == "vpop" else -size) & MASK))
        if name == "vpush":
            _overwrite(state, state.registers.get(STACK), size)
    elif lists and memory is None:
        _several(state, insn, registers_bytes(lists[0].names))
    elif memory is not None:
        _access(state, insn, memory)
    else:
        for operand in operands[:2]:  # a core register that it may write
            if isinstance(operand, str) and operand in state.registers:
                state.put(operand, None)
        if name == "vmrs":
            state.flags = None
    return True


def _several(state, insn, size):
    base, downward = insn.operands[0], insn.operation.endswith("db")
    start = state.registers.get(base)
    first = add(start, -size & MASK) if downward else start
    if insn.operation.startswith("vst"):
        _overwrite(state, first, size)
    if insn.writes_back:
        state.put(base, first if downward else add(start, size))


def _access(state, insn, memory):
    base = state.registers.get(memory.base) if memory.base != "pc" else None
    offset = memory.offset if isinstance(memory.offset, int) else state.registers.get(memory.offset)
    address = add(base, offset & MASK if isinstance(offset, int) else None)
    if memory.after is not None:
        address, after = base, memory.after if isinstance(memory.after, int) else None
        state.put(memory.base, add(base, after & MASK if after is not None else None))
    elif memory.writes_back and INTERLEAVED.match(insn.operation):
        state.put(memory.base, add(base, 32 if insn.operation[3] == "2" else 64))
    elif memory.writes_back:
        state.put(memory.base, address)
    if insn.operation.startswith("vst"):
        _overwrite(state, address, 64 if INTERLEAVED.match(insn.operation) else BYTES[insn.operands[0][0]])


def _overwrite(state, address, size):
    if isinstance(address, Pointer):
        for at in range(0, size, 4):
            state.store(Pointer(address.base, address.offset + at, address.aligned), 4, None)
