# SPDX-License-Identifier: Apache-2.0
"""What blocks and edges cost in cycles, by Arm's published instruction timings: zero wait states, no contention, no caches.

Tables: Cortex-M0+ Technical Reference Manual (DDI 0484C, table 3-1, fast multiplier), Cortex-M3 (DDI 0337I, table 3-1), Cortex-M4
(DDI 0439D, table 3-1). Where a table gives a range its greatest value is taken: a refilled pipeline costs 3 cycles on the M3 and M4, a
division 12, a long multiplication 5 or 7 on the M3. A load or a store right after another one is pipelined there, within a block.
"""

TABLES = {"cortex-m0plus": "DDI 0484C, table 3-1", "cortex-m3": "DDI 0337I, table 3-1", "cortex-m4": "DDI 0439D, table 3-1"}
ARCHITECTURES = {"cortex-m0plus": ("v6S-M", "v6-M"), "cortex-m3": ("v7", "v7-M"), "cortex-m4": ("v7E-M",)}
LONG_MULTIPLICATION = {"smull": 5, "umull": 5, "smlal": 7, "umlal": 7}
CONDITIONAL_BRANCHES = ("b", "cbz", "cbnz")


class Cycles:
    def __init__(self, cpu):
        self.cpu, self.small = cpu, cpu == "cortex-m0plus"
        self.refill = 1 if self.small else 3

    def block(self, block):
        total, after_access = 0, False
        for insn in block.instructions:
            total += self.instruction(insn, after_access)
            after_access = is_single_access(insn)
        return total

    def edge(self, block, kind):
        """A conditional branch that is taken refills the pipeline."""
        conditional = block.last.operation in CONDITIONAL_BRANCHES and len(block.successors) == 2
        return self.refill if kind == "taken" and conditional else 0

    def instruction(self, insn, after_access):
        operation, operands = insn.operation, insn.operands
        if operation in ("push", "pop", "ldmia", "ldmdb", "stmia", "stmdb"):
            names = operands[-1].names
            returns = "pc" in names and operation in ("pop", "ldmia")
            return 1 + len(names) + (self.refill + self.small if returns else 0)
        if operation in ("ldrd", "strd"):
            return 3
        if is_single_access(insn):
            return (1 if after_access and not self.small else 2) + (self.refill if operands[0] == "pc" else 0)
        if operation in ("tbb", "tbh"):
            return 2 + self.refill
        if operation == "bl":
            return 3 if self.small else 1 + self.refill
        if operation == "bx" or operation == "b" and insn.condition is None or operands[:1] == ("pc",):
            return 2 if self.small else 1 + self.refill
        if operation in ("udiv", "sdiv"):
            return 12
        if self.cpu == "cortex-m3":
            return LONG_MULTIPLICATION.get(operation, 2 if operation in ("mla", "mls") else 1)
        return 1


def is_single_access(insn):
    return insn.operation.startswith(("ldr", "str")) and insn.operation not in ("ldrd", "strd")


def memory_words(insn):
    """Words that it loads or stores."""
    if insn.operation in ("push", "pop", "ldmia", "ldmdb", "stmia", "stmdb"):
        return len(insn.operands[-1].names)
    if insn.operation in ("tbb", "tbh"):
        return 1
    return 2 if insn.operation in ("ldrd", "strd") else int(is_single_access(insn))
