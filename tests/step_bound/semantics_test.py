#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each form of instruction that a board's step or tick has, by itself on QEMU: registers, flags and stack words are drawn, the debugger steps over it, and whatever the
semantics claim to know afterwards has to be what the processor has. What they leave alone has to be as it was."""

import contextlib
import os
import random
import struct
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "tools"), os.path.join(ROOT, "tests", "ports")]
sys.dont_write_bytecode = True

import gdb_remote  # noqa: E402
import qemu_image  # noqa: E402
from step_bound import analysis  # noqa: E402
from step_bound.functions import Block  # noqa: E402
from step_bound.instruction import OPPOSITE, Label, Memory, RegisterList, Shift  # noqa: E402
from step_bound.semantics import Semantics, branches  # noqa: E402
from step_bound.state import STACK, State  # noqa: E402
from step_bound.values import MASK, Flags, Low, Negated, Pointer, holds  # noqa: E402

NAMES = [f"r{i}" for i in range(13)] + ["sp", "lr"]
CORNERS = (0, 1, 2, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)
CODES = ("eq", "ne", "cs", "cc", "mi", "pl", "vs", "vc", "hi", "ls", "ge", "lt", "gt", "le")
WINDOW = 512   # bytes below and above the stack pointer that are written and read back
BELOW_TOP = 1024
# Its size of a turn is the processor's state, which a debugger does not set: small_programs.py counts its turns.
LEFT_OUT = {"letp"}


def shape(operand):
    if isinstance(operand, int):
        return "#"
    if isinstance(operand, Shift):
        return operand.kind, type(operand.amount).__name__
    if isinstance(operand, Memory):
        base = operand.base if operand.base in ("sp", "pc") else "r"
        return base, type(operand.offset).__name__, operand.scale, operand.writes_back, type(operand.after).__name__
    if isinstance(operand, RegisterList):
        return "list", min(len(operand.names), 3), "pc" in operand.names, operand.names[0][0]
    return "label" if isinstance(operand, Label) else operand if operand in ("sp", "pc", "lr") else operand[:1]


def forms(found):
    """form -> [(instruction, the successors of the block that it ends)]"""
    known = {}
    for start in found.reachable:
        for block in found.program.functions[start].blocks.values():
            for insn in block.instructions:
                form = (insn.operation, insn.condition is not None, insn.sets_flags, insn.writes_back, insn.size,
                        tuple(map(shape, insn.operands)))
                known.setdefault(form, []).append((insn, block if insn is block.last else None))
    return known


def condition_holds(condition, nzcv):
    n, z, c, v = (nzcv >> 3 & 1, nzcv >> 2 & 1, nzcv >> 1 & 1, nzcv & 1)
    return {"eq": z, "ne": not z, "cs": c, "cc": not c, "mi": n, "pl": not n, "vs": v, "vc": not v, "hi": c and not z,
            "ls": not c or z, "ge": n == v, "lt": n != v, "gt": not z and n == v, "le": z or n != v}[condition]


class Draw:
    """A known state, and the same as the processor's numbers."""

    def __init__(self, insn, successors, stack, code, generator, status):
        self.insn, self.stack, self.generator = insn, stack, generator
        registers = {name: self._number() for name in NAMES}
        registers["sp"], registers["lr"] = Pointer(STACK, 0, True), code | 1
        for operand in insn.operands:
            if isinstance(operand, Memory) and operand.base not in ("sp", "pc"):
                registers[operand.base] = self._place()
            if isinstance(operand, Memory) and operand.offset in registers:
                registers[operand.offset] = 0 if insn.operation in ("tbb", "tbh") else 4 * generator.randrange(6)
            if isinstance(operand, Memory) and operand.after in registers:
                registers[operand.after] = 4 * generator.randrange(6)
        if insn.operation in ("ldmia", "ldmdb", "stmia", "stmdb") or insn.operation.startswith(("vldm", "vstm")):
            if insn.operands[0] != "sp":
                registers[insn.operands[0]] = self._place()
        if insn.operation == "bic" and insn.operands[1:2] != ("sp",) and insn.operands[-1] in (7, 15) and generator.random() < 0.5:
            registers[insn.operands[-2]] = Pointer(STACK, generator.randrange(-32, 32), True)
        if insn.operands[:1] == ("sp",) and insn.operands[-1] in registers:
            registers[insn.operands[-1]] = 4 * generator.randrange(32)  # the stack pointer is a multiple of 4, whatever is added
        if insn.operands[:1] == ("pc",) and insn.operation == "mov":
            registers[insn.operands[1]] = generator.choice([target for target, _ in successors if target is not None]) | 1
        pops_pc = any(isinstance(o, RegisterList) and "pc" in o.names or o == "pc" for o in insn.operands)
        words = {offset: code | 1 if pops_pc else self._number() for offset in range(-WINDOW, WINDOW, 4)}
        self.words = dict(words)
        self.nzcv = generator.randrange(16)
        condition = insn.condition
        flags = None
        if condition is not None:
            true, false = (condition, OPPOSITE[condition]) if condition_holds(condition, self.nzcv) else (OPPOSITE[condition], condition)
            flags = Flags("holds", true, false)
        self.state = State(dict(registers), {(STACK, o, 4): w for o, w in words.items()}, flags)
        self.numbers = [self.concrete(registers[name]) for name in NAMES]
        self.status = status | self._flags()

    def _number(self):
        kind = self.generator.randrange(4)
        return self.generator.getrandbits(32) if kind < 2 else self.generator.choice(CORNERS) if kind == 2 else self.generator.randrange(40)

    def _place(self):
        return Pointer(STACK, 4 * self.generator.randrange(-32, 32), True)

    def _flags(self):
        """With the state of an IT block of one, for a conditional instruction that is no branch."""
        condition = self.insn.condition
        block = CODES.index(condition) << 4 | 8 if condition is not None and self.insn.operation != "b" else 0
        return self.nzcv << 28 | (block >> 2) << 10 | (block & 3) << 25

    def concrete(self, value):
        return value if isinstance(value, int) else self.stack + value.offset & MASK

    def contradiction(self, value, real):
        """Whether what is known of a value is not so."""
        if isinstance(value, int):
            return value != real
        if isinstance(value, Low):
            return real & 3 != value.bits
        if isinstance(value, Negated) and value.base == STACK:
            return value.offset - self.stack & MASK != real
        if isinstance(value, Pointer) and value.base == STACK:
            return self.stack + value.offset & MASK != real
        if isinstance(value, Pointer) and value.base.startswith(STACK + "@"):
            _, first, last = value.base.split("@")
            return real & 3 != 0 or not int(first) <= real - self.stack - value.offset <= int(last)
        return False


def compare(draw, after, numbers, status, memory):
    """What is claimed and is not so."""
    wrong = [f"{name} is {real:#x}, not {after.registers[name]}" for name, real in zip(NAMES, numbers)
             if name in after.registers and draw.contradiction(after.registers[name], real)]
    for code in CODES:
        known = holds(code, after.flags)
        if known is not None and bool(known) != bool(condition_holds(code, status >> 28)):
            wrong.append(f"{code} is said to be {known} of {after.flags}, with NZCV {status >> 28:04b}")
    for (base, offset, size), value in after.stack.items():
        if base == STACK and -WINDOW <= offset <= WINDOW - size:
            real = int.from_bytes(memory[WINDOW + offset:WINDOW + offset + size], "little")
            if draw.contradiction(value, real):
                wrong.append(f"sp[{offset}] is {real:#x}, not {value}")
    return wrong


class Processor:
    """One that stands at `main`, where reset has switched everything on."""

    def __init__(self, board, image, main, stack):
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        debug, control = os.path.join(folder, "debug"), os.path.join(folder, "control")
        line = qemu_image.machine(board, image) + ["-serial", "none", "-gdb", f"unix:{debug},server=on,wait=off"]
        power_on = board["qemu"]["power_on"]
        line += ["-S", "-qmp", f"unix:{control},server=on,wait=off"]
        process = stack.enter_context(subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE))
        stack.callback(process.kill)
        if power_on:
            stack.enter_context(contextlib.closing(qemu_image._switch_on(power_on, control, process, starts=False)))
        self.debugger = gdb_remote.Debugger(debug, *((2, 5) if power_on else (1, 1)))
        stack.callback(self.debugger.close)
        self.debugger.run_to(main)
        status = self._registers()[1]
        # Thumb; on a Cortex-R in the mode that it is in, without interrupts.
        self.status = status & 0x1F | 0xE0 if board["cpu"] == "cortex-r5" else 1 << 24

    def step(self, numbers, pc, status, at, memory):
        """(registers and pc, status, memory) after one instruction."""
        self.debugger.write(at, memory)
        self.debugger.ask("G" + struct.pack("<16I", *numbers, pc).hex() + "00" * 100 + struct.pack("<I", status).hex())
        self.debugger.ask("s")
        return *self._registers(), self.debugger.read(at, len(memory))

    def _registers(self):
        data = bytes.fromhex(self.debugger.ask("g"))
        return struct.unpack_from("<16I", data), struct.unpack_from("<I", data, 164)[0]


def check(processor, semantics, insn, block, draw):
    memory = struct.pack(f"<{2 * WINDOW // 4}I", *draw.words.values())
    numbers, status, after_memory = processor.step(draw.numbers, insn.address, draw.status, draw.stack - WINDOW, memory)
    if block is None or block.callee is not None:
        after = semantics.execute(draw.state, insn)
        if numbers[15] != (insn.next if block is None else block.callee):
            return [f"it led to {numbers[15]:#x}"]
        if block is not None:
            after.put("lr", None)
        return compare(draw, after, numbers[:15], status, after_memory)
    single = Block(insn.address, [insn], block.successors)
    state = draw.state if insn.operation in ("b", "bx", "cbz", "cbnz", "le", "tbb", "tbh") else semantics.execute(draw.state, insn)
    edges = branches(state, single)
    went = [after for target, _, after in edges if target is None or target & ~1 == numbers[15]]
    if not went:
        return [f"it led to {numbers[15]:#x}, which was held infeasible"]
    return compare(draw, went[0], numbers[:15], status, after_memory)


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--image", required=True, help="with the root")
    parser.add_argument("--root", default=analysis.STEP)
    parser.add_argument("--draws", type=int, default=6, help="of each form")
    arguments = parser.parse_args()
    board = qemu_image.read_board(arguments.boards, arguments.board)
    found = analysis.Analysis(arguments.image, arguments.root)
    image = found.program.image
    main_at = next(address for name, address, _ in image.functions if name == "main")
    stack_top = next(address for name, address in image.all_symbols if name == "stack_top")
    known, generator, failed, steps = forms(found), random.Random(1), 0, 0
    with contextlib.ExitStack() as stack:
        processor = Processor(board, arguments.image, main_at, stack)
        semantics = Semantics(image)
        for form, places in sorted(known.items(), key=str):
            if form[0] in LEFT_OUT:
                continue
            wrong = []
            for _ in range(arguments.draws):
                insn, block = generator.choice(places)
                draw = Draw(insn, block.successors if block else (), stack_top - BELOW_TOP, main_at, generator, processor.status)
                wrong += [f"{insn}: {text}" for text in check(processor, semantics, insn, block, draw)]
                steps += 1
            if wrong:
                failed += 1
                print(f"FAILED: {wrong[0]}" + (f", and {len(wrong) - 1} more" if len(wrong) > 1 else ""))
    left_out = sum(form[0] in LEFT_OUT for form in known)
    operations = len({form[0] for form in known} - LEFT_OUT)
    print(f"{'FAILED' if failed else 'ok'}: {board['name']}: {len(known) - left_out} forms of {operations} operations, {steps} steps, {failed} wrong; {left_out} left out")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
