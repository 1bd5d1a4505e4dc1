#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds a board's proved bound to real steps: searched and directed ones run on QEMU, each is followed through the graph without a
contradiction, and the longest of them is within a few per cent of the bound."""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "tools"), os.path.join(ROOT, "tests", "ports")]
sys.dont_write_bytecode = True

import qemu_image  # noqa: E402
import qemu_trace  # noqa: E402
from step_bound import analysis  # noqa: E402
from step_bound.functions import plain_name  # noqa: E402
from trace_checker import Checker, Contradiction, Walker  # noqa: E402

GREATEST_RATIO = 1.05  # proved / longest found: firmware/policy/README.md has each core's
# Facts whose number no step here meets: what never happens has none, a loop's head counts once more than its body, and quotients are
# shorter, silences and checks of weights fewer than they may be.
MAY_BE_LOOSE = {"time-goes-on", "a-motion-begins-with-an-order", "beginning-shifts-no-history", "frames-of-a-tick", "bytes-of-a-frame", "bytes-of-the-consent", "silences", "weights-slice", "short-quotients",
                "speeds-of-the-ball", "division-without-an-instruction", "signed-division-without-an-instruction"}


def spans_of(found):
    """(start, size) of all code that the root may run."""
    spans = []
    for start in found.reachable:
        addresses = [insn for block in found.program.functions[start].blocks.values() for insn in block.instructions]
        first, last = min(i.address for i in addresses), max(i.next for i in addresses)
        spans.append((first, last - first))
    return spans


def follow(board, image, found, bound, words):
    checker = Checker(bound)
    with qemu_trace.traced(board, image, words, spans_of(found)) as lines:
        for instructions, edges in Walker(bound, found.root).calls(qemu_trace.blocks(lines, found.program.instructions)):
            checker.check(instructions, edges)
    return checker


def compare(found, bound, checker):
    """Where the worst path goes and the longest step did not."""
    real, program = {}, found.program
    for (context, source, target), n in checker.longest_edges.items():
        if target is not None:
            function = program.functions[found.findings.contexts[context]]
            name = " > ".join(map(plain_name, bound.chain(context)[1:]))
            real[name] = real.get(name, 0) + n * len(function.blocks[target].instructions)
    proved = {}
    for context, start in found.findings.contexts.items():
        name = " > ".join(map(plain_name, bound.chain(context)[1:]))
        proved[name] = proved.get(name, 0) + sum(
            bound.runs(context, block.start) * len(block.instructions) for block in program.functions[start].blocks.values())
    for name in sorted(proved, key=lambda n: -abs(proved[n] - real.get(n, 0))):
        if abs(proved[name] - real.get(name, 0)) > 3:
            print(f"    proved {proved[name]:8.0f}  ran {real.get(name, 0):8}  {name}")


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--image", required=True)
    parser.add_argument("--search", type=int, default=2000)
    parser.add_argument("--directed", type=int, default=60)
    parser.add_argument("--facts", default=analysis.FACTS)
    parser.add_argument("--compare", action="store_true", help="print where the worst path goes and the longest step did not")
    arguments = parser.parse_args()
    board = qemu_image.read_board(arguments.boards, arguments.board)
    found = analysis.Analysis(arguments.image, late=analysis.delays_commands(arguments.image), facts=arguments.facts)
    bound = found.bound()
    longest, attained = 0, set()
    for words in (["search", arguments.search, "seed", 3], ["directed", arguments.directed]):
        if not words[1]:
            continue
        try:
            checker = follow(board, arguments.image, found, bound, words)
        except Contradiction as contradiction:
            sys.exit(f"FAILED: {arguments.board}: {' '.join(map(str, words))}: {contradiction}")
        print(f"ok: {checker.count} steps of {words[0]} without a contradiction, the longest {checker.longest:,} instructions")
        longest = max(longest, checker.longest)
        attained |= checker.attained
    loose = bound.used_facts - attained
    print(f"{len(attained)} facts were met to their number: one less would be a contradiction; not met: {', '.join(sorted(loose))}")
    if arguments.compare:
        compare(found, bound, checker)
    ratio = bound.total / longest
    good = ratio <= GREATEST_RATIO and loose <= MAY_BE_LOOSE
    if loose - MAY_BE_LOOSE:
        print(f"FAILED: no step met {', '.join(sorted(loose - MAY_BE_LOOSE))}: a smaller number would not be noticed")
    print(f"{'ok' if ratio <= GREATEST_RATIO else 'FAILED'}: proved {bound.total:,}, longest {longest:,}, ratio {ratio:.3f}")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
