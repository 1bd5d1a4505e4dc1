#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""canmatrix, with the committed DBC, decodes what the C++ table packed. Usage: canmatrix_test.py SAMPLES DBC"""

import subprocess
import sys
from decimal import Decimal

import canmatrix.formats

samples, dbc = sys.argv[1:]
matrix = canmatrix.formats.loadp_flat(dbc)
checked = set()
for line in subprocess.run([samples], capture_output=True, text=True, check=True).stdout.splitlines():
    name, identifier, payload, *values = line.split()
    frame = matrix.frame_by_name(name)
    assert frame.arbitration_id.id == int(identifier), line
    assert frame.size == len(payload) // 2, line
    decoded = frame.decode(bytes.fromhex(payload))
    assert len(values) == len(decoded), line
    for value in values:
        signal, raw = value.split("=")
        expected = int(raw)
        assert decoded[signal].raw_value == expected, f"{line}: {signal} decodes to {decoded[signal].raw_value}"
        physical = Decimal(expected) * Decimal(str(decoded[signal].signal.factor))
        assert Decimal(str(decoded[signal].phys_value)) == physical, f"{line}: {signal}"
        low, high = decoded[signal].signal.min, decoded[signal].signal.max
        assert low <= decoded[signal].phys_value <= high, f"{line}: {signal} outside [{low}, {high}]"
    checked.add(name)
assert checked == {frame.name for frame in matrix.frames}, checked
print(f"{len(checked)} messages decoded alike")
