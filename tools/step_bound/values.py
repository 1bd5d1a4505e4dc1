# SPDX-License-Identifier: Apache-2.0
"""What the abstract execution knows of a 32-bit value.

    int                              the number itself, 0 to 2^32 - 1
    Pointer(base, offset, aligned)   a named but unknown base, and a known distance; `aligned`: the base is a multiple of 4
    Negated(base, offset, aligned)   the offset less such a base, as loops that run up to an end have it
    Low(bits)                        unknown but for its two lowest bits
    Somewhere(bits)                  made of an address on the stack, at an unknown distance; `bits` as Low has them, or None
    None                             unknown, and not made of an address on the stack

Which of two pointers is the greater is known of addresses alone, which do not wrap around the end of memory: those on the stack, and a root's
arguments that are told to be objects. What else has a name may be any number.
"""

from typing import NamedTuple, Optional

MASK = 0xFFFFFFFF
STACK = "sp"


class Pointer(NamedTuple):
    base: str
    offset: int
    aligned: bool


class Negated(NamedTuple):
    base: str
    offset: int
    aligned: bool


class Low(NamedTuple):
    bits: int


class Somewhere(NamedTuple):
    bits: Optional[int] = None


def is_stack(base):
    """The stack pointer, what it was aligned to, a loop's walk along it, or what may have been loaded of it."""
    return base.startswith(STACK)


def of_stack(value):
    return isinstance(value, Somewhere) or isinstance(value, (Pointer, Negated)) and is_stack(value.base)


def is_address(pointer):
    return pointer.base == STACK or pointer.base.startswith(STACK + "@") or pointer.base.startswith("argument ") and pointer.aligned


def unknown(bits, *made_of):
    """What is made of these values, and known to its two lowest bits at most."""
    bits = None if bits is None else bits & 3
    if any(map(of_stack, made_of)):
        return Somewhere(bits)
    return None if bits is None else Low(bits)


def signed(value):
    value &= MASK
    return value - (1 << 32) if value >> 31 else value


def low(value):
    """The two lowest bits, or None."""
    if isinstance(value, int):
        return value & 3
    if isinstance(value, (Pointer, Negated)):
        return value.offset & 3 if value.aligned else None
    return value.bits if isinstance(value, (Low, Somewhere)) else None


def add(a, b):
    if isinstance(a, int):
        if isinstance(b, int):
            return a + b & MASK
        a, b = b, a
    if isinstance(a, (Pointer, Negated)) and isinstance(b, int):
        return type(a)(a.base, signed(a.offset + b), a.aligned)
    if {type(a), type(b)} == {Pointer, Negated} and a.base == b.base:
        return a.offset + b.offset & MASK
    la, lb = low(a), low(b)
    return unknown(None if la is None or lb is None else la + lb, a, b)


def subtract(a, b):
    if isinstance(b, int):
        return add(a, -b & MASK)
    if isinstance(a, Pointer) and isinstance(b, Pointer) and a.base == b.base:
        return a.offset - b.offset & MASK
    if isinstance(a, int) and isinstance(b, Pointer):
        return Negated(b.base, signed(a - b.offset), b.aligned)
    la, lb = low(a), low(b)
    return unknown(None if la is None or lb is None else la - lb, a, b)


LOGIC = {"and": lambda a, b: a & b, "orr": lambda a, b: a | b, "eor": lambda a, b: a ^ b, "bic": lambda a, b: a & ~b & MASK,
         "orn": lambda a, b: (a | ~b) & MASK}


def logic(kind, a, b):
    if isinstance(a, int) and isinstance(b, int):
        return LOGIC[kind](a, b)
    if kind == "and" and isinstance(a, int):
        a, b = b, a
    la, lb = low(a), low(b)
    if kind == "and" and b == 0:
        return 0
    if kind == "and" and isinstance(b, int) and b <= 3 and la is not None:
        return la & b
    return unknown(None if la is None or lb is None else LOGIC[kind](la, lb), a, b)


SHIFTS = {"lsl": lambda v, n: v << n & MASK if n < 32 else 0, "lsr": lambda v, n: v >> n if n < 32 else 0,
          "asr": lambda v, n: signed(v) >> min(n, 31) & MASK,
          "ror": lambda v, n: (v >> (n & 31) | v << (32 - (n & 31))) & MASK}


def shift(kind, value, amount):
    if isinstance(amount, int):
        amount &= 255
        if isinstance(value, int):
            return SHIFTS[kind](value, amount)
        if amount == 0:
            return value
        if kind == "lsl" and amount in (30, 31) and low(value) is not None:
            return low(value) << amount & MASK
        if kind == "lsl" and amount >= 2:
            return unknown(0, value)
    return unknown(None, value)


def join(a, b):
    if a == b:
        return a
    la = low(a)
    return unknown(la if la == low(b) else None, a, b)


class Flags(NamedTuple):
    """What the flags came from: "compare" a with b, the "sum" of a and b, a "result" a, or "holds": a condition that a branch told, and
    its opposite."""
    kind: str
    a: object
    b: object = 0


def holds(condition, flags):
    """Whether a condition holds: True, False, or None where that is unknown."""
    if flags is None:
        return None
    if flags.kind == "holds":
        return True if flags.a == condition else False if flags.b == condition else None
    if flags.kind == "result":
        if not isinstance(flags.a, int):
            return None
        negative = flags.a >> 31 == 1
        return {"eq": flags.a == 0, "ne": flags.a != 0, "mi": negative, "pl": not negative}.get(condition)
    if flags.kind == "sum":
        carry, value = flags.a + flags.b > MASK, flags.a + flags.b & MASK
        return {"eq": value == 0, "ne": value != 0, "cs": carry, "cc": not carry, "hi": carry and value != 0,
                "ls": not carry or value == 0, "mi": value >> 31 == 1, "pl": value >> 31 == 0}.get(condition)
    return _compared(condition, flags.a, flags.b)


ORDERED = frozenset(("cs", "cc", "hi", "ls", "ge", "lt", "gt", "le"))


def _compared(condition, a, b):
    if isinstance(a, int) and isinstance(b, int):
        sa, sb = signed(a), signed(b)
    elif isinstance(a, Pointer) and isinstance(b, Pointer) and a.base == b.base:
        if condition in ORDERED and not (is_address(a) and is_address(b)):
            return None
        a, b = sa, sb = a.offset, b.offset
    else:
        la, lb = low(a), low(b)
        if condition in ("eq", "ne") and la is not None and lb is not None and la != lb:
            return condition == "ne"
        return {"cc": False, "cs": True}.get(condition) if b == 0 else None
    difference = sa - sb & MASK
    return {"eq": a == b, "ne": a != b, "cs": a >= b, "cc": a < b, "hi": a > b, "ls": a <= b, "mi": difference >> 31 == 1,
            "pl": difference >> 31 == 0, "ge": sa >= sb, "lt": sa < sb, "gt": sa > sb, "le": sa <= sb}.get(condition)
