# SPDX-License-Identifier: Apache-2.0
"""Floating-point and Helium instructions: no loop's bound comes out of them, but they move addresses and core registers."""

import re

from .instruction import REGISTERS, Memory, RegisterList
from .values import MASK, STACK, Somewhere, add, of_stack

CORE_REGISTERS = frozenset(REGISTERS.values())
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
        else:
            _read(state, add(state.registers.get(STACK), -size & MASK), size)
    elif lists and memory is None:
        _several(state, insn, registers_bytes(lists[0].names))
    elif memory is not None:
        _access(state, insn, memory)
    else:
        state.escaped = state.escaped or of_stack(state.made_of(operands))  # from a core register into one of its own
        for operand in operands[:2]:  # a core register that it may write
            if operand in CORE_REGISTERS:
                state.put(operand, Somewhere() if state.escaped else None)
        if name == "vmrs":
            state.flags = None
    return True


def _several(state, insn, size):
    base, downward = insn.operands[0], insn.operation.endswith("db")
    start = state.registers.get(base)
    first = add(start, -size & MASK) if downward else start
    if insn.operation.startswith("vst"):
        _overwrite(state, first, size)
    else:
        _read(state, first, size)
    if insn.writes_back:
        state.put(base, first if downward else add(start, size))


def _access(state, insn, memory):
    base = state.registers.get(memory.base) if memory.base != "pc" else None
    if memory.base not in CORE_REGISTERS and state.escaped:  # addresses in a vector register
        base = Somewhere()
    offset = memory.offset if isinstance(memory.offset, int) else state.registers.get(memory.offset)
    address = add(base, offset & MASK if isinstance(offset, int) else offset)
    if memory.after is not None:
        address, after = base, memory.after if isinstance(memory.after, int) else state.registers.get(memory.after)
        state.put(memory.base, add(base, after & MASK if isinstance(after, int) else after))
    elif memory.writes_back and INTERLEAVED.match(insn.operation):
        state.put(memory.base, add(base, 32 if insn.operation[3] == "2" else 64))
    elif memory.writes_back:
        state.put(memory.base, address)
    size = 64 if INTERLEAVED.match(insn.operation) else BYTES[insn.operands[0][0]]
    if insn.operation.startswith("vst"):
        _overwrite(state, address, size)
    else:
        _read(state, address, size)


def _overwrite(state, address, size):
    for at in range(0, size, 4):
        state.store(add(address, at), 4, None)


def _read(state, address, size):
    """What is in such a register may go anywhere."""
    state.escaped = state.escaped or of_stack(address) and any(of_stack(state.load(add(address, at), 4, False)) for at in range(0, size, 4))
