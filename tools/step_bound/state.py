# SPDX-License-Identifier: Apache-2.0
"""The registers, flags and stack words that the abstract execution knows at one place.

Memory is kept for the stack alone, and for words that a fact says do not change. Assumed of the code: a store through an address that is not made of one on the stack does not
change a stack word, and none at an unknown place of the stack changes a return address. A name stands for one value at a time: whoever gives it anew calls `forget` first.
"""

from .values import MASK, STACK, Negated, Pointer, Somewhere, is_stack, join, low, of_stack, unknown

RETURN = "return "


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


def is_return(value):
    return isinstance(value, Pointer) and value.base.startswith(RETURN)


class State:
    """`escaped`: an address on the stack may stand anywhere in memory where nothing else is known. Else what is not known of a word is no such address."""

    __slots__ = ("registers", "stack", "flags", "escaped")

    def __init__(self, registers=None, stack=None, flags=None, escaped=False):
        self.registers, self.stack, self.flags, self.escaped = registers or {}, stack or {}, flags, escaped

    def copy(self):
        return State(dict(self.registers), dict(self.stack), self.flags, self.escaped)

    def __eq__(self, other):
        return self.registers == other.registers and self.stack == other.stack and self.flags == other.flags and self.escaped == other.escaped

    def put(self, register, value):
        if value is None:
            self.registers.pop(register, None)
        else:
            self.registers[register] = value

    def made_of(self, operands):
        """What may become of them where that is not known: an address on the stack, if one of them is."""
        return unknown(None, *(self.registers.get(operand) for operand in operands if isinstance(operand, str)))

    def load(self, address, size, is_signed):
        """Of the stack. A byte or a halfword of a known word is known."""
        value = self.stack.get((address.base, address.offset, size)) if isinstance(address, Pointer) else None
        if value is None and size < 4 and isinstance(address, Pointer):
            word = self.stack.get((address.base, address.offset & ~3, 4))
            if isinstance(word, int):
                value = word >> 8 * (address.offset & 3) & ((1 << 8 * size) - 1)
        if value is None and (self.escaped or of_stack(address) and any(of_stack(self.stack[place]) for place in self._touched(address, size))):
            return Somewhere()
        if isinstance(value, int) and is_signed and value >> (8 * size - 1):
            value |= MASK << 8 * size & MASK
        return value

    def _touched(self, address, size):
        """The places of which an access through an address on the stack may touch a byte."""
        if not isinstance(address, Pointer):
            return [place for place in self.stack if is_stack(place[0])]
        base, first = address.base, address.offset
        accessed = extent(base, first, size)
        return [(b, offset, width) for b, offset, width in self.stack if is_stack(b) and may_overlap(accessed, extent(b, offset, width)) and
                (b != base or may_overlap((offset, offset + width), (first, first + size)))]

    def store(self, address, size, value):
        if not of_stack(address):
            self.escaped = self.escaped or of_stack(value)
            return
        is_exact = isinstance(address, Pointer)
        for place in self._touched(address, size):
            base, offset, width = place
            old = self.stack[place]
            if is_exact and base == address.base and address.offset <= offset and offset + width <= address.offset + size:
                del self.stack[place]
            elif of_stack(old):
                self.stack[place] = Somewhere()
            elif not (is_return(old) and not (is_exact and extent(address.base, 0, 1))):
                del self.stack[place]
        if not is_exact:
            self.escaped = self.escaped or of_stack(value)
        elif value is not None:
            narrow = value & ((1 << 8 * size) - 1) if isinstance(value, int) else value if size == 4 else unknown(None, value)
            if narrow is not None:
                self.stack[(address.base, address.offset, size)] = narrow

    def end_frames(self, pointer):
        """What lies below the stack pointer is nobody's: an interrupt may write there."""
        self.stack = {s: v for s, v in self.stack.items() if not ((e := extent(*s)) and e[1] <= pointer.offset)}

    def forget(self, name):
        """Names that begin so will be given anew, also those that may be of the stack."""
        name = (name, STACK + name)
        for place in [s for s in self.stack if s[0].startswith(name)]:
            self.escaped = self.escaped or of_stack(self.stack.pop(place))
        for known in (self.registers, self.stack):
            for place in [p for p, v in known.items() if isinstance(v, (Pointer, Negated)) and v.base.startswith(name)]:
                known[place] = unknown(low(known[place]), known[place])
                if known[place] is None:
                    del known[place]
        if self.flags is not None and any(isinstance(v, (Pointer, Negated)) and v.base.startswith(name) for v in self.flags[1:]):
            self.flags = None


def join_states(a, b):
    if a is None or b is None or a is b:
        return b if a is None else a
    def joined(a, b):
        return {place: value for place in (*a, *(p for p in b if p not in a)) if (value := join(a.get(place), b.get(place))) is not None}
    return State(joined(a.registers, b.registers), joined(a.stack, b.stack), a.flags if a.flags == b.flags else None, a.escaped or b.escaped)


def widen(state, back, key):
    """The state at a loop's head for any turn, from the state so far and one that a turn led back to.

    What changes gets a name that holds for one turn. Values that change by the same step keep their distance to each other: a
    pointer and the end that runs along with it.
    """
    clean = back.copy()
    clean.forget(key)

    def widened(place, old, new, raw):
        if old == new:
            return old
        stem = STACK if of_stack(old) or of_stack(new) else ""
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
    for new, known in ((clean.registers, registers), (clean.stack, stack)):
        known |= {place: Somewhere() for place, value in new.items() if place not in known and of_stack(value)}
    return State(registers, stack, None, state.escaped or clean.escaped)
