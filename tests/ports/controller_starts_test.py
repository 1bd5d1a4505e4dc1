#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Starts a board's controller image, as its preset builds it, on QEMU, alone on its bus, for 2,000 ticks at least: a
wheel command a tick without torque, and no fault. Where the board has a CAN controller of its own, whose frames are not
QEMU's, its memory tells the ticks."""

import os
import struct
import sys
import tempfile
import time

import controller_image_test
import qemu_image

ROOT = controller_image_test.ROOT
sys.path.insert(0, os.path.join(ROOT, "tools"))

import pil_board  # noqa: E402
import striker_dbc  # noqa: E402

TICKS = 2_000
LIMIT_S = 240
TICKS_OF_COUNTED = 12  # offset in CountedTicks


class LoneBoard(pil_board.Board):
    """Without a bus behind it: its serial port goes into a file, which never holds it up. 32 ns an instruction, so that
    2 s of virtual time are short."""

    def __init__(self, entry, image, folder):
        super().__init__(entry, image, "none", folder)
        self._is_bridged = False

    def _command(self):
        line = super()._command()
        line[line.index("-icount") + 1] = "shift=5"
        if self._board["qemu"]["can"]:
            at = next(i for i, word in enumerate(line) if word.startswith("can-host-socketcan"))
            del line[at - 1:at + 1]
        else:
            line[line.index("-serial") + 1] = f"file:{self.path('serial')}"
        return line

    def frames(self):
        """What came over the serial port, as (identifier, data)."""
        with open(self.path("serial"), "rb") as serial:
            lines = serial.read().split(b"\r")[:-1]
        packets = [struct.unpack("=IB3x8s", pil_board.from_slcan(line)) for line in lines]
        return [(identifier, data[:length]) for identifier, length, data in packets]


def expect(holds, text):
    if not holds:
        sys.exit(f"controller_starts_test: {text}")


def listen_to(board):
    end = time.monotonic() + LIMIT_S
    commands = frames = []
    while len(commands) < TICKS:
        expect(time.monotonic() < end, f"{len(commands)} wheel commands within {LIMIT_S} s")
        time.sleep(0.2)
        frames = board.frames()
        commands = [data for identifier, data in frames if identifier == controller_image_test.WHEEL_COMMAND]
    expect(not any(any(data[2:]) for data in commands), "a wheel command moves")
    states = {striker_dbc.named("Status", "state", data) for identifier, data in frames
              if identifier == controller_image_test.STATUS}
    expect("standby" in states and "fault" not in states, f"its states are {sorted(states)}")
    return len(commands), f"states {sorted(states)}"


def look_into(board):
    symbol = next(name for name in board.symbols if "7counted" in name)
    end, ticks = time.monotonic() + LIMIT_S, 0
    while ticks < TICKS:
        expect(time.monotonic() < end, f"{ticks} ticks within {LIMIT_S} s")
        time.sleep(0.2)
        last, ticks = ticks, struct.unpack_from("<I", board.read(symbol, 16), TICKS_OF_COUNTED)[0]
        expect(ticks - last < TICKS, f"time jumps from tick {last} to {ticks}")
    magic = board.word("kept_fault")
    expect(magic == 0, "a fault is in the record")
    return ticks, "no fault in the record"


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--build-dir", required=True, help="the board's, built")
    arguments = parser.parse_args()
    entry = qemu_image.read_board(arguments.boards, arguments.board)
    image = os.path.join(arguments.build_dir, "bin", "striker-controller.elf")
    with tempfile.TemporaryDirectory() as folder, LoneBoard(entry, image, folder) as board:
        ticks, told = look_into(board) if entry["qemu"]["can"] else listen_to(board)
        print(f"{ticks} ticks, {told}; stack {board.deepest_stack()} bytes deep")


if __name__ == "__main__":
    main()
