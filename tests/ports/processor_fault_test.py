#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Breaks a board's controller while it drives, on QEMU: an undefined instruction, a stack that overflows or has been
full, a hang, a write to flash, a call into RAM, a touch of what lies below the stack. Each has to end in the fault's
record with the right cause, no torque may go out from there on, and the next run has to tell it. An image that breaks
at every start has to stop after the resets that fault_record.hpp states."""

import contextlib
import json
import os
import re
import select
import struct
import subprocess
import sys
import tempfile
import time

import controller_image_test
import gdb_remote
import image_test
import qemu_image
import operator_consent
import striker_dbc

MAGIC = 0x464C5452
EXCEPTION, WATCHDOG, STACK_OVERFLOW = 1, 2, 3
MOST_RESETS = 8
# What the bus is told.
FAULT = {EXCEPTION: "processor_exception", WATCHDOG: "watchdog", STACK_OVERFLOW: "processor_exception"}

FAULT_REPORT = striker_dbc.identifier("FaultReport")

UDF = b"\x00\xde"
HANG = b"\xfe\xe7"
PUSH_FOR_EVER = b"\xf0\xb5\xfd\xe7"                         # push {r4-r7, lr}; b .-2
WRITE_TO_FLASH = {"M": b"\x01\x20\x00\x07\x00\x60",         # movs r0, #1; lsls r0, #28; str r0, [r0]
                  "R": b"\x03\x20\xc0\x43\x00\x04\x00\x60"}  # movs r0, #3; mvns r0, r0; lsls r0, #16; str r0, [r0]
READ_GUARD = {"M": b"\x01\x20\x40\x07\x04\x38\x00\x68",     # movs r0, #1; lsls r0, #29; subs r0, #4; ldr r0, [r0]
              "R": b"\x01\x20\xc0\x03\x03\x30\xc0\x43\x00\x68"}  # as above by 0x8003; mvns: 0xFFFF7FFC
CALL_INTO_RAM = b"\x68\x46\x01\x30\x00\x47"                 # mov r0, sp; adds r0, #1; bx r0

# Exception's number and status (CFSR; IFSR and DFSR), in the bits that matter, by what a core has.
ARMV6M = {"undefined": (3, 0, 0), "overflow": (3, 0, 0), "full": (0, 0, 0)}
ARMV7M = {"undefined": (3, 0xFFFFFFFF, 1 << 16), "overflow": (3, 0x12, 0x12), "full": (0, 0, 0), "hang": (2, 0, 0),
          "flash": (3, 0xFF, 0x82), "ram": (3, 0xFF, 0x01), "guard": (3, 0xFF, 0x82)}
ARMV8M = {**ARMV7M, "overflow": (3, 0xFFFFFFFF, 1 << 20)}
del ARMV8M["guard"]  # its limit is the stack pointer's alone
ARMV7R = {"undefined": (1, 0, 0), "overflow": (4, 0x80F, 0x80D), "full": (0, 0, 0), "flash": (4, 0x80F, 0x80D),
          "ram": (3, 0xF, 0xD), "guard": (4, 0x80F, 0x00D)}
EXPECTED = {"cortex-m0plus": ARMV6M, "cortex-m3": ARMV7M, "cortex-m4": ARMV7M, "cortex-m7": ARMV7M,
            "cortex-m33": ARMV8M, "cortex-m55": ARMV8M, "cortex-r5": ARMV7R}


class Failure(Exception):
    """Something did not hold."""


class NotDriven(Failure):
    """The controller faulted before the test did anything: a host that stalls takes the wheel states away."""


def expect(holds, text):
    if not holds:
        raise Failure(text)


def symbols(image):
    """Addresses by demangled name, without arguments."""
    text = subprocess.run(["arm-none-eabi-nm", "-C", image], check=True, capture_output=True, text=True).stdout
    found = (re.match(r"([0-9a-f]+) \w ([^(]+)", line.replace("(anonymous namespace)::", "")) for line in text.splitlines())
    return {match[2]: int(match[1], 16) & ~1 for match in found if match}


def patched(image, patches, folder):
    """A copy of the image with other bytes at some addresses."""
    with open(image, "rb") as original:
        data = bytearray(original.read())
    first, = struct.unpack_from("<I", data, 28)
    count, = struct.unpack_from("<H", data, 44)
    for address, code in patches.items():
        for header in range(first, first + 32 * count, 32):
            kind, offset, start, _, size = struct.unpack_from("<5I", data, header)
            if kind == 1 and start <= address < start + size:
                data[offset + address - start:offset + address - start + len(code)] = code
    path = os.path.join(folder, "patched.elf")
    with open(path, "wb") as copy:
        copy.write(data)
    return path


class Control:
    """QEMU's own commands, and what it tells: resets and a watchdog that bites."""

    def __init__(self, path):
        self._connection = controller_image_test.connect(path)
        self._lines = b""
        self.events = []
        self._line(10)
        self.ask("qmp_capabilities")

    def ask(self, command, **arguments):
        self._connection.sendall(json.dumps({"execute": command, "arguments": arguments}).encode() + b"\n")
        while (answer := self._line(10)) is not None:
            if "event" not in answer:
                expect("error" not in answer, f"QEMU: {answer}")
                return

    def count(self, event, wanted, quiet_s=0):
        """How often it has told an event: at least so often within 30 s, and as often as it comes without a pause."""
        end = time.monotonic() + 30
        while self.events.count(event) < wanted and time.monotonic() < end:
            self._line(1)
        while quiet_s and self._line(quiet_s) is not None and self.events.count(event) <= wanted:
            pass
        return self.events.count(event)

    def _line(self, timeout_s):
        while b"\n" not in self._lines:
            if not select.select([self._connection], [], [], timeout_s)[0]:
                return None
            received = self._connection.recv(65536)
            expect(received, "QEMU ended")
            self._lines += received
        line, self._lines = self._lines.split(b"\n", 1)
        answer = json.loads(line)
        if "event" in answer:
            self.events.append(answer["event"])
        return answer


class Machine:
    """The board with an image, its serial port's frames, and, if asked for, the debug port."""

    def __init__(self, board, image, stack):
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        paths = {name: os.path.join(folder, name) for name in ("serial", "control", "debug")}
        line = qemu_image.machine(board, image) + [
            "-serial", f"unix:{paths['serial']},server=on,wait=on", "-qmp", f"unix:{paths['control']},server=on,wait=off",
            "-gdb", f"unix:{paths['debug']},server=on,wait=off", "-S"]  # until all events can be heard
        process = stack.enter_context(subprocess.Popen(line, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        stack.callback(process.kill)
        self._serial = stack.enter_context(controller_image_test.connect(paths["serial"]))
        self._waiting = b""
        self._operator = operator_consent.Operator()
        self.control = Control(paths["control"])
        if processor := board["qemu"]["power_on"]:
            self.control.ask("qom-set", path=processor, property="start-powered-off", value=False)
            self.control.ask("system_reset")
        self.control.ask("cont")
        self._debug_path = paths["debug"]
        self._place = (2, 5) if board["qemu"]["power_on"] else (1, 1)

    def attach(self):
        """The processor is stopped then."""
        return gdb_remote.Debugger(self._debug_path, *self._place)

    def send(self, frames):
        self._serial.sendall(frames)

    def frames(self, timeout_s):
        """What has come, as (identifier, data), after a wait for the first byte."""
        if not select.select([self._serial], [], [], timeout_s)[0]:
            return []
        received = self._serial.recv(65536)
        expect(received, "the image stopped")
        *lines, self._waiting = (self._waiting + received).split(b"\r")
        return [self._operator.hear(int(line[1:4], 16), bytes.fromhex(line[5:].decode())) for line in lines
                if re.fullmatch(rb"t[0-9A-F]{4}([0-9A-F]{2})*", line)]

    def drain(self):
        while self.frames(0):
            pass

    def tick(self, frames):
        """Sends a tick's frames, and returns what came up to the next wheel command."""
        self.send(self._operator.lines(frames))
        came, end = [], time.monotonic() + 30
        while not any(identifier == controller_image_test.WHEEL_COMMAND for identifier, _ in came):
            came += self.frames(1)
            expect(time.monotonic() < end, "no wheel command for 30 s")
        return came


def has_torque(frame):
    return frame[0] == controller_image_test.WHEEL_COMMAND and any(
        striker_dbc.raw("WheelCommand", signal, frame[1]) for signal in ("left_torque", "right_torque"))


def drive(machine, ticks):
    """Arms, as recorded, and returns once the wheels are driven: the ticks that are left."""
    driven = 0
    for at, frames in enumerate(ticks[:600]):
        came = machine.tick(frames)
        driven += any(map(has_torque, came))
        if driven == 5:
            return ticks[at + 1:]
        if any(identifier == FAULT_REPORT for identifier, _ in came):
            break
    raise NotDriven(f"the recorded run did not drive the wheels, up to its tick {at}")


def code_for(case, cpu):
    profile = "R" if "-r" in cpu else "M"
    return {"undefined": UDF, "overflow": PUSH_FOR_EVER, "full": b"", "hang": HANG, "flash": WRITE_TO_FLASH[profile],
            "ram": CALL_INTO_RAM, "guard": READ_GUARD[profile]}[case]


def check_record(case, cpu, debugger, names, at):
    magic, cause, exception, status, pc, resets, untold, _ = struct.unpack("<8I", debugger.read(names["kept_fault"], 32))
    wanted, mask, bits = EXPECTED[cpu][case]
    told = f"cause {cause}, exception {exception}, status {status:#x}, pc {pc:#x}, resets {resets}, untold {untold}"
    expect(magic == MAGIC and resets == 1 and untold == 0, f"a whole record, told once: {told}")
    expect(cause == {"overflow": STACK_OVERFLOW, "full": STACK_OVERFLOW, "hang": WATCHDOG}.get(case, EXCEPTION), f"the cause: {told}")
    expect(exception == wanted and status & mask == bits, f"exception {wanted} with status {bits:#x}: {told}")
    # A stack that has overflown on a Cortex-M has no frame to tell it; from RAM, the place is the RAM's.
    if case in ("undefined", "hang", "flash", "guard"):
        expect(at <= pc < at + 10, f"the place, {at:#x}: {told}")
    return told


def break_while_driving(board, image, case, ticks):
    for _ in range(9):
        with contextlib.suppress(NotDriven):
            return break_once(board, image, case, ticks)
    return break_once(board, image, case, ticks)


def break_once(board, image, case, ticks):
    cpu, names = board["cpu"], symbols(image)
    with contextlib.ExitStack() as stack:
        machine = Machine(board, image, stack)
        ticks = drive(machine, ticks)
        debugger = machine.attach()
        stack.callback(debugger.close)
        debugger.run_to(names["striker::bare_metal::receive_can"])
        at, code = debugger.pc(), code_for(case, cpu)
        original = debugger.read(at, len(code)) if code else b""
        machine.drain()
        began = debugger.word(names["striker::bare_metal::tick_count"]) if case == "hang" else 0
        debugger.write(names["stack_bottom"] if case == "full" else at, code or bytes(4))
        debugger.run_to(names["striker::bare_metal::end_by_fault"])
        if case == "hang":
            passed = debugger.word(names["striker::bare_metal::tick_count"]) - began
            expect(10 <= passed <= 50, f"the watchdog bit after 10 to 50 ms: {passed}")
        if original:
            debugger.write(at, original)
        debugger.go()
        if board["qemu"]["power_on"]:  # it stops for good
            time.sleep(0.5)
            expect(not machine.frames(0.5), "nothing goes out of a stopped processor")
            machine.control.ask("system_reset")
        came = [frame for frames in ticks[:100] for frame in machine.tick(frames)]
        expect(not any(map(has_torque, came)), "no torque after the fault")
        reports = [striker_dbc.named("FaultReport", "code", data) for identifier, data in came if identifier == FAULT_REPORT]
        states = {striker_dbc.named("Status", "state", data) for identifier, data in came
                  if identifier == controller_image_test.STATUS}
        debugger.stop()
        told = check_record(case, cpu, debugger, names, at)
        expect(reports and set(reports) == {FAULT[struct.unpack("<I", debugger.read(names["kept_fault"] + 4, 4))[0]]},
               f"the next run tells it: {reports}")
        expect(states == {"fault"}, f"and stays in fault: {states}")
    return told


def break_at_every_start(board, image):
    """Resets until it stops for good."""
    names = symbols(image)
    with contextlib.ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        machine = Machine(board, patched(image, {names["main"]: UDF}, folder), stack)
        wanted = 1 if board["qemu"]["power_on"] else MOST_RESETS  # the one is QEMU's own switching on
        resets = machine.control.count("RESET", wanted, quiet_s=2)
        expect(resets == wanted, f"{wanted} resets, then silence: {resets}")
        expect(not machine.frames(0), "nothing was sent")
        debugger = machine.attach()
        stack.callback(debugger.close)
        counted = debugger.word(names["kept_fault"] + 20)
        expect(counted == (1 if board["qemu"]["power_on"] else MOST_RESETS), f"the record counts them: {counted}")
    return f"{counted} counted"


def hang_in_the_handler(board, image):
    """The watchdog's own reset, where its exception gets nowhere."""
    names = symbols(image)
    with contextlib.ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        hanging = {names["take_exception"]: HANG, names["striker::bare_metal::receive_can"]: HANG}
        machine = Machine(board, patched(image, hanging, folder), stack)
        resets = machine.control.count("WATCHDOG", wanted=2)
        expect(resets >= 2, "the watchdog resets by itself")
    return f"{resets} resets"


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--recording", required=True)
    parser.add_argument("--policy", required=True)
    parser.add_argument("--build-dir", required=True)
    parser.add_argument("--built-for", help="the folder of a board that stands in for it")
    parser.add_argument("--case", help="only this one")
    arguments = parser.parse_args()
    try:
        board = qemu_image.read_board(arguments.boards, arguments.board)
    except qemu_image.ImageError as error:
        sys.exit(f"processor_fault_test: {error}")
    built_for = {"name": arguments.built_for or arguments.board}
    image_test.build(built_for, arguments.policy, arguments.build_dir, ("striker-controller",))
    image = image_test.image(arguments.build_dir, "controller")
    ticks = controller_image_test.recorded_ticks(arguments.recording)
    cases = {case: (lambda case=case: break_while_driving(board, image, case, ticks)) for case in EXPECTED[board["cpu"]]}
    cases["every start"] = lambda: break_at_every_start(board, image)
    if "hang" in cases:
        cases["hang in the handler"] = lambda: hang_in_the_handler(board, image)
    good = True
    for case, test in cases.items():
        if arguments.case in (None, case):
            try:
                print(f"ok: {board['name']}, {case}: {test()}", flush=True)
            except (Failure, gdb_remote.DebugError, OSError) as error:
                good = False
                print(f"FAILED: {board['name']}, {case}: {error}", flush=True)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
