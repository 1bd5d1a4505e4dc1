# SPDX-License-Identifier: Apache-2.0
"""The image as functions of basic blocks, found by following the control flow from each function's entry: so data in the
text is never taken for code."""

import bisect
import re
import subprocess
from dataclasses import dataclass, field
from typing import Optional

from . import decoder
from .flow import FlowReader
from .instruction import OPPOSITE, SAME_CONDITION
from .loops import find_loops
from .refusal import Refusal


@dataclass
class Block:
    start: int
    instructions: list = field(default_factory=list)
    successors: list = field(default_factory=list)  # (start of a block, or None for a return, kind)
    callee: Optional[int] = None
    after: Optional[object] = None                  # the instruction that may run right before it, where that is no branch
    is_tail_call: bool = False                      # a jump to another function: the callee returns to the caller

    @property
    def last(self):
        return self.instructions[-1]


@dataclass
class Function:
    name: str
    start: int
    end: int
    blocks: dict = field(default_factory=dict)


def plain_name(name):
    """Without return type, arguments and namespaces, which begin with a small letter: `seal_of<PendingTorques>`."""
    name = re.sub(r" \[clone [^]]*\]|\(anonymous namespace\)::|\b[a-z]\w*::", "", name)
    depth, begin = 0, 0
    for at, letter in enumerate(name):
        depth += (letter == "<") - (letter == ">")
        if depth == 0 and letter == " ":
            begin = at + 1
        elif depth == 0 and letter == "(":
            return name[begin:at]
    return name[begin:]


def short_name(name):
    """Without templates' arguments too: `Controller::step`."""
    name = plain_name(name)
    while (plain := re.sub(r"<[^<>]*>", "", name)) != name:
        name = plain
    return name


class Program:
    def __init__(self, image):
        self.image = image
        self.instructions = decoder.disassemble(image)
        self.reader = FlowReader(image, self.instructions)
        self.second = decoder.SecondDecoder(image)
        self.functions = {}
        self.symbols = self._symbols()  # address -> (name, size)
        self.starts = sorted(self.symbols)

    def _symbols(self):
        mangled = sorted({name for name, _, _ in self.image.functions})
        names = subprocess.run(["arm-none-eabi-c++filt"], input="\n".join(mangled), check=True, capture_output=True,
                               text=True).stdout.split("\n")
        plain = dict(zip(mangled, names))
        found = {address: (name, 0) for name, address in self.image.labels if address in self.instructions}
        for name, address, size in sorted(self.image.functions, key=lambda f: f[2]):
            found[address] = (plain[name], size)
        return found

    def find(self, pattern):
        """The one function whose name matches."""
        found = [start for start in self.starts if re.search(pattern, self.symbols[start][0])]
        if len(found) != 1:
            raise Refusal(f"{self.image.path}: {len(found)} functions match '{pattern}', but one was expected")
        return found[0]

    def function(self, start):
        if start not in self.functions:
            self.functions[start] = self._read_function(start)
        return self.functions[start]

    def _read_function(self, start):
        if start not in self.symbols:
            raise Refusal(f"{self.image.path}: no function starts at {start:#x}")
        name, size = self.symbols[start]
        after = bisect.bisect_right(self.starts, start)
        following = self.starts[after] if after < len(self.starts) else max(self.instructions) + 4
        function = Function(name, start, start + size if size else following)
        self._cut_into_blocks(function, *self._follow(function))
        find_loops(function)
        return function

    def _is_inside(self, function, target):
        """libgcc's functions share ends without a symbol: they are taken as this function's own."""
        return function.start <= target < function.end or target not in self.symbols

    def _follow(self, function):
        """(starts of blocks, flow of each instruction that can run)."""
        leaders, todo, flows = {function.start}, [function.start], {}
        while todo:
            address, pending = todo.pop(), []
            while address not in flows:
                insn = self.instructions.get(address)
                if insn is None:
                    raise Refusal(f"{function.name}: no instruction at {address:#x}")
                self.second.check(insn)
                pending = self._apply_it(insn, pending)
                flow = flows[address] = self.reader.flow(insn, function)
                if flow.call is not None and self._is_last(insn, function):
                    flow.falls = False  # the abstract execution refuses a callee that comes back
                if self.symbols.get(flow.call, ("",))[0].startswith("__gnu_thumb1_case"):
                    raise Refusal(f"{function.name}: a helper that jumps by its return address: {insn}")
                inside = [t for t in flow.jumps if self._is_inside(function, t)]
                fresh = [t for t in inside + [insn.next] * (flow.falls and flow.ends_block) if t not in leaders]
                leaders.update(fresh)
                todo += fresh
                if flow.ends_block:
                    break
                address = insn.next
        for start, first, last in self.reader.tables.straight:
            jumps = [f"{a:#x}" for a, flow in flows.items() for target in flow.jumps if start == function.start and first <= target <= last]
            if jumps:
                raise Refusal(f"{function.name}: a jump from {jumps[0]} between a switch's guard and its table's jump at {last:#x}")
        return leaders, flows

    def _is_last(self, insn, function):
        """Nothing of the function follows it, but padding."""
        after = insn.next
        while after < function.end and after in self.instructions:
            if self.instructions[after].operation != "nop":
                return False
            after = self.instructions[after].next
        return True

    @staticmethod
    def _apply_it(insn, pending):
        """Conditions come from IT instructions that run alone: objdump takes literals for some, too."""
        if insn.operation.startswith("it") and set(insn.operation[2:]) <= {"t", "e"}:
            first = SAME_CONDITION.get(insn.operands[0], insn.operands[0])
            return [first] + [first if letter == "t" else OPPOSITE[first] for letter in insn.operation[2:]]
        if not (insn.operation == "b" and not pending):
            insn.condition = pending[0] if pending else None
        return pending[1:]

    def _cut_into_blocks(self, function, leaders, flows):
        for leader in leaders:
            block, address = Block(leader), leader
            while True:
                insn, flow = self.instructions[address], flows[address]
                block.instructions.append(insn)
                if flow.ends_block or insn.next in leaders:
                    break
                address = insn.next
            outside = [t for t in flow.jumps if not self._is_inside(function, t)]
            block.successors = [(t, flow.kind) for t in flow.jumps if self._is_inside(function, t)]
            if flow.falls:
                block.successors.append((insn.next, "falls"))
            if flow.returns:
                block.successors.append((None, "return"))
            block.callee = flow.call
            if outside:
                if flow.falls:
                    raise Refusal(f"{function.name}: a conditional jump into another function: {insn}")
                block.callee, block.is_tail_call = outside[0], True
                block.successors.append((None, "tail"))
            function.blocks[leader] = block
        for block in list(function.blocks.values()):
            if not flows[block.last.address].ends_block:
                function.blocks[block.last.next].after = block.last

    def reachable(self, root):
        """The functions that a call of `root` may run, callees first. A recursion is refused."""
        order, open_path = [], []

        def visit(start):
            if start in open_path:
                raise Refusal(f"a recursion: {' > '.join(short_name(self.symbols[s][0]) for s in open_path + [start])}")
            if start in order:
                return
            open_path.append(start)
            for block in self.function(start).blocks.values():
                if block.callee is not None:
                    visit(block.callee)
            open_path.pop()
            order.append(start)

        visit(root)
        return order
