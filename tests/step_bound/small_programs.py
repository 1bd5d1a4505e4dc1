# SPDX-License-Identifier: Apache-2.0
"""Small programs in C. `main` calls `work`, whose bound is proved, with what makes it run longest.

    facts           [(kind, chain, at most, {what else})]: see tools/step_bound/facts.py; the last may be left out
    loose           the share by which the bound may be above the longest run, and why in a comment; 0 without it
    refused         texts of which a refusal may hold one; always_refused: it must
    only            the one core that it is for
"""

LEVELS = ("-O1", "-O2", "-Os")
CORES = (
    {"cpu": "cortex-m4", "flags": ["-mfloat-abi=soft"], "machine": "mps2-an386", "rom": "0x00000000", "ram": "0x20000000"},
    {"cpu": "cortex-m0plus", "flags": [], "machine": "microbit", "rom": "0x00000000", "ram": "0x20000000"},
    {"cpu": "cortex-m55", "flags": ["-mfloat-abi=hard"], "machine": "mps3-an547", "rom": "0x10000000", "ram": "0x21000000"},
)
QUIET = "#define APART __attribute__((noinline, noclone))\nvolatile unsigned sink; unsigned data[64];\n"


def program(body, calls="sink = work(7)", **more):
    return {"source": QUIET + body + "\nint main(void) { for (unsigned i = 0; i < 64; ++i) data[i] = i; " + calls + "; return 0; }\n", **more}


PROGRAMS = {
    "straight": program("APART unsigned work(unsigned x) { return x * 3 + 1; }"),
    "nested": program("APART unsigned work(unsigned x) { for (int i = 0; i < 5; ++i) for (int k = 0; k < 7; ++k) sink = x + i * k; return x; }"),
    "triangular": program("APART unsigned work(unsigned x) { for (int i = 0; i < 9; ++i) for (int k = 0; k < i; ++k) sink = x + k; return x; }"),
    # A value that is searched for may be the last, or none: the longest run finds none.
    "early": program("APART unsigned work(unsigned x) { for (unsigned i = 0; i < 20; ++i) if (data[i] == x) return i; return 99; }", "sink = work(1000); sink = work(3)", loose=0.05),
    "data": program("APART unsigned work(unsigned n) { unsigned sum = 0; for (unsigned i = 0; i < n; ++i) sum += data[i]; return sum; }", "sink = work(20); sink = work(3)",
                    facts=[("loop", "work", 20)], refused=("the loop at",), loose=0.25),
    "bits": program("APART unsigned work(unsigned x) { unsigned n = 0; for (unsigned m = 0x80000000U; m != 0; m >>= 1) n += (x & m) != 0; return n; }", "sink = work(0xFFFFFFFFU)", loose=0.2),
    "halving": program("APART unsigned work(unsigned x) { for (unsigned m = 0x80000000U; m != 0; m >>= 1) sink = m; return x; }"),
    "switch": program("APART unsigned work(unsigned x) { switch (x) { case 0: return 7; case 1: sink = 1; return 9; case 2: sink = 2; sink = 3; return 1;"
                      " case 3: sink = 5; sink = 6; sink = 7; return 8; case 4: sink = 4; return 2; case 5: sink = 9; sink = 1; return 3; default: return 0; } }",
                      "for (unsigned i = 0; i < 8; ++i) sink = work(i)", refused=("a helper that jumps by its return address",), loose=0.1),
    "tail": program("APART unsigned helper(unsigned x) { for (int i = 0; i < 4; ++i) sink = x; return x + 2; }\nAPART unsigned work(unsigned x) { sink = x; return helper(x); }"),
    "chain": program("APART unsigned low(unsigned n) { unsigned s = 0; for (unsigned i = 0; i < n; ++i) { s += i; sink = s; } return s; }\n"
                     "APART unsigned work(unsigned x) { return low(3) + low(11) + x; }"),
    # Where there is no instruction for it, the longest run has a quotient of ones alone.
    "division": program("APART unsigned work(unsigned x) { return 0xFFFFFFFFU / x; }", "sink = work(1); sink = work(7); sink = work(3); sink = work(0xFFFFFFFFU); sink = work(1000000U)",
                        facts=[("back", "__udivsi3", 2)], loose=0.1),
    "signed division": program("APART int work(int x) { return -0x7FFFFFFF / x; }", "sink = work(1); sink = work(-1); sink = work(7); sink = work(-123456); sink = work(2000000000)",
                               facts=[("back", "__divsi3", [2, 4])], loose=0.1),
    "byte": program("APART unsigned work(unsigned x) { for (unsigned char i = 250; i != 4; ++i) sink = i; return x; }"),
    "counted on the stack": program("APART unsigned work(unsigned x) { volatile unsigned i; for (i = 0; i < 6; ++i) sink = x; return x; }"),
    "copies": program("#include <string.h>\nunsigned to[64];\nAPART unsigned work(unsigned x) { memcpy(to, data, 44); memset(to + 11, 0, 20); return to[x]; }", loose=0.05),
    "shared ends": program("APART unsigned work(unsigned x) { if (x & 1) { sink = 1; sink = 2; for (int i = 0; i < 3; ++i) sink = 7; return x; } sink = 3; for (int i = 0; i < 6; ++i)"
                           " sink = 7; return x; }", "sink = work(1); sink = work(2)", loose=0.1),
    "spilled": program("APART unsigned work(unsigned x) { volatile unsigned kept[8]; for (int i = 0; i < 8; ++i) kept[i] = x; unsigned s = 0; for (int i = 7; i >= 0; --i)"
                       " s += kept[i]; return s; }"),
    "low overhead": program("APART unsigned work(unsigned x) { unsigned s = x; for (int i = 0; i < 33; ++i) __asm volatile(\"add %0, %0, #1\" : \"+r\"(s)); return s; }",
                            only="cortex-m55"),
    "helium": program("#include <arm_mve.h>\nshort a[32], b[32];\nAPART int work(int x) { int s = x; for (int i = 0; i < 32; i += 8) s = vmladavaq_s16(s, vld1q_s16(a + i), vld1q_s16(b + i));"
                      " return s; }", only="cortex-m55"),
    # As a port that waits for a device, a FIFO that is emptied, and an end that nobody comes back from.
    "waiting": program("volatile unsigned busy, full; APART unsigned work(unsigned x) { while (busy != 0) busy = busy - 1; sink = x;"
                       " while (full != 0) { full = full - 1; sink = x; } return x; }", "busy = 2; full = 3; sink = work(1)",
                       facts=[("turns", "work", 5)], refused=("the loop at",), loose=0.5),
    "reception": program("volatile unsigned pending; APART unsigned read(unsigned x) { sink = x; return x + 1; } APART unsigned work(unsigned x) { while (pending != 0) { x = read(x);"
                         " pending = pending - 1; } return x; }", "pending = 4; sink = work(1)", facts=[("turns", "work", 4)], refused=("the loop at",), loose=0.25),
    "never comes back": program("APART __attribute__((noreturn)) void stop(void) { for (;;) sink = 1; }\nAPART unsigned work(unsigned x) { sink = x; if (x > 9) stop(); sink = 2; return x; }"),
    "count of a callee": program("__attribute__((noipa)) unsigned seven(unsigned x) { sink = x; return 7; }\n"
                                 "APART unsigned work(unsigned x) { unsigned n = seven(3); for (unsigned i = 0; i != n; ++i) sink = x; return n; }"),
    "two readers": program("APART unsigned read(unsigned n) { unsigned s = 0; if (n > 1) { for (int i = 0; i < 9; ++i) sink = i; s = n; } return s; }\n"
                           "APART unsigned top(unsigned n) { unsigned s = 0; for (unsigned i = 0; i < 3; ++i) if (data[i] != n) s += read(i); return s; }\n"
                           "APART unsigned work(unsigned x) { return top(x) + 1; }", "sink = work(1); sink = work(2)", facts=[("calls", "read", 2, {"contexts": 1})],
                           loose=0.5),
    # What the analysis must not know: a count on the stack that is overwritten through an address which it has lost sight of, a number that wraps, a switch whose guard was left out.
    "an index": program("APART unsigned work(unsigned x) { unsigned n[4] = {3, 3, 3, 3}; n[x & 3] = 40; unsigned k = n[1]; for (unsigned i = 0; i < k; ++i) sink = i; return x; }",
                        "sink = work(1)", refused=("the loop at",), always_refused=True),
    "an index of bytes": program("APART unsigned work(unsigned x) { unsigned char n[8] = {3, 3, 3, 3, 3, 3, 3, 3}; n[x] = 40; for (unsigned i = 0; i < n[4]; ++i) sink = i; return n[x + 1]; }",
                                 "sink = work(4)", refused=("the loop at",), always_refused=True),
    "one of two": program("APART unsigned work(unsigned x) { volatile unsigned a = 3, b = 3; volatile unsigned *p = x ? &a : &b; *p = 40; unsigned k = a; for (unsigned i = 0; i < k; ++i) sink = i;"
                          " return x; }", "sink = work(1)", refused=("the loop at",), always_refused=True),
    "a kept address": program("volatile unsigned *volatile kept; APART void set(unsigned v) { *kept = v; }\nAPART unsigned work(unsigned x) { volatile unsigned a = 3; kept = &a; set(40);"
                              " unsigned k = a; for (unsigned i = 0; i < k; ++i) sink = i; return x; }", "sink = work(1)", refused=("the loop at",), always_refused=True),
    "an irreducible callee": program("APART void odd(unsigned x, volatile unsigned *p) { *p = 40; __asm volatile(\"cmp %0, #3\\n bne 2f\\n 1: nop\\n nop\\n nop\\n nop\\n 2: subs %0, %0, #1\\n nop\\n"
                                     " nop\\n nop\\n nop\\n bpl 1b\" : \"+l\"(x) : : \"cc\"); }\nAPART unsigned work(unsigned x) { volatile unsigned a = 3; odd(5, &a); unsigned k = a;"
                                     " for (unsigned i = 0; i < k; ++i) sink = i; return x; }", "sink = work(2)", facts=[("back", "odd", 8)], refused=("the loop at",),
                                     always_refused=True, only="cortex-m4"),
    "scattered": program("#include <arm_mve.h>\nAPART unsigned work(unsigned x) { unsigned n[4] = {3, 3, 3, 3}; vstrwq_scatter_shifted_offset_u32(n, vdupq_n_u32(1), vdupq_n_u32(40));"
                         " unsigned k = *(volatile unsigned *)(n + 1); for (unsigned i = 0; i < k; ++i) sink = i; return n[x & 3]; }", "sink = work(2)", refused=("the loop at",),
                         always_refused=True, only="cortex-m55"),
    "a number that wraps": program("APART unsigned work(unsigned n) { unsigned k = 0; for (unsigned i = n; i <= n + 4; ++i) { sink = i; if (++k == 40) break; } return k; }",
                                   "sink = work(-5); sink = work(5)", loose=0.05),
    "no guard": program("APART unsigned work(unsigned x) { if (x == 2) sink = 1; switch (x) { case 0: return 7; case 1: sink = 1; return 9; case 2: sink = 2; sink = 3; return 1; case 3: sink = 5;"
                        " sink = 6; return 8; case 4: sink = 4; return 2; case 5: sink = 9; sink = 1; sink = 5; sink = 4; sink = 9; sink = 8; return 3; default: __builtin_unreachable(); } }",
                        "for (unsigned i = 0; i < 6; ++i) sink = work(i)", refused=("no guard", "a helper that jumps"), loose=0.1),
    "a return to data": program("unsigned work(unsigned x, void *p);\n__asm(\".thumb_func\\n.type work, %function\\n.global work\\nwork: push {r1}\\n pop {pc}\\n.size work, . - work\\n\");",
                                "sink = work(1, main)", refused=("a return that is not known",), always_refused=True),
    "a far jump that is a call": program("unsigned work(unsigned x);\n__asm(\".thumb_func\\n.type work, %function\\n.global work\\nwork: mov r3, lr\\n bl 1f\\n movs r1, #20\\n 2: subs r1, r1, #1\\n"
                                         " bne 2b\\n bx r3\\n 1: movs r0, #1\\n bx lr\\n.size work, . - work\\n\");", "sink = work(1)",
                                         refused=("a return that is not known",), always_refused=True, only="cortex-m4"),
    "code that changes": program("__asm(\".thumb_func\\n.type patched, %function\\npatched: movs r0, #3\\n bx lr\\n.size patched, . - patched\\n\"); unsigned patched(void);\n"
                                 "APART unsigned work(unsigned x) { *(volatile unsigned short *)((unsigned)patched & ~1U) = 0x2028; return patched() + x; }",
                                 refused=("what the image says is constant",), always_refused=True),
    # The fact was written for the first.
    "two loops": program("volatile unsigned short_one, long_one; APART unsigned work(unsigned x) { for (unsigned n = short_one; n != 0; --n) sink = x; for (unsigned n = long_one; n != 0; --n) sink = x + n;"
                         " return x; }", "short_one = 2; long_one = 40; sink = work(1)", facts=[("loop", "work", 2)], refused=("is for 1 of work's loops, but there are 2",),
                         always_refused=True),
    "remainder": program("APART unsigned work(unsigned n) { if ((n & 3) != 0) { sink = 1; sink = 2; sink = 3; } return n; }", "sink = work(1); sink = work(4)"),
    "recursion": program("APART unsigned work(unsigned x) { return x < 2 ? x : work(x - 1) + work(x - 2); }", refused=("a recursion",), always_refused=True),
    "indirect": program("unsigned (*chosen)(unsigned);\nAPART unsigned work(unsigned x) { return chosen(x) + 1; }", "chosen = work; (void)sink",
                        refused=("an indirect call", "an indirect jump"), always_refused=True),
    "endless": program("APART unsigned work(unsigned x) { while (sink == x) { } return x; }", "sink = 0; work(7)", refused=("the loop at",), always_refused=True),
}
