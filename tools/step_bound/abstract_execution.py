# SPDX-License-Identifier: Apache-2.0
"""Runs the code on what is known of its values, in every calling context, and finds

    how often each loop turns at most, for one entry into it
    how often each edge is taken at most, for one entry into a loop around it
    which edges no run can take

A loop is run turn by turn as long as its exits can be decided; otherwise to a fixed point, and then a flow fact has to bound it.
A context is the chain of the calls' addresses from the root.
"""

from dataclasses import dataclass, field

from .functions import short_name
from .refusal import Refusal
from .semantics import Semantics, branches
from .state import RETURN, State, is_return, join_states, widen
from .values import STACK, Pointer, Somewhere, is_stack, unknown

MOST_TURNS = 2000
POINTER_ARGUMENTS = ("r0", "r1", "r2", "r3")
KEPT_BY_CALLEES = tuple(f"r{i}" for i in range(4, 12))  # by the calling convention, also where their stack words were lost
BACK = "back"


@dataclass
class Findings:
    contexts: dict = field(default_factory=dict)  # context -> the function's start
    feasible: set = field(default_factory=set)    # (context, block, successor, kind)
    turns: dict = field(default_factory=dict)     # (context, head) -> most times back for one entry, None where unknown
    passes: dict = field(default_factory=dict)    # (context, head) -> edge -> most times for one entry


class Execution:
    """`known_words`: (function, register, offset, value): what stands in memory whenever the function is called, and does not change."""

    def __init__(self, program, known_words=()):
        self.program, self.known_words = program, known_words
        self.semantics = Semantics(program.image)
        self.findings = Findings()
        self.loop_names = {}

    # ---- functions --------------------------------------------------------------------------------------------------------
    def call(self, start, state, context):
        """The state after the call, or None if it does not return."""
        function = self.program.function(start)
        self.findings.contexts[context] = start
        entry = state.copy()
        entry.flags = None
        entry.forget(return_address(function).base)
        entry.put("lr", return_address(function))
        self._learn(function, entry)
        if function.irreducible:
            return self._skip(function, entry, context)
        leaving, _ = self._run_region(function, None, function.start, entry, context)
        after = leaving.get(None)
        if after is None:
            return None
        stack = state.registers.get(STACK)
        if not isinstance(stack, Pointer) or after.registers.get(STACK) != stack:
            raise Refusal(f"{function.name}: the stack pointer does not come back as it was")
        after = after.copy()
        after.end_frames(stack)
        for register in KEPT_BY_CALLEES:
            if is_lasting(state.registers.get(register)):
                after.put(register, state.registers[register])
        after.put("r12", None)
        after.put("lr", None)
        after.flags = None
        return after

    def _learn(self, function, state):
        for name, register, offset, value in self.known_words:
            base = state.registers.get(register)
            if short_name(function.name) == name and isinstance(base, Pointer):
                state.stack[(base.base, base.offset + offset, 4)] = value

    def _skip(self, function, entry, context):
        """An irreducible function, as libgcc's division on Armv6-M: taken for one that keeps to the calling convention. If it or what it calls
        stores anything but what it pushes, nothing is known of memory after it."""
        for block in function.blocks.values():
            for target, kind in block.successors:
                self.findings.feasible.add((context, block.start, target, kind))
            if block.callee is not None:
                self.call(block.callee, State({STACK: entry.registers.get(STACK)}), context + (block.last.address,))
        for loop in function.loops:
            self.findings.turns[(context, loop.head)] = None
        made = unknown(None, *(entry.registers.get(register) for register in POINTER_ARGUMENTS))
        below = [self.program.function(start) for start in self.program.reachable(function.start)]
        if any(uses(other, ("str", "stm", "vst")) for other in below):
            made, entry.escaped = Somewhere(), True
            entry.stack = {place: value for place, value in entry.stack.items() if is_return(value) or not is_stack(place[0])}
        if any(other.loops or uses(other, ("ldr", "ldm", "pop")) for other in below if other is not function):
            for name in ("load", "loop"):  # run in states of their own, they gave them anew
                entry.forget(name)
        for register in POINTER_ARGUMENTS:
            entry.put(register, made)
        entry.put("r12", None)
        entry.put("lr", None)
        return entry

    # ---- regions: a function's body, or one turn of a loop --------------------------------------------------------------------
    def _run_region(self, function, loop, head, state, context):
        """(states at what it leads to: blocks outside, None for the return, BACK for the loop's head; passes of each edge)."""
        inside = loop.body if loop else function.blocks.keys()
        at, leaving, passes = {head: state}, {}, {}
        for start in function.order:
            if start not in inside or start not in at:
                continue
            inner = self._inner_loop(function, start, loop)
            if inner is None:
                edges = self._run_block(function, function.blocks[start], at[start], context)
                for target, kind, _ in edges:
                    passes[(start, target, kind)] = 1
            elif inner.head == start:
                edges, inner_passes = self._run_loop(function, inner, at[start], context)
                passes.update(inner_passes)
            else:
                continue  # done with its head
            for target, _, after in edges:
                if loop is not None and target == loop.head:
                    leaving[BACK] = join_states(leaving.get(BACK), after)
                elif target in inside:
                    at[target] = join_states(at.get(target), after)
                else:
                    leaving[target] = join_states(leaving.get(target), after)
        return leaving, passes

    @staticmethod
    def _inner_loop(function, start, loop):
        """The outermost loop around the block that is within `loop`, but not `loop` itself."""
        around = [l for l in function.loops if start in l.body and l is not loop and (loop is None or l.body < loop.body)]
        return max(around, key=lambda l: len(l.body)) if around else None

    def _run_block(self, function, block, state, context):
        state = state.copy()
        for insn in block.instructions[:-1]:
            state = self.semantics.execute(state, insn)
        if block.is_tail_call or (None, "return") in block.successors:
            self._check_return(function, block, state)
        if block.callee is None:
            if insn_decides(block):
                return self._remember(block, branches(state, block), context)
            state = self.semantics.execute(state, block.last)
        else:
            state.put("lr", None)
            state = self.call(block.callee, state, context + (block.last.address,))
            if state is None:
                return []
            if not block.successors:
                raise Refusal(f"a call that returns where its function ends: {block.last}")
        return self._remember(block, branches(state, block), context)

    def _check_return(self, function, block, state):
        """To its caller, and not to any address that happens to be in the register or on the stack."""
        register = "lr" if block.is_tail_call else block.last.operands[0] if block.last.operation == "bx" else "pc"
        if register == "pc":
            state = self.semantics.ran(state.copy(), block.last)
        if state.registers.get(register) != return_address(function):
            raise Refusal(f"{function.name}: a return that is not known to lead to its caller: {block.last}")

    def _remember(self, block, edges, context):
        self.findings.feasible.update((context, block.start, target, kind) for target, kind, _ in edges)
        return edges

    # ---- loops ------------------------------------------------------------------------------------------------------------
    def _run_loop(self, function, loop, entry, context):
        """([(block outside, kind, state)], passes of each edge within it, for this entry)."""
        key = (context, loop.head)
        exits, turns, passes = self._unroll(function, loop, entry, context)
        if turns is None:
            exits = self._to_fixed_point(function, loop, entry, context)
            self.findings.turns[key] = None
            passes = {}
            for start in loop.body:
                passes.update({(start, *successor): None for successor in function.blocks[start].successors})
        else:
            old = self.findings.turns.get(key, 0)
            self.findings.turns[key] = None if old is None else max(old, turns)
            most = self.findings.passes.setdefault(key, {})
            for edge, count in passes.items():
                before = most.get(edge, 0)
                most[edge] = None if count is None or before is None else max(before, count)
        return [(target, "exit", state) for target, state in exits.items()], passes

    def _unroll(self, function, loop, entry, context):
        """(states at the exits, times back, passes), or None for the times where no exit is decided."""
        exits, passes, state, turns = {}, {}, entry, 0
        every_exit = {(start, target) for start, target in loop.exits(function)}
        while True:
            leaving, of_turn = self._run_region(function, loop, loop.head, state, context)
            for edge, count in of_turn.items():
                old = passes.get(edge, 0)
                passes[edge] = None if count is None or old is None else old + count
            for target, after in leaving.items():
                if target != BACK:
                    exits[target] = join_states(exits.get(target), after)
            back = leaving.get(BACK)
            if back is None:
                return exits, turns, passes
            turns += 1
            taken = {(start, target) for start, target, _ in of_turn}
            if back == state or turns > MOST_TURNS or every_exit <= taken:
                return exits, None, passes
            state = back

    def _to_fixed_point(self, function, loop, entry, context):
        name = self.loop_names.setdefault((context, loop.head), f"loop{len(self.loop_names)}:")
        state = entry.copy()
        state.forget(name)
        while True:
            leaving, _ = self._run_region(function, loop, loop.head, state, context)
            wider = widen(state, leaving[BACK], name) if BACK in leaving else state
            if wider == state:
                leaving.pop(BACK, None)
                return leaving
            state = wider


def return_address(function):
    return Pointer(f"{RETURN}{function.start:x};", 0, False)


def uses(function, operations):
    return any(insn.operation.startswith(operations) for block in function.blocks.values() for insn in block.instructions)


def is_lasting(value):
    """Its name, if it has one, is never given anew."""
    return isinstance(value, int) or isinstance(value, Pointer) and (value.base == STACK or value.base.startswith(("argument ", "caller's ")))


def insn_decides(block):
    """The last instruction is a branch alone, with nothing to execute."""
    return block.last.operation in ("b", "bx", "cbz", "cbnz", "le", "letp", "tbb", "tbh")


def run(program, root, known_words=(), aligned_arguments=True):
    """What the root's call can do, whatever its arguments: pointers to objects that are aligned to 4, unless told otherwise."""
    registers = {STACK: Pointer(STACK, 0, True)}
    registers |= {register: Pointer(f"argument {register}", 0, aligned_arguments) for register in POINTER_ARGUMENTS}
    registers |= {f"r{i}": Pointer(f"caller's r{i}", 0, False) for i in range(4, 12)}
    execution = Execution(program, known_words)
    execution.call(root, State(registers), ())
    return execution.findings


def chain(program, findings, context):
    """The calls that lead to a context: Controller::step > Inbox::take."""
    return " > ".join(short_name(program.functions[findings.contexts[context[:i]]].name) for i in range(len(context) + 1))
