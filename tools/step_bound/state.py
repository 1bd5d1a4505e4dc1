# SPDX-License-Identifier: Apache-2.0
"""The registers, flags and stack words that the abstract execution knows at one place.

Memory is kept for the stack alone, and for words that a fact says do not change. Assumed of the code: a store through an address that is not derived from the stack pointer
does not change a known stack word. A name stands for one value at a time: whoever gives it anew calls `forget` first.
"""

from .values import MASK, Low, Negated, Pointer, join, low

STACK = "sp"


def is_stack(base):
    """The stack pointer, what it was aligned to, or a loop's walk along it."""
    return base.startswith(STACK)


def aligned_stack(offset, mask):
    """The stack pointer's distance `offset`, rounded down: its name says from where to where it may lie."""
    return Pointer(f"{STACK}@{offset - mask}@{offset}", 0, True)


def extent(base, offset, size):
    """The bytes that an access may touch, from the stack pointer on; None for anywhere on the stack."""
    if base == STACK:
        return offset, offset + size
    parts = base.split("@")
    return (int(parts[1]) + offset, int(parts[2]) + offset + size) if len(parts) == 3 and parts[0] == STACK else None


def may_overlap(a, b):
    return a is None or b is None or a[0] < b[1] and b[0] < a[1]


class State:
    __slots__ = ("registers", "stack", "flags")

    def __init__(self, registers=None, stack=None, flags=None):
        self.registers, self.stack, self.flags = registers or {}, stack or {}, flags

    def copy(self):
        return State(dict(self.registers), dict(self.stack), self.flags)

    def __eq__(self, other):
        return self.registers == other.registers and self.stack == other.stack and self.flags == other.flags

    def put(self, register, value):
        if value is None:
            self.registers.pop(register, None)
        else:
            self.registers[register] = value

    def load(self, address, size, is_signed):
        """Of the stack. A byte or a halfword of a known word is known."""
        if not isinstance(address, Pointer):
            return None
        value = self.stack.get((address.base, address.offset, size))
        if value is None and size < 4:
            word = self.stack.get((address.base, address.offset & ~3, 4))
            if isinstance(word, int):
                value = word >> 8 * (address.offset & 3) & ((1 << 8 * size) - 1)
        if isinstance(value, int) and is_signed and value >> (8 * size - 1):
            value |= MASK << 8 * size & MASK
        return value

    def store(self, address, size, value):
        if not isinstance(address, Pointer) or not is_stack(address.base):
            return
        written = extent(address.base, address.offset, size)
        for base, offset, width in [place for place in self.stack if is_stack(place[0])]:
            apart = base == address.base and not may_overlap((offset, offset + width), (address.offset, address.offset + size))
            if not apart and may_overlap(written, extent(base, offset, width)):
                del self.stack[(base, offset, width)]
        if value is not None:
            narrow = value & ((1 << 8 * size) - 1) if isinstance(value, int) else value if size == 4 else None
            if narrow is not None:
                self.stack[(address.base, address.offset, size)] = narrow

    def forget(self, name):
        """Names that begin so will be given anew."""
        def kept(value):
            if isinstance(value, (Pointer, Negated)) and value.base.startswith(name):
                return None if low(value) is None else Low(low(value))
            return value
        self.registers = {r: k for r, v in self.registers.items() if (k := kept(v)) is not None}
        self.stack = {s: k for s, v in self.stack.items() if not s[0].startswith(name) and (k := kept(v)) is not None}
        if self.flags is not None and any(isinstance(v, (Pointer, Negated)) and v.base.startswith(name) for v in self.flags[1:]):
            self.flags = None


def join_states(a, b):
    if a is None or b is None or a is b:
        return b if a is None else a
    registers = {r: j for r, v in a.registers.items() if r in b.registers and (j := join(v, b.registers[r])) is not None}
    stack = {s: j for s, v in a.stack.items() if s in b.stack and (j := join(v, b.stack[s])) is not None}
    return State(registers, stack, a.flags if a.flags == b.flags else None)


def widen(state, back, key):
    """The state at a loop's head for any turn, from the state so far and one that a turn led back to.

    What changes gets a name that holds for one turn. Values that change by the same step keep their distance to each other: a
    pointer and the end that runs along with it.
    """
    clean = back.copy()
    clean.forget(key)
    clean.forget(STACK + key)

    def widened(place, old, new, raw):
        if old == new:
            return old
        stem = STACK if isinstance(old, Pointer) and is_stack(old.base) else ""
        if isinstance(old, Pointer) and old.base.startswith(stem + key):
            step = old.base[len(stem + key):].rpartition("+")[2] if "+" in old.base else ""
            if not step or isinstance(raw, Pointer) and raw.base == old.base and str(raw.offset - old.offset) == step:
                return old
        elif isinstance(old, Pointer) and isinstance(new, Pointer) and new.base == old.base:
            return Pointer(f"{stem}{key}{old.base}+{new.offset - old.offset}", old.offset, False)
        return Pointer(f"{stem}{key}{place}", 0, False)

    registers = {r: widened(r, v, clean.registers.get(r), back.registers.get(r)) for r, v in state.registers.items()}
    stack = {s: widened(s, v, clean.stack.get(s), back.stack.get(s)) for s, v in state.stack.items()
             if not s[0].startswith((key, STACK + key))}
    return State(registers, stack, None)
