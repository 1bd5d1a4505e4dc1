# SPDX-License-Identifier: Apache-2.0
"""What each instruction does to the known state. One that is not listed here is refused, not guessed.

Most results are of no use for a loop's bound: `UNKNOWN_RESULT` lists those whose destinations become unknown. Every entry is
tested against QEMU (tests/step_bound).
"""

from . import vector_semantics
from .instruction import OPPOSITE, Memory, Shift
from .refusal import Refusal
from .state import aligned_stack, join_states
from .values import MASK, STACK, Flags, Pointer, Somewhere, add, holds, logic, shift, signed, subtract, unknown

NO_EFFECT = frozenset("nop dmb dsb isb pld pli yield hint cpsid cpsie wfi b bl bx cbz cbnz tbb tbh le letp".split())
UNKNOWN_RESULT = {
    **dict.fromkeys("adc sbc clz rbit rev rev16 revsh ssat usat ssat16 usat16 sel uadd8 usub8 sadd8 sadd16 ssub16 qadd qsub "
                    "uadd16 usub16 smlad smlsd smuad smusd smladx smuadx smlabb smlabt smlatb smlatt smulbb smulbt smultb smultt "
                    "smlawb smlawt smulwb smulwt smmul smmulr smmla smmlar smmls uxtab uxtah sxtab sxtah uxtb16 sxtb16 sbfx bfi bfc "
                    "pkhbt pkhtb mrs cinc cinv cneg cset csetm csel csinc csinv csneg rrx".split(), 1),
    **dict.fromkeys("smull umull smlal umlal umaal smlald smlaldx smlsld smlalbb smlalbt smlaltb smlaltt lsll lsrl asrl".split(), 2),
}
ACCESS = {f"{kind}{suffix}": (kind, width, suffix.startswith("s") and kind == "ldr")
          for kind in ("ldr", "str") for suffix, width in (("", 4), ("d", 4), ("b", 1), ("h", 2), ("sb", 1), ("sh", 2))}


class Semantics:
    def __init__(self, image):
        self.image = image

    def execute(self, state, insn):
        """The state after it; may change the one given."""
        if insn.condition is not None:
            known = holds(insn.condition, state.flags)
            if known is False:
                return state
            if known is None:
                return join_states(self.ran(state.copy(), insn), state)
        return self.ran(state, insn)

    def ran(self, state, insn):
        """The same where its condition holds."""
        operation = insn.operation
        if operation == "bl":  # a far jump, which has the return address of nobody
            state.put("lr", None)
        if operation in NO_EFFECT or operation.startswith("it"):
            return state
        handler = HANDLERS.get(operation)
        if handler is not None:
            handler(self, state, insn)
        elif operation in UNKNOWN_RESULT:
            made = state.made_of(insn.operands)
            for register in insn.operands[:UNKNOWN_RESULT[operation]]:
                state.put(register, made)
            if insn.sets_flags:
                state.flags = None
        elif not vector_semantics.execute(state, insn):
            raise Refusal(f"an unknown instruction: {insn}")
        return state

    # ---- operands ---------------------------------------------------------------------------------------------------------
    def value(self, state, operand):
        if isinstance(operand, int):
            return operand & MASK
        return state.registers.get(operand)

    def last(self, state, operands):
        """The last operand, shifted where a shift follows it."""
        value = self.value(state, operands[0])
        if len(operands) > 1 and isinstance(operands[1], Shift):
            kind, amount = operands[1]
            return unknown(None, value) if kind == "rrx" else shift(kind, value, self.value(state, amount))
        return value

    def address(self, state, insn, memory):
        """Of the access; writes the base back where it has to be."""
        if memory.base == "pc":
            return add(insn.address + 4 & ~3, self.value(state, memory.offset))
        base = state.registers.get(memory.base)
        address = add(base, shift("lsl", self.value(state, memory.offset), memory.scale))
        if memory.writes_back:
            state.put(memory.base, address)
        elif memory.after is not None:
            state.put(memory.base, add(base, self.value(state, memory.after)))
            return base
        return address

    def load(self, state, address, width, is_signed):
        constant = self.image.constant(address, width, is_signed) if isinstance(address, int) else None
        return state.load(address, width, is_signed) if constant is None else constant

    def store(self, state, insn, address, width, value):
        if isinstance(address, int) and self.image.bytes_at(address, 1) is not None:
            raise Refusal(f"a store to what the image says is constant: {insn}")
        state.store(address, width, value)

    @staticmethod
    def named(state, insn, values):
        """Unknown words that were loaded get names, until this instruction runs again."""
        for i, value in enumerate(values):
            if value is None or value == Somewhere():
                name = f"load{insn.address:x}.{i};"
                state.forget(name)
                values[i] = Pointer(name if value is None else STACK + name, 0, False)
        return values


def move(semantics, state, insn):
    value = semantics.last(state, insn.operands[1:])
    if insn.operation == "mvn":
        value = ~value & MASK if isinstance(value, int) else unknown(None, value)
    elif insn.operation == "movt":
        old = state.registers.get(insn.operands[0])
        value = old & 0xFFFF | insn.operands[1] << 16 if isinstance(old, int) else unknown(None, old)
    state.put(insn.operands[0], value)
    if insn.sets_flags:
        state.flags = Flags("result", value) if isinstance(value, int) else None


def three_operands(operands):
    """`add r0, r1` is `add r0, r0, r1`."""
    if len(operands) == 2 or isinstance(operands[2], Shift):
        return (operands[0], operands[0], *operands[1:])
    return operands


def sources(semantics, state, insn):
    operands = three_operands(insn.operands)
    a = insn.address + 4 & ~3 if operands[1] == "pc" else semantics.value(state, operands[1])
    return operands[0], a, semantics.last(state, operands[2:])


def arithmetic(semantics, state, insn):
    if insn.operation == "neg":
        target, a, b = insn.operands[0], 0, semantics.value(state, insn.operands[1])
    else:
        target, a, b = sources(semantics, state, insn)
    if insn.operation == "rsb":
        a, b = b, a
    adds = insn.operation in ("add", "addw")
    value = add(a, b) if adds else subtract(a, b)
    state.put(target, value)
    if insn.sets_flags and adds:
        state.flags = Flags("sum", a, b) if isinstance(a, int) and isinstance(b, int) else None
    elif insn.sets_flags:
        state.flags = Flags("compare", a, b) if a is not None and b is not None else None


def bitwise(semantics, state, insn):
    target, a, b = sources(semantics, state, insn)
    if insn.operation == "bic" and isinstance(a, Pointer) and b in (7, 15) and a.base == STACK:
        value = aligned_stack(a.offset, b)  # a frame that wants more than the stack's own 8 bytes
    else:
        value = logic(insn.operation, a, b)
    state.put(target, value)
    if insn.sets_flags:
        state.flags = Flags("result", value) if isinstance(value, int) else None


def shifts(semantics, state, insn):
    target, a, b = sources(semantics, state, insn)
    value = shift(insn.operation, a, b)
    state.put(target, value)
    if insn.sets_flags:
        state.flags = Flags("result", value) if isinstance(value, int) else None


def compare(semantics, state, insn):
    a, b = semantics.value(state, insn.operands[0]), semantics.last(state, insn.operands[1:])
    if insn.operation == "cmp":
        state.flags = Flags("compare", a, b) if a is not None and b is not None or b == 0 else None
    elif insn.operation == "cmn":
        state.flags = Flags("sum", a, b) if isinstance(a, int) and isinstance(b, int) else None
    else:
        result = logic("and" if insn.operation == "tst" else "eor", a, b)
        state.flags = Flags("result", result) if isinstance(result, int) else None


def multiply(semantics, state, insn):
    operands = three_operands(insn.operands) if insn.operation == "mul" else insn.operands
    values = [semantics.value(state, operand) for operand in operands[1:]]
    result = state.made_of(insn.operands)
    if all(isinstance(value, int) for value in values):
        product = values[0] * values[1]
        result = product if insn.operation == "mul" else values[2] + (product if insn.operation == "mla" else -product)
        result &= MASK
    state.put(operands[0], result)
    if insn.sets_flags:
        state.flags = None


def divide(semantics, state, insn):
    target, a, b = sources(semantics, state, insn)
    value = unknown(None, a, b)
    if isinstance(a, int) and isinstance(b, int):
        if insn.operation == "sdiv":
            a, b = signed(a), signed(b)
        value = 0 if b == 0 else abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1) & MASK
    state.put(target, value)


def extend(semantics, state, insn):
    value, bits = semantics.value(state, insn.operands[1] if len(insn.operands) > 1 else insn.operands[0]), 8
    if insn.operation.endswith("h"):
        bits = 16
    if isinstance(value, int) and not any(isinstance(operand, Shift) for operand in insn.operands):
        value &= (1 << bits) - 1
        if insn.operation.startswith("s") and value >> bits - 1:
            value |= MASK << bits & MASK
    else:
        value = unknown(None, value)
    state.put(insn.operands[0], value)


def field(semantics, state, insn):
    value = semantics.value(state, insn.operands[1])
    first, bits = insn.operands[2:4]
    state.put(insn.operands[0], value >> first & (1 << bits) - 1 if isinstance(value, int) else unknown(None, value))


def access(semantics, state, insn):
    kind, width, is_signed = ACCESS[insn.operation]
    memory = next(operand for operand in insn.operands if isinstance(operand, Memory))
    registers = insn.operands[:2] if insn.operation.endswith("d") else insn.operands[:1]
    stored = [state.registers.get(register) for register in registers]
    address = semantics.address(state, insn, memory)
    if kind == "str":
        for i, value in enumerate(stored):
            semantics.store(state, insn, add(address, 4 * i), width, value)
        return
    values = [semantics.load(state, add(address, 4 * i), width, is_signed) for i in range(len(registers))]
    for register, value in zip(registers, semantics.named(state, insn, values) if width == 4 else values):
        state.put(register, value)


def several(semantics, state, insn):
    """push, pop, ldm, stm."""
    stack = insn.operation in ("push", "pop")
    base = STACK if stack else insn.operands[0]
    names = insn.operands[-1].names
    downward = insn.operation in ("push", "stmdb", "ldmdb")
    start = state.registers.get(base)
    first = add(start, -4 * len(names) & MASK) if downward else start
    if insn.operation in ("push", "stmia", "stmdb"):
        for i, name in enumerate(names):
            semantics.store(state, insn, add(first, 4 * i), 4, state.registers.get(name))
    else:
        values = [semantics.load(state, add(first, 4 * i), 4, False) for i in range(len(names))]
        for name, value in zip(names, semantics.named(state, insn, values)):
            state.put(name, value)
    if stack or insn.writes_back and not (base in names and not downward and insn.operation == "ldmia"):
        state.put(base, first if downward else add(start, 4 * len(names)))


def start_loop(semantics, state, insn):
    """Low-overhead loops: lr counts turns, or elements where the tail is predicated."""
    state.put("lr", semantics.value(state, insn.operands[1]))
    _, _, bits = insn.operation.partition("tp.")
    state.put("elements a turn", 128 // int(bits) if bits else 1)


HANDLERS = {
    **dict.fromkeys(("mov", "movw", "movt", "mvn"), move),
    **dict.fromkeys(("add", "addw", "sub", "subw", "rsb", "neg"), arithmetic),
    **dict.fromkeys(("and", "orr", "eor", "bic", "orn"), bitwise),
    **dict.fromkeys(("lsl", "lsr", "asr", "ror"), shifts),
    **dict.fromkeys(("cmp", "cmn", "tst", "teq"), compare),
    **dict.fromkeys(("mul", "mla", "mls"), multiply),
    **dict.fromkeys(("udiv", "sdiv"), divide),
    **dict.fromkeys(("uxtb", "uxth", "sxtb", "sxth"), extend),
    "ubfx": field,
    **dict.fromkeys(ACCESS, access),
    **dict.fromkeys(("push", "pop", "ldmia", "ldmdb", "stmia", "stmdb"), several),
    **dict.fromkeys(("dls", "wls", *(f"{kind}tp.{bits}" for kind in ("dls", "wls") for bits in (8, 16, 32, 64))), start_loop),
    "msr": lambda _, state, insn: setattr(state, "flags", None),
}


def branches(state, block):
    """[(successor, kind, state)] that the block's last instruction may lead to."""
    out = []
    known, refine = _decision(state, block)
    for target, kind in block.successors:
        goes = kind != "falls"
        if known is not None and len(block.successors) > 1 and kind != "table" and goes != known:
            continue
        after = state.copy()
        if refine is not None:
            refine(after, goes)
        out.append((target, kind, after))
    return out


def _decision(state, block):
    """(whether the last instruction jumps, what is known on either side of it)."""
    insn = block.last
    if insn.operation in ("cbz", "cbnz"):
        register, on_zero = insn.operands[0], insn.operation == "cbz"
        value = state.registers.get(register)
        known = (value == 0) == on_zero if isinstance(value, int) else None
        return known, lambda after, goes: after.put(register, 0) if goes == on_zero else None
    if insn.operation in ("le", "letp"):
        return _loop_end(state, insn)
    if insn.operation.startswith("wls"):
        count = state.registers.get("lr")
        return count == 0 if isinstance(count, int) else None, None
    if insn.condition is None or block.callee is not None:
        return None, None
    condition = insn.condition

    def refine(after, goes):
        holding = condition if goes else OPPOSITE[condition]
        if after.flags is None:
            after.flags = Flags("holds", holding, OPPOSITE[holding])
        before = block.instructions[-2] if len(block.instructions) > 1 else None
        if holding == "eq" and before is not None and before.operation == "cmp" and before.condition is None and \
                isinstance(before.operands[1], int):
            after.put(before.operands[0], before.operands[1] & MASK)
    return holds(condition, state.flags), refine


def _loop_end(state, insn):
    if len(insn.operands) == 1:  # `le label`: for ever
        return True, None
    count = state.registers.get("lr")
    step = state.registers.get("elements a turn") if insn.operation == "letp" else 1
    known = count > step if isinstance(count, int) and isinstance(step, int) else None
    return known, lambda after, goes: after.put("lr", subtract(count, step)) if goes else None
