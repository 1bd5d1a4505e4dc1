# SPDX-License-Identifier: Apache-2.0
"""Where one instruction leads: on, to jump targets, into a call, back to the caller. An unknown way is refused."""

from dataclasses import dataclass, field
from typing import Optional

from .instruction import Label, Memory, RegisterList
from .jump_tables import JumpTables
from .refusal import Refusal

TRAPS = frozenset("svc udf hlt bxj bf bfl bfx bflx bfcsel eret rfe".split())
LOOP_ENDS = frozenset(("le", "letp"))
LOOP_STARTS = frozenset(("wls", "wlstp.8", "wlstp.16", "wlstp.32", "wlstp.64"))


@dataclass
class Flow:
    falls: bool = True                            # the next instruction may follow
    jumps: list = field(default_factory=list)     # targets within the function, or of a tail call
    kind: str = "taken"                           # of the jumps: "taken" or "table"
    call: Optional[int] = None                    # the callee's address
    returns: bool = False

    @property
    def ends_block(self):
        return bool(self.jumps) or self.call is not None or self.returns or not self.falls


class FlowReader:
    def __init__(self, image, instructions):
        self.instructions = instructions
        self.tables = JumpTables(image, instructions)

    def refuse(self, function, insn, why):
        raise Refusal(f"{function.name}: {why}: {insn}")

    def flow(self, insn, function):
        operation, operands = insn.operation, insn.operands
        target = operands[-1].address if operands and isinstance(operands[-1], Label) else None
        conditional = insn.condition is not None
        if operation in TRAPS:
            self.refuse(function, insn, "a trap, or a branch that is not known")
        if operation == "b" or operation in LOOP_ENDS | LOOP_STARTS | {"cbz", "cbnz"}:
            if target is None:
                self.refuse(function, insn, "a jump without a target")
            return Flow(falls=operation != "b" or conditional, jumps=[target])
        if operation in ("bl", "blx"):
            return self._call(insn, function, target)
        if operation == "bx":
            if operands[0] != "lr" and not self._holds_return_address(insn, operands[0], function):
                self.refuse(function, insn, "an indirect jump")
            return Flow(falls=conditional, returns=True)
        if operation in ("tbb", "tbh"):
            return Flow(falls=False, jumps=self.tables.offsets(insn, function), kind="table")
        return self._writes_pc(insn, function, conditional)

    def _call(self, insn, function, target):
        if target is None:
            self.refuse(function, insn, "an indirect call")
        if insn.condition is not None or insn.operation == "blx":
            self.refuse(function, insn, "a conditional call, or one into another instruction set")
        if function.start < target < function.end:  # Armv6-M's far jump: it has no b.w
            return Flow(falls=False, jumps=[target])
        return Flow(call=target)

    def _writes_pc(self, insn, function, conditional):
        """Returns by pop or load; jumps by a table in memory."""
        operation, operands = insn.operation, insn.operands
        if operation in ("pop", "ldmia") and isinstance(operands[-1], RegisterList) and "pc" in operands[-1].names:
            return Flow(falls=conditional, returns=True)
        if operands and operands[0] == "pc":
            if operation == "ldr" and isinstance(operands[1], Memory) and operands[1].base == "sp":
                return Flow(falls=conditional, returns=True)
            if operation in ("ldr", "mov"):
                return Flow(falls=conditional, jumps=self.tables.addresses(insn, function), kind="table")
            if operation not in ("cmp", "tst", "str", "push"):
                self.refuse(function, insn, "an unknown way to write the program counter")
        return Flow()

    def _holds_return_address(self, insn, register, function):
        """`pop {rX}; bx rX`, as Armv6-M returns: rX was popped just before, and lr was pushed at the entry."""
        for before in self.tables.before(insn, 12):
            if before.operation == "pop" and register in before.operands[0].names:
                return any(entry.operation == "push" and "lr" in entry.operands[0].names
                           for entry in self.tables.following(function.start, 6))
            if before.operands and before.operands[0] == register and before.operation not in ("cmp", "str", "tst"):
                return False
        return False
