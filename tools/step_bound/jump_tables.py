# SPDX-License-Identifier: Apache-2.0
"""The targets of a switch: how many its guard lets through, and where its table stands.

Idioms of GCC 12: `cmp rI, #n; bhi; tbb [pc, rI]`; `ldr pc, [rT, rI, lsl #2]` with rT from a literal, `addw rT, pc, #n` or
movw and movt; Armv6-M's `lsls r, rI, #2; ldr rT, [pc]; ldr r, [rT, r]; mov pc, r`; and its helpers
`__gnu_thumb1_case_...`, which are refused: they jump by their return address.
"""

from .instruction import Memory
from .refusal import Refusal


def literal_address(insn):
    return (insn.address + 4 & ~3) + insn.operands[1].offset


class JumpTables:
    def __init__(self, image, instructions):
        self.image, self.instructions = image, instructions

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
        """As many as the guard before it lets through."""
        for before in self.before(insn, 14):
            if before.operation == "cmp" and isinstance(before.operands[1], int) and register in (before.operands[0], None):
                return before.operands[1] + 1
        raise Refusal(f"{function.name}: no guard before {insn}")

    def offsets(self, insn, function):
        width = 1 if insn.operation == "tbb" else 2
        table = insn.address + 4
        count = self.entries(insn, insn.operands[0].offset, function)
        return sorted({table + 2 * self._entry(insn, function, table + width * i, width) for i in range(count)})

    def addresses(self, insn, function):
        if insn.operation == "mov":
            shift = next((i for i in self.before(insn, 14) if i.operation == "lsl" and i.operands[-1] == 2), None)
            if shift is None:
                raise Refusal(f"{function.name}: no table for {insn}")
            table, index = self._table(insn, None, function), None
        else:
            memory = insn.operands[1]
            if not isinstance(memory, Memory) or memory.scale != 2:
                raise Refusal(f"{function.name}: no table for {insn}")
            table, index = self._table(insn, memory.base, function), memory.offset
        count = self.entries(insn, index, function)
        return sorted({self._entry(insn, function, table + 4 * i, 4) & ~1 for i in range(count)})

    def _entry(self, insn, function, address, width):
        value = self.image.constant(address, width)
        if value is None:
            raise Refusal(f"{function.name}: the table of {insn} is not constant")
        return value

    def _table(self, insn, base, function):
        """Where the register `base`, or any where it is None, was made a table's address."""
        high = None
        for before in self.before(insn, 14):
            if not before.operands or base not in (before.operands[0], None):
                continue
            memory = before.operands[1] if len(before.operands) > 1 else None
            if before.operation == "ldr" and isinstance(memory, Memory) and memory.base == "pc":
                return self._entry(insn, function, literal_address(before), 4)
            if before.operation in ("add", "addw") and memory == "pc":
                return (before.address + 4 & ~3) + before.operands[2]
            if before.operation == "movt":
                high = before.operands[1] << 16
            elif before.operation in ("movw", "mov") and high is not None:
                return high | before.operands[1]
        raise Refusal(f"{function.name}: no table for {insn}")
