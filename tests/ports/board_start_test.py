#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds what a new board is started with, and starts it on QEMU: striker-check-bus has to tell over the serial port, as
slcan, what the host's check prints, and that it hears frames; striker-controller has to run for 2,000 ticks at least,
without torque, as nobody arms it, with its heartbeat and its version."""

import os
import re
import subprocess
import sys
import tempfile

import controller_image_test
import image_test
import qemu_image
import striker_dbc

TEXT = 0x7E0
TICKS = 2000
FRAME = re.compile(rb"t([0-9A-F]{3})([0-8])((?:[0-9A-F]{2})*)")
HEARTBEAT, VERSION, WHEEL_COMMAND, STATUS = map(striker_dbc.identifier, ("Heartbeat", "Version", "WheelCommand", "Status"))


def heard(board, image, sent, is_enough):
    """The frames that an image sends, until there are enough; `sent` goes to it once it is there to hear it."""
    frames, waiting = [], b""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "serial")
        line = qemu_image.machine(board, image, icount_shift=3) + ["-serial", f"unix:{path},server=on,wait=on"]
        with subprocess.Popen(line, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            try:
                with controller_image_test.connect(path) as serial:
                    serial.settimeout(120)
                    while not is_enough(frames):
                        received = serial.recv(65536)
                        if not received:
                            sys.exit("board_start_test: the image stopped")
                        *lines, waiting = (waiting + received).split(b"\r")
                        if lines and not frames:
                            serial.sendall(sent)
                        for text in lines:
                            if not (found := FRAME.fullmatch(text)):
                                sys.exit(f"board_start_test: no frame: {text}")
                            frames.append((int(found[1], 16), bytes.fromhex(found[3].decode())))
            finally:
                process.kill()
    return frames


def check_text(board, build_dir, host):
    def text(frames):
        return b"".join(data for identifier, data in frames if identifier == TEXT).decode()
    frames = heard(board, image_test.image(build_dir, "check-bus"), b"t0100\r" * 3,
                   lambda so_far: len(re.findall(r"received \d+\n", text(so_far))) >= 3)
    told = [part + "\n" for part in text(frames).split("\nreceived ")]
    good = image_test.expect(told[0] == host + "status 0\n", "the same text as on the host, over the board's CAN driver")
    return good & image_test.expect(told[3].startswith("3\n"), f"it heard three frames: {told[3].splitlines()[0]}")


def check_controller(board, build_dir):
    frames = heard(board, image_test.image(build_dir, "controller"), b"",
                   lambda so_far: sum(identifier == WHEEL_COMMAND for identifier, _ in so_far) >= TICKS)
    count = {name: sum(identifier == name for identifier, _ in frames) for name in (HEARTBEAT, VERSION)}
    torques = {striker_dbc.raw("WheelCommand", f"{side}_torque", data) for identifier, data in frames
               if identifier == WHEEL_COMMAND for side in ("left", "right")}
    states = {striker_dbc.named("Status", "state", data) for identifier, data in frames if identifier == STATUS}
    good = image_test.expect(torques == {0}, f"{TICKS} ticks without torque: {torques}")
    good &= image_test.expect(count[HEARTBEAT] >= TICKS // 100 - 1 and count[VERSION] >= TICKS // 1000 - 1,
                              f"{count[HEARTBEAT]} heartbeats, {count[VERSION]} versions")
    return good & image_test.expect(states == {"self_test", "standby"}, f"it stands by: {sorted(states)}")


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--policy", required=True)
    parser.add_argument("--host", required=True, help="the check program, built for the host")
    parser.add_argument("--build-dir", required=True)
    arguments = parser.parse_args()
    try:
        board = qemu_image.read_board(arguments.boards, arguments.board)
    except qemu_image.ImageError as error:
        sys.exit(f"board_start_test: {error}")
    image_test.build(board, arguments.policy, arguments.build_dir, ("striker-controller", "striker-check-bus"))
    host = subprocess.run([arguments.host], capture_output=True, text=True, check=True).stdout
    good = check_controller(board, arguments.build_dir)
    good &= check_text(board, arguments.build_dir, host)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
