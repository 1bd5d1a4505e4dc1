# SPDX-License-Identifier: Apache-2.0
"""Identifiers and named values from the committed DBC, which a test holds to the message table."""

import os
import re

DBC = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../firmware/can/striker.dbc")

with open(DBC, encoding="utf-8") as _stream:
    _TEXT = _stream.read()

IDENTIFIERS = {name: int(identifier) for identifier, name in re.findall(r"^BO_ (\d+) (\w+):", _TEXT, re.MULTILINE)}
LENGTHS = {name: int(length) for name, length in re.findall(r"^BO_ \d+ (\w+): (\d+)", _TEXT, re.MULTILINE)}


def value_of(message, signal, name):
    """The raw value of a signal's named value."""
    names = re.search(rf"^VAL_ {IDENTIFIERS[message]} {signal} (.*);", _TEXT, re.MULTILINE)[1]
    return {text: int(raw) for raw, text in re.findall(r'(\d+) "(\w+)"', names)}[name]
