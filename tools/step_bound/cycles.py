# SPDX-License-Identifier: Apache-2.0
"""What blocks and edges cost in cycles, by Arm's published instruction timings: zero wait states, no contention, no caches.

Tables: Cortex-M0+ Technical Reference Manual (DDI 0484C, table 3-1, fast multiplier), Cortex-M3 (DDI 0337I, table 3-1), Cortex-M4
(DDI 0439D, table 3-1). Where a table gives a range its greatest value is taken: a refilled pipeline costs 3 cycles on the M3 and M4, a
division 12, a long multiplication 5 or 7 on the M3; a barrier, which waits for one buffered store, 4. The M3's and M4's loads and stores by "Load/store timings" of the same
chapter: one right after a single load is pipelined, unless it takes its address from what was loaded; a store with a number for its offset takes one cycle
where none stored right before it; what has its address computed right before waits a cycle for that; a literal may wait one for a fetch.
"""

from .instruction import Memory

TABLES = {"cortex-m0plus": "DDI 0484C, table 3-1", "cortex-m3": "DDI 0337I, table 3-1", "cortex-m4": "DDI 0439D, table 3-1"}
ARCHITECTURES = {"cortex-m0plus": ("v6S-M", "v6-M"), "cortex-m3": ("v7", "v7-M"), "cortex-m4": ("v7E-M",)}
LONG_MULTIPLICATION = {"smull": 5, "umull": 5, "smlal": 7, "umlal": 7}
CONDITIONAL_BRANCHES = ("b", "cbz", "cbnz")
SYSTEM = {"mrs": 3, "msr": 3, "dmb": 4, "dsb": 4, "isb": 4, "cpsid": 2, "cpsie": 2, "wfi": 2}


class Cycles:
    def __init__(self, cpu):
        self.cpu, self.small = cpu, cpu == "cortex-m0plus"
        self.refill = 1 if self.small else 3

    def block(self, block):
        first = block.instructions[0]
        total = self.instruction(first) + max(self.access(first, None), self.access(first, block.after))
        pairs = zip(block.instructions, block.instructions[1:])
        return total + sum(self.instruction(insn) + self.access(insn, before) for before, insn in pairs)

    def edge(self, block, kind):
        """A conditional branch that is taken refills the pipeline."""
        conditional = block.last.operation in CONDITIONAL_BRANCHES and len(block.successors) == 2
        return self.refill if kind == "taken" and conditional else 0

    def access(self, insn, before):
        """What a load or a store costs more, or less, for the instruction before it."""
        if self.small or not memory_words(insn):
            return 0
        used, is_alone = address_registers(insn), is_single_access(insn) and insn.operands[0] != "pc"
        after_load = before is not None and is_single_access(before) and before.operation.startswith("ldr") and not changes_base(before)
        waits = before is not None and not memory_words(before) and any(operand in used for operand in before.operands[:2])
        earlier = is_alone and (after_load and before.operands[0] not in used or stores_at_once(insn) and not (before and stores(before)))
        is_literal = "pc" in used and insn.operation not in ("tbb", "tbh")
        return waits - earlier + is_literal

    def instruction(self, insn):
        operation, operands = insn.operation, insn.operands
        if operation in ("push", "pop", "ldmia", "ldmdb", "stmia", "stmdb"):
            names = operands[-1].names
            returns = "pc" in names and operation in ("pop", "ldmia")
            return 1 + len(names) + (self.refill + self.small if returns else 0)
        if operation in ("ldrd", "strd"):
            return 3
        if is_single_access(insn):
            return 2 + (self.refill if operands[0] == "pc" else 0)
        if operation in ("tbb", "tbh"):
            return 3 + self.refill
        if operation == "bl":
            return 3 if self.small else 1 + self.refill
        if operation == "bx" or operation == "b" and insn.condition is None or operands[:1] == ("pc",):
            return 2 if self.small else 1 + self.refill
        if operation in ("udiv", "sdiv"):
            return 12
        if operation in SYSTEM:
            return SYSTEM[operation]
        if self.cpu == "cortex-m3":
            return LONG_MULTIPLICATION.get(operation, 2 if operation in ("mla", "mls") else 1)
        return 1


def address_registers(insn):
    if insn.operation in ("push", "pop"):
        return {"sp"}
    memory = [operand for operand in insn.operands if isinstance(operand, Memory)]
    return {memory[0].base, memory[0].offset} if memory else {insn.operands[0]}


def changes_base(insn):
    return any(isinstance(operand, Memory) and (operand.writes_back or operand.after is not None) for operand in insn.operands)


def stores(insn):
    return insn.operation.startswith(("st", "push"))


def stores_at_once(insn):
    """`str r0, [r1, #4]`: one cycle."""
    return insn.operation in ("str", "strb", "strh") and isinstance(insn.operands[1].offset, int) and not changes_base(insn)


def is_single_access(insn):
    return insn.operation.startswith(("ldr", "str")) and insn.operation not in ("ldrd", "strd")


def memory_words(insn):
    """Words that it loads or stores."""
    if insn.operation in ("push", "pop", "ldmia", "ldmdb", "stmia", "stmdb"):
        return len(insn.operands[-1].names)
    if insn.operation in ("tbb", "tbh"):
        return 1
    return 2 if insn.operation in ("ldrd", "strd") else int(is_single_access(insn))
