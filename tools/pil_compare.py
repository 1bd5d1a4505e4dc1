# SPDX-License-Identifier: Apache-2.0
"""Two runs of the kick task beside each other: their candump logs and their episodes' rewards."""

import itertools
import json
import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))


def message_names():
    """By identifier, of firmware/can/striker.dbc."""
    with open(os.path.join(ROOT, "firmware", "can", "striker.dbc"), encoding="utf-8") as dbc:
        return {int(identifier): name for identifier, name in re.findall(r"^BO_ (\d+) (\w+):", dbc.read(), re.MULTILINE)}


def read_lines(log):
    with open(log, encoding="ascii") as text:
        return text.read().splitlines()


def frames_of(lines, identifier):
    """Those of one message: stamp and frame."""
    return [line for line in lines if line.split(" ")[2].startswith(f"{identifier:03X}#")]


def rewards_of(file):
    with open(file, encoding="utf-8") as text:
        return [row["reward"] for row in json.load(text)["rows"]]


def first_difference(one, other):
    """The number from 0 and the two items, the missing one None; None where they are the same."""
    for number, (left, right) in enumerate(itertools.zip_longest(one, other)):
        if left != right:
            return number, left, right
    return None


def compare(folder, left, right):
    """Prints a row a kind of answer, of LEFT.log, LEFT.json and RIGHT's; whether all are the same."""
    names = message_names()
    by_name = {name: identifier for identifier, name in names.items()}
    logs = [read_lines(os.path.join(folder, f"{name}.log")) for name in (left, right)]
    rows = [(title, *(frames_of(log, by_name[message]) for log in logs))
            for title, message in (("actions", "Decision"), ("wheel commands", "WheelCommand"))]
    rows.append(("rewards", *(rewards_of(os.path.join(folder, f"{name}.json")) for name in (left, right))))
    rows.append(("frames", *logs))
    same = True
    for title, one, other in rows:
        difference = first_difference(one, other)
        verdict = "the same, byte for byte"
        if difference is not None:
            same = False
            number, *items = difference
            verdict = f"DIFFERENT, first at {number}: {items[0]} | {items[1]}"
            if title == "frames" and items[0] is not None:
                verdict += f" ({names.get(int(items[0].split(' ')[2][:3], 16), 'unknown')})"
        print(f"  {title:<22}{len(one):>12,}{len(other):>12,}   {verdict}", flush=True)
    return same
