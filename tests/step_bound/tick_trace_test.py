#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Real ticks of a board's controller, from its reset on, followed on QEMU through the graph that their bound was proved on: no contradiction, and what ran beside the polls
of the time between two ticks is within the bound. Nobody sends to it: it receives nothing, and sends what a controller in standby sends."""

import os
import re
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "tools"), os.path.join(ROOT, "tests", "ports")]
sys.dont_write_bytecode = True

import qemu_image  # noqa: E402
import qemu_trace  # noqa: E402
from step_bound import analysis, tick  # noqa: E402
from step_bound.functions import short_name  # noqa: E402
from trace_checker import Checker, Contradiction, Walker  # noqa: E402
from trace_test import spans_of  # noqa: E402

MANY = 20_000


class Enough(Exception):
    """As many ticks as wanted."""


def polls_without_end():
    """The facts, but that any number of polls fits before a tick."""
    with open(analysis.FACTS, encoding="utf-8") as file:
        text, count = re.subn(r"(\[one-poll\]\n.*\nat_most = )1\n", rf"\g<1>{MANY}\n", file.read())
    assert count == 1
    return text


def beside_the_polls(found, bound, edges):
    """Instructions that are not the waiting's."""
    return sum(n * len(found.program.functions[found.findings.contexts[context]].blocks[target].instructions)
               for (context, _, target), n in edges.items()
               if target is not None and not any(short_name(name) == "BoardClock::wait" for name in bound.chain(context)))


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--image", required=True)
    parser.add_argument("--ticks", type=int, default=5)
    arguments = parser.parse_args()
    board = qemu_image.read_board(arguments.boards, arguments.board)
    late = analysis.delays_commands(arguments.image)
    strict = analysis.Analysis(arguments.image, tick.TURN, late).bound(24).total
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(polls_without_end())
        file.flush()
        found = analysis.Analysis(arguments.image, tick.TURN, late, file.name, missed=1000)  # a traced board is slower than its clock
        bound = found.bound(24)
    checker, longest = Checker(bound), 0
    try:
        with qemu_trace.traced(board, arguments.image, [], spans_of(found)) as lines:
            for instructions, edges in Walker(bound, found.root).calls(qemu_trace.blocks(lines, found.program.instructions)):
                checker.check(instructions, edges)
                longest = max(longest, beside_the_polls(found, bound, edges))
                if checker.count == arguments.ticks:
                    raise Enough
    except Contradiction as contradiction:
        sys.exit(f"FAILED: {arguments.board}: tick {checker.count}: {contradiction}")
    except Enough:
        pass
    good = checker.count == arguments.ticks and longest <= strict
    print(f"{'ok' if good else 'FAILED'}: {checker.count} ticks, the longest {longest:,} instructions beside its polls, of {strict:,}; "
          f"facts that were met to their number: {', '.join(sorted(checker.attained)) or 'none'}")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
