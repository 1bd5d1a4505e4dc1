#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a board's controller image, as it would be flashed, on QEMU: slcan over the board's serial port, the
recorded run's frames as its bus, tick by tick. It has to arm and decide, and its stack, painted at reset, must not
have been deeper than the computed bound."""

import os
import socket
import struct
import subprocess
import sys
import tempfile
import time

import qemu_image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "tests", "can"), os.path.join(ROOT, "firmware", "ports", "bare_metal")]

import stack_usage  # noqa: E402
import operator_consent  # noqa: E402
import striker_dbc  # noqa: E402

PAINT = 0xC5C5C5C5
SYNC, WHEEL_COMMAND, STATUS, DECISION = map(striker_dbc.identifier, ("Sync", "WheelCommand", "Status", "Decision"))
FROM_CONTROLLER = 0x8000


def recorded_ticks(path):
    """The frames to the controller, tick by tick, as slcan lines."""
    ticks, frames = [], b""
    with open(path, "rb") as recording:
        while len(record := recording.read(11)) == 11:
            identifier, length, data = struct.unpack("<HB8s", record)
            if identifier == SYNC:
                ticks.append(frames)
                frames = b""
            elif not identifier & FROM_CONTROLLER:
                frames += f"t{identifier:03X}{length}{data[:length].hex().upper()}\r".encode()
    return ticks


def connect(path):
    for _ in range(200):
        try:
            connection = socket.socket(socket.AF_UNIX)
            connection.connect(path)
            return connection
        except OSError:
            time.sleep(0.05)
    sys.exit("controller_image_test: QEMU did not come up within 10 s")


def exchange(serial, ticks):
    """Sends a tick's frames whenever a wheel command has come; what came back, by identifier."""
    answers, waiting, operator = {}, b"", operator_consent.Operator()
    for frames in ticks:
        serial.sendall(operator.lines(frames))
        commanded = False
        while not commanded:
            received = serial.recv(65536)
            if not received:
                sys.exit("controller_image_test: the image stopped")
            *lines, waiting = (waiting + received).split(b"\r")
            for line in lines:
                identifier = int(line[1:4], 16)
                payload = bytes.fromhex(line[5:].decode())
                operator.hear(identifier, payload)
                answers.setdefault(identifier, []).append(payload)
                commanded |= identifier == WHEEL_COMMAND
    return answers


def deepest_stack(control, bottom, top, folder):
    """Bytes of the stack that no longer hold the paint."""
    path = os.path.join(folder, "stack.bin")
    stream = control.makefile("rw")
    stream.readline()
    for request in ('{"execute": "qmp_capabilities"}', '{"execute": "stop"}',
                    f'{{"execute": "pmemsave", "arguments": {{"val": {bottom}, "size": {top - bottom}, '
                    f'"filename": "{path}"}}}}'):
        stream.write(request + "\n")
        stream.flush()
        while '"event"' in (answer := stream.readline()):
            pass
        if '"error"' in answer:
            sys.exit(f"controller_image_test: QEMU: {answer}")
    with open(path, "rb") as memory:
        words = struct.unpack(f"<{(top - bottom) // 4}I", memory.read())
    untouched = next((i for i, word in enumerate(words) if word != PAINT), len(words))
    return top - bottom - 4 * untouched


def run(board, image, ticks, symbols):
    """What the image answered, and how deep its stack was."""
    with tempfile.TemporaryDirectory() as folder:
        serial_path, control_path = os.path.join(folder, "serial"), os.path.join(folder, "control")
        line = qemu_image.machine(board, image) + ["-serial", f"unix:{serial_path},server=on,wait=on",
                                                   "-qmp", f"unix:{control_path},server=on,wait=off"]
        with subprocess.Popen(line, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            try:
                answers = exchange(connect(serial_path), ticks)
                deepest = deepest_stack(connect(control_path), symbols["stack_bottom"], symbols["stack_top"], folder)
            finally:
                process.kill()
    return answers, deepest


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--recording", required=True)
    parser.add_argument("--build-dir", required=True, help="the board's, built")
    arguments = parser.parse_args()
    try:
        board = qemu_image.read_board(arguments.boards, arguments.board)
    except qemu_image.ImageError as error:
        sys.exit(f"controller_image_test: {error}")
    image = os.path.join(arguments.build_dir, "bin", "striker-controller.elf")
    bound, _ = stack_usage.stack_usage(image, arguments.build_dir)
    symbols = stack_usage.symbols(image)
    # An instruction a nanosecond makes the board's 1 ms some of the host's. A host that stalls this process for 20 of
    # them takes the wheel states away, and the controller rightly faults: then once more.
    for _ in range(3):
        answers, deepest = run(board, image, recorded_ticks(arguments.recording)[:600], symbols)
        states = {striker_dbc.named("Status", "state", status) for status in answers.get(STATUS, [])}
        decisions = len(answers.get(DECISION, []))
        print(f"{len(answers[WHEEL_COMMAND])} wheel commands, {decisions} decisions, states {sorted(states)}; "
              f"stack {deepest} bytes deep, bound {bound} bytes")
        if not 0 < deepest <= bound:
            sys.exit(1)
        if "active" in states and decisions > 4:
            sys.exit(0)
    sys.exit(1)


if __name__ == "__main__":
    main()
