#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the recording that the images replay (tests/images/recording.hpp) of a simulator's candump log."""

import argparse
import os
import re
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "can"))

import striker_dbc  # noqa: E402

LINE = re.compile(r"\([\d.]+\) \S+ ([0-9A-F]{3})#([0-9A-F]*)$")
SYNC = striker_dbc.identifier("Sync")
CONTROLLER_SENDS = striker_dbc.sent_by("Controller")
FROM_CONTROLLER = 0x8000


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("log", help="as striker-sil --log writes it")
    parser.add_argument("recording", help="the file to write")
    parser.add_argument("--ticks", type=int, default=2000, help="how many ticks to take (default 2000)")
    arguments = parser.parse_args()
    ticks = 0
    with open(arguments.log, encoding="ascii") as log, open(arguments.recording, "wb") as recording:
        for line in log:
            match = LINE.match(line.rstrip())
            if not match:
                sys.exit(f"record_run: {arguments.log}: not a candump line: {line.rstrip()}")
            identifier, data = int(match[1], 16), bytes.fromhex(match[2])
            answer = identifier in CONTROLLER_SENDS
            if ticks == arguments.ticks and not answer:
                break
            ticks += identifier == SYNC
            mark = FROM_CONTROLLER if answer else 0
            recording.write(struct.pack("<HB8s", identifier | mark, len(data), data))
    if ticks < arguments.ticks:
        sys.exit(f"record_run: {arguments.log}: {ticks} ticks, fewer than {arguments.ticks}")


if __name__ == "__main__":
    main()
