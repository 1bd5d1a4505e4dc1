#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every flow fact names what proves it, and that is there; a fact that is not well formed is refused with its place."""

import os
import re
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(ROOT, "tools"))
sys.dont_write_bytecode = True

from step_bound.analysis import FACTS  # noqa: E402
from step_bound.facts import matches, parse_chain, read_facts  # noqa: E402
from step_bound.refusal import Refusal  # noqa: E402

PARAMETERS = {"frames": 24, "missed": 0, "weights_slice": 12, "acts_at_once": 1, "letters_of_a_poll": 8, "lines_of_a_poll": 2}
WRONG = {
    "no proof": '[a]\ncalls = "f"\nat_most = 1\nbecause = "x"\n',
    "two kinds": '[a]\ncalls = "f"\nloop = "f"\nat_most = 1\nbecause = "x"\nproved_by = "trace"\n',
    "an unknown number": '[a]\ncalls = "f"\nat_most = "many"\nbecause = "x"\nproved_by = "trace"\n',
    "an unknown field": '[a]\ncalls = "f"\nat_most = 1\nbecause = "x"\nproved_by = "trace"\nmaybe = 1\n',
    "a number that is negative": '[a]\nloop = "f"\nat_most = -3\nbecause = "x"\nproved_by = "trace"\n',
    "a number that is not whole": '[a]\ncalls = "f"\nat_most = 0.5\nbecause = "x"\nproved_by = "trace"\n',
    "a number that is a truth": '[a]\ncalls = "f"\nat_most = true\nbecause = "x"\nproved_by = "trace"\n',
    "numbers for calls": '[a]\ncalls = "f"\nat_most = [1, 2]\nbecause = "x"\nproved_by = "trace"\n',
    "a chain that is a number": '[a]\ncalls = 7\nat_most = 1\nbecause = "x"\nproved_by = "trace"\n',
    "a chain without an end": '[a]\ncalls = "f > "\nat_most = 1\nbecause = "x"\nproved_by = "trace"\n',
    "an unknown condition": '[a]\ncalls = "f"\nat_most = 1\nwhen = "maybe"\nbecause = "x"\nproved_by = "trace"\n',
    "no TOML": "[a\n",
}


def main():
    failed = 0
    tests = set()
    for name in ("step_facts_test.cpp", "port_facts_test.cpp"):
        with open(os.path.join(HERE, name), encoding="utf-8") as file:
            tests |= {f"{suite}.{case}" for suite, case in re.findall(r"^TEST\((\w+), (\w+)\)", file.read(), re.MULTILINE)}
    facts = read_facts(FACTS, PARAMETERS)
    for fact in facts:
        if fact.proved_by not in tests | {"trace", "argument", "assumed"}:
            print(f"FAILED: [{fact.name}] is proved by {fact.proved_by}, which is not there")
            failed += 1
    for name, text in WRONG.items():
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(text)
            file.flush()
            try:
                read_facts(file.name, PARAMETERS)
                print(f"FAILED: {name}: was not refused")
                failed += 1
            except Refusal as refusal:
                print(f"ok: {name}: {str(refusal).replace(file.name, 'FILE')}")
    for chain, names, expected in (
        ("a > c", ["a", "c"], True), ("a > c", ["a", "b", "c"], False), ("a >> c", ["r", "a", "b", "c"], True),
        ("c", ["a", "c"], True), ("c", ["c", "a"], False), ("f<*T*>", ["a", "f<S, T>"], True), ("f<*T*>", ["a", "f<S>"], False),
    ):
        if bool(matches(parse_chain(chain), names)) != expected:
            print(f"FAILED: '{chain}' and {names}")
            failed += 1
    print(f"{len(facts)} facts, {len(tests)} tests")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
