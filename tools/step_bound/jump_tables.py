# SPDX-License-Identifier: Apache-2.0
"""The targets of a switch: how many its guard lets through, and where its table stands.

Idioms of GCC 12: `cmp rI, #n; bhi; tbb [pc, rI]`; `ldr pc, [rT, rI, lsl #2]` with rT from a literal, `addw rT, pc, #n` or
movw and movt; Armv6-M's `lsls r, rI, #2; ldr rT, [pc]; ldr r, [rT, r]; mov pc, r`; and its helpers
`__gnu_thumb1_case_...`, which are refused: they jump by their return address.

From the guard and the table's address on nothing else may write these registers, and nothing may jump in between (`straight`). A switch whose guard the compiler left out, as
nothing else was said to come, is refused.
"""

from .instruction import Memory, RegisterList
from .refusal import Refusal

MOST_BEFORE = 24
WRITES_NO_REGISTER = ("cmp", "cmn", "tst", "teq", "str", "stm", "push", "b", "cbz", "cbnz", "it", "nop")


def literal_address(insn):
    return (insn.address + 4 & ~3) + insn.operands[1].offset


def writes(insn, register):
    if insn.operation in ("bl", "blx"):
        return register in ("r0", "r1", "r2", "r3", "r12", "lr")
    if insn.operation.startswith(WRITES_NO_REGISTER) and insn.operation not in ("bic", "bfi", "bfc"):
        return any(isinstance(o, Memory) and o.base == register and (o.writes_back or o.after is not None) for o in insn.operands) or \
            insn.writes_back and insn.operands[0] == register
    return any(o == register or isinstance(o, RegisterList) and register in o.names for o in insn.operands[:2]) or \
        any(isinstance(o, Memory) and o.base == register and (o.writes_back or o.after is not None) for o in insn.operands)


class JumpTables:
    def __init__(self, image, instructions):
        self.image, self.instructions = image, instructions
        self.straight = []  # (the function's start, first address, last): one way through, from the first to the last

    def before(self, insn, most):
        """The instructions that stand before it, the nearest first."""
        for _ in range(most):
            insn = self.instructions.get(insn.address - 2) or self.instructions.get(insn.address - 4)
            if insn is None:
                return
            yield insn

    def following(self, address, most):
        for _ in range(most):
            insn = self.instructions.get(address)
            if insn is None:
                return
            yield insn
            address = insn.next

    def entries(self, insn, register, function):
        """As many as `cmp register, #n` and `bhi` before it let through."""
        guard = None
        for before in self.before(insn, MOST_BEFORE):
            if before.operation == "b":
                if before.condition is None:
                    break
                guard = before if before.condition == "hi" else None
            elif guard is not None and (before.sets_flags or before.operation in ("cmp", "cmn", "tst", "teq", "vmrs", "msr", "bl")):
                if before.operation == "cmp" and before.operands[0] == register and isinstance(before.operands[1], int) and before.condition is None:
                    self.straight.append((function.start, guard.next, insn.address))
                    return before.operands[1] + 1
                guard = None
            if writes(before, register):
                break
        raise Refusal(f"{function.name}: no guard before {insn}")

    def offsets(self, insn, function):
        width = 1 if insn.operation == "tbb" else 2
        table = insn.address + 4
        count = self.entries(insn, insn.operands[0].offset, function)
        return sorted({table + 2 * self._entry(insn, function, table + width * i, width) for i in range(count)})

    def addresses(self, insn, function):
        index, load = insn, insn
        if insn.operation == "mov":
            load = self._writer(insn, insn.operands[1], function)
        memory = load.operands[1] if len(load.operands) > 1 else None
        if load.operation != "ldr" or not isinstance(memory, Memory) or not isinstance(memory.offset, str):
            raise Refusal(f"{function.name}: no table for {insn}")
        base, register = memory.base, memory.offset
        if insn.operation == "mov":
            index = self._writer(load, register, function)
            if not is_shift(index):
                base, register = register, base
                index = self._writer(load, register, function)
            if not is_shift(index):
                raise Refusal(f"{function.name}: no table for {insn}")
            register = index.operands[-2]
        elif memory.scale != 2:
            raise Refusal(f"{function.name}: no table for {insn}")
        count, table = self.entries(index, register, function), self._table(load, base, function)
        self.straight[-1] = self.straight[-1][:2] + (insn.address,)
        return sorted({self._entry(insn, function, table + 4 * i, 4) & ~1 for i in range(count)})

    def _writer(self, insn, register, function):
        """The last that wrote a register before it."""
        for before in self.before(insn, MOST_BEFORE):
            if before.operation == "b" and before.condition is None:
                break
            if writes(before, register):
                self.straight.append((function.start, before.next, insn.address))
                return before
        raise Refusal(f"{function.name}: no table for {insn}")

    def _entry(self, insn, function, address, width):
        value = self.image.constant(address, width)
        if value is None:
            raise Refusal(f"{function.name}: the table of {insn} is not constant")
        return value

    def _table(self, insn, base, function):
        """Where the register `base` was made a table's address."""
        writer = self._writer(insn, base, function)
        source = writer.operands[1] if len(writer.operands) > 1 else None
        if writer.condition is None and writer.operation == "ldr" and isinstance(source, Memory) and source.base == "pc":
            return self._entry(insn, function, literal_address(writer), 4)
        if writer.condition is None and writer.operation in ("add", "addw") and source == "pc":
            return (writer.address + 4 & ~3) + writer.operands[2]
        if writer.condition is None and writer.operation == "movt":
            low = self._writer(writer, base, function)
            if low.condition is None and low.operation in ("movw", "mov") and isinstance(low.operands[1], int):
                return writer.operands[1] << 16 | low.operands[1]
        raise Refusal(f"{function.name}: no table for {insn}")


def is_shift(insn):
    return insn.operation == "lsl" and insn.operands[-1] == 2 and insn.condition is None
