# SPDX-License-Identifier: Apache-2.0
"""What is made wrong, one thing at a time, and the small program (small_programs.py) that must show it.

ANALYSIS: a part of the analysis does something else, until what the change returned is called.
FACTS: a program with other flow facts.
CODE: the program's source changed; its bound has to rise.
"""

from small_programs import PROGRAMS
from step_bound import abstract_execution, bound, decoder, functions, jump_tables, linear_program, loops, semantics, state, values

M4, M0, M55 = 0, 1, 2  # of small_programs.CORES


def replaced(owner, name, new):
    """`new`: made of the old one. An attribute, or an entry of a table."""
    is_table = isinstance(owner, dict)
    old = owner[name] if is_table else owner.__dict__[name]
    plain = old.__func__ if isinstance(old, staticmethod) else old

    def put(value):
        if is_table:
            owner[name] = value
        else:
            setattr(owner, name, value)
    put(staticmethod(new(plain)) if isinstance(old, staticmethod) else new(plain))
    return lambda: put(old)


def handler(name, new):
    return lambda: replaced(semantics.HANDLERS, name, new)


def off_by_one(old):
    def changed(its, now, insn):
        old(its, now, insn)
        now.put(insn.operands[0], values.add(now.registers.get(insn.operands[0]), 1))
    return changed


def shorter_loops(old):
    def changed(*arguments):
        exits, turns, passes = old(*arguments)
        return exits, turns and turns - 1, {edge: count and count - 1 for edge, count in passes.items()}
    return changed


def other_number(old):
    """objdump's first comparison has another number: the second decoder has to object."""
    def changed(image):
        found = old(image)
        for insn in found.values():
            if insn.operation == "cmp" and isinstance(insn.operands[-1], int):
                insn.text = insn.text.replace(f"#{insn.operands[-1]}", f"#{insn.operands[-1] + 1}")
        return found
    return changed


def looser_problem(old):
    """GLPK is given other rows than those that its answer is held to."""
    def changed(self):
        rows, self.rows = self.rows, [(terms, most + (1 if equal else 0), equal) for terms, most, equal in self.rows]
        problem = old(self)
        self.rows = rows
        return problem
    return changed


ANALYSIS = {
    "a move that is one more": ("nested", M4, handler("mov", off_by_one)),
    "an addition that adds one more": ("nested", M4, handler("add", off_by_one)),
    "an addition that is a move": ("triangular", M4, handler("add", lambda old: semantics.move)),
    "a subtraction that is a move": ("nested", M4, handler("sub", lambda old: semantics.move)),
    "a comparison that is always equal": ("nested", M4, handler("cmp", lambda old: lambda s, now, insn: setattr(
        now, "flags", values.Flags("result", 0)))),
    "an extension of a byte that is a move": ("byte", M4, handler("uxtb", lambda old: semantics.move)),
    "a store that is forgotten": ("counted on the stack", M4, lambda: replaced(state.State, "store", lambda old: lambda *rest: None)),
    "a loop of a count that begins at one more": ("low overhead", M55, handler("dls", lambda old: lambda s, now, insn: now.put(
        "lr", values.add(s.value(now, insn.operands[1]), 1)))),
    "an instruction that is not known": ("nested", M4, handler("cmp", lambda old: None)),
    "conditions that are swapped": ("nested", M4, lambda: replaced(semantics, "holds", lambda old: lambda condition, flags: (
        None if old(condition, flags) is None else not old(condition, flags)))),
    "loops that are one turn short": ("chain", M4, lambda: replaced(abstract_execution.Execution, "_unroll", shorter_loops)),
    "a switch's guard that lets one less through": ("switch", M4, lambda: replaced(
        jump_tables.JumpTables, "entries", lambda old: lambda *arguments: old(*arguments) - 1)),
    "a call whose function is not counted": ("tail", M0, lambda: replaced(bound.Bound, "_add_context", lambda old: lambda its, context, *rest: (
        None if context else old(its, context, *rest)))),
    "blocks that cost one less": ("straight", M4, lambda: replaced(bound.Bound, "__init__", lambda old: lambda its, *rest: old(
        its, *rest, block_cost=lambda block: len(block.instructions) - 1))),
    "an edge that is lost": ("early", M4, lambda: replaced(abstract_execution, "branches", lambda old: lambda *rest: old(*rest)[:1])),
    "a loop that is not seen": ("data", M4, lambda: replaced(loops, "_find", lambda old: lambda function: (
        old(function), setattr(function, "loops", []))[0])),
    "two decoders that differ in a number": ("nested", M4, lambda: replaced(decoder, "disassemble", other_number)),
    "a call that nobody comes back from, taken to come back": ("never comes back", M4, lambda: replaced(
        functions.Program, "_is_last", lambda old: lambda *rest: False)),
    "a register of the callee's, taken to be kept": ("count of a callee", M0, lambda: replaced(
        abstract_execution, "KEPT_BY_CALLEES", lambda old: ("r0", "r1", "r2", "r3", *old))),
    "turns of a device's wait that are not counted": ("waiting", M4, lambda: replaced(bound.Bound, "_bound_loop", lambda old: lambda its, context, function, loop: (
        old(its, context, function, loop), [its.lp.row([(1, v)], 0) for start in loop.latches for target, kind in function.blocks[start].successors
                                            if (v := its.edges.get((context, start, target, kind))) is not None and target == loop.head])[0])),
    "a program for GLPK that is another": ("nested", M4, lambda: replaced(linear_program.LinearProgram, "_problem", looser_problem)),
}

FACTS = {
    "a false fact: a turn too few": ("data", M4, [("loop", "work", 19)]),
    "a fact that is missing": ("data", M4, []),
    "a false fact: a call that is never made": ("tail", M4, [("calls", "helper", 0)]),
    "a false fact: a quotient of 16 bits": ("division", M0, [("back", "__udivsi3", 0)]),
    "a wait for a device without a bound": ("waiting", M4, []),
    "a wait for a device, a turn too few": ("waiting", M4, [("turns", "work", 2)]),
    "a FIFO that is one deeper than the fact": ("reception", M0, [("turns", "work", 2)]),
    "a call in one context, where there are two": ("two readers", M4, [("calls", "read", 2, {"contexts": 2})]),
    "a fact that allows more for a call that is not there": ("two readers", M4, [("calls", "read", 0, {"plus": ["write"]})]),
    "a false fact: fewer calls in a context": ("two readers", M4, [("calls", "read", 1, {"contexts": 1})]),
    "a false fact: a signed quotient of 26 bits": ("signed division", M0, [("back", "__divsi3", [2, 3])]),
}

CODE = {
    "a loop one turn longer": ("nested", "i < 5", "i < 6"),
    "an inner loop one turn longer": ("triangular", "k < i;", "k <= i;"),
    "a call added": ("tail", "return helper(x)", "return helper(helper(x))"),
    "an exit removed": ("chain", "low(11)", "low(12)"),
    "an interrupt's handler that takes one thing more": ("reception", "sink = x; return x + 1", "sink = x; sink = x; return x + 1"),
    "a longer case": ("switch", "sink = 7; return 8", "sink = 7; sink = 8; sink = 9; return 8"),
}

for name, (program, _, facts) in FACTS.items():
    assert PROGRAMS[program].get("facts", ()) != facts, name
