#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each of the changes in mutations.py, to the analysis, to a fact or to the code, is noticed: by a refusal, by a contradiction to what ran,
by a bound that is too low or too loose; a change to the code by a higher bound."""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "tools"), os.path.join(ROOT, "tests", "ports"), HERE]
sys.dont_write_bytecode = True

import mutations  # noqa: E402
from small_programs import CORES, PROGRAMS  # noqa: E402
from small_programs_test import bound_of, compile_program, examine  # noqa: E402

LEVEL = "-O1"
NOT_AT_ALL = {"refused": ()}  # what a program may be refused for says nothing here


def of_analysis(folder, program, core, change):
    undo = change()
    try:
        return examine(folder, program, {**PROGRAMS[program], **NOT_AT_ALL}, CORES[core], LEVEL)
    except (TypeError, AttributeError, KeyError) as error:
        return f"it ended: {error}", ""
    finally:
        undo()


def of_code(program, old, new):
    source = PROGRAMS[program]["source"]
    assert old in source, old
    totals = []
    for text in (source, source.replace(old, new)):
        with tempfile.TemporaryDirectory() as folder:
            image, _ = compile_program(folder, CORES[mutations.M4], LEVEL, text)
            totals.append(bound_of(image, PROGRAMS[program])[0].total)
    verdict = f"{totals[0]} became {totals[1]}"
    return (verdict if totals[1] > totals[0] else None), verdict


def main():
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for name in {(program, core) for program, core, _ in (*mutations.ANALYSIS.values(), *mutations.FACTS.values())}:
            problem, verdict = examine(folder, name[0], PROGRAMS[name[0]], CORES[name[1]], LEVEL)
            found.append((f"as it is: {name[0]}", None if problem else verdict, problem))
        for name, (program, core, change) in mutations.ANALYSIS.items():
            found.append((name, *of_analysis(folder, program, core, change)))
        for name, (program, core, facts) in mutations.FACTS.items():
            found.append((name, *examine(folder, program, {**PROGRAMS[program], **NOT_AT_ALL, "facts": facts}, CORES[core], LEVEL)))
    for name, change in mutations.CODE.items():
        found.append((name, *of_code(*change)))
    for name, problem, verdict in found:
        print(f"ok: {name}: {problem}" if problem else f"FAILED: {name}: not noticed: {verdict}")
    print(f"{len(mutations.ANALYSIS) + len(mutations.FACTS) + len(mutations.CODE)} changes")
    sys.exit(0 if all(problem for _, problem, _ in found) else 1)


if __name__ == "__main__":
    main()
