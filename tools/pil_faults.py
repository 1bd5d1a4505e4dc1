# SPDX-License-Identifier: Apache-2.0
"""Faults against a board, with the simulator on the same vcan0.

Of the bus (pil_faults.toml): striker-sil's own fault runs, whose table has to be that of the run in one process.
Of lockstep and of the processor: while the wheels are driven SYNC stops, the board is reset, its weights are altered,
its driver tells bus-off, it takes an undefined instruction, or its stack overflows. From there on nothing may carry torque;
after a reset nothing may move before it is armed again; and the bus and the fault record have to tell the cause."""

import contextlib
import json
import os
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time

import pil_board

sys.path.insert(0, os.path.join(pil_board.ROOT, "tests", "can"))

import gdb_remote  # noqa: E402
import striker_dbc  # noqa: E402

PLAN = os.path.join(pil_board.ROOT, "tools", "pil_faults.toml")
FAULT_REPORT, MODE_COMMAND, WHEEL_COMMAND = map(striker_dbc.identifier, ("FaultReport", "ModeCommand", "WheelCommand"))
ARM = striker_dbc.value("ModeCommand", "mode", "arm")
CONTROLLERS = striker_dbc.sent_by("Controller")
CAUSES = {1: "exception", 2: "watchdog", 3: "stack overflow"}
LIMIT_S = 120

UNDEFINED = b"\x00\xde"               # udf #0
PUSH_FOR_EVER = b"\xf0\xb5\xfd\xe7"   # push {r4-r7, lr}; b .-2
BUS_OFF = b"\x02\x20\x70\x47"         # movs r0, #2; bx lr: BusHealth::bus_off


class Failure(Exception):
    """Something did not hold."""


def expect(holds, text):
    if not holds:
        raise Failure(text)


class Listener:
    """What is on the bus, in its order, as (identifier, data)."""

    def __init__(self, interface):
        self.frames = []
        self._bus = pil_board.open_can(interface)
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self):
        with contextlib.suppress(OSError):
            while True:
                identifier, length, data = struct.unpack("=IB3x8s", self._bus.recv(16))
                self.frames.append((identifier, data[:length]))

    def wait_for(self, what, holds, begin=0):
        """Until a frame from number `begin` on fits; its number."""
        end = time.monotonic() + LIMIT_S
        while True:
            for number in range(begin, len(self.frames)):
                if holds(*self.frames[number]):
                    return number
            begin = len(self.frames)
            expect(time.monotonic() < end, f"no {what} within {LIMIT_S} s")
            time.sleep(0.02)

    def close(self):
        self._bus.close()


def moves(identifier, data):
    """A wheel command with torque or set-point."""
    return identifier == WHEEL_COMMAND and any(data[2:])


def confirms_arm(identifier, data):
    return (identifier == MODE_COMMAND and striker_dbc.raw("ModeCommand", "mode", data) == ARM
            and striker_dbc.raw("ModeCommand", "challenge", data) != 0)


def is_report(identifier, _):
    return identifier == FAULT_REPORT


def code(frame):
    return striker_dbc.named("FaultReport", "code", frame[1])


class Run:
    """A board and a simulator that drives it, on one bus."""

    def __init__(self, options, entry, image, interface, stack):
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        self.entry = entry
        self.board = stack.enter_context(pil_board.Board(entry, image, interface, folder, counts=False))
        self.bus = stack.enter_context(contextlib.closing(Listener(interface)))
        line = [os.path.join(options.build_dir, "bin", "striker-sil"), "kick", "--bus", f"can:{interface}", "--episodes", "40",
                "--seed", str(options.seed), "--start-timeout", "60000", "--answer-timeout", "5000"]
        self.simulator = stack.enter_context(subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        stack.callback(self.simulator.kill)
        stack.callback(self.simulator.send_signal, signal.SIGCONT)
        self.bus.wait_for("wheel command that moves", moves)

    def debugger(self):
        place = (2, 5) if self.entry["qemu"]["power_on"] else (1, 1)
        return contextlib.closing(gdb_remote.Debugger(self.board.path("gdb"), *place))

    def record(self):
        return struct.unpack("<8I", self.board.read("kept_fault", 32))

    def symbol(self, part):
        return next(address for name, address in self.board.symbols.items() if part in name)

    def rest(self, begin, until=None):
        """Nothing moves from one frame to another, or to now."""
        for number, frame in enumerate(self.bus.frames[begin:until], begin):
            expect(not moves(*frame), f"frame {number} moves: {frame[1].hex()}")

    def rest_until_armed(self, begin):
        armed = self.bus.wait_for("confirmation of arming", confirms_arm, begin)
        self.rest(begin, armed)
        return armed


def sync_lost(run):
    run.simulator.send_signal(signal.SIGSTOP)
    time.sleep(0.5)  # what was on the way has come
    begin = len(run.bus.frames)
    at = run.bus.wait_for("fault report", is_report, begin)
    expect(code(run.bus.frames[at]) == "sync_lost", f"told {code(run.bus.frames[at])}")
    time.sleep(0.5)
    run.rest(begin)
    return "told sync_lost, torque 0"


def reset(run):
    begin = len(run.bus.frames)
    run.board.ask("system_reset")
    ended = run.bus.wait_for("first answer after the reset", lambda identifier, data: identifier == WHEEL_COMMAND and not any(data[2:]),
                             begin)
    run.rest_until_armed(ended)
    return "nothing moved until it was armed again"


def weights(run):
    with run.debugger() as debugger:
        at = run.symbol("5layerILj0")  # Packed<policy>::layer<0>
        debugger.write(at, bytes([debugger.read(at, 1)[0] ^ 1]))
        begin = len(run.bus.frames)
        debugger.go()
        at = run.bus.wait_for("fault report", is_report, begin)
        expect(code(run.bus.frames[at]) == "policy_corrupt", f"told {code(run.bus.frames[at])}")
        time.sleep(1)
        run.rest(at)
    return "told policy_corrupt, torque 0"


def bus_off(run):
    """QEMU's CAN controllers count no errors: the driver is made to tell that it is off the bus, and then that it is back."""
    with run.debugger() as debugger:
        at = run.symbol("can_health") & ~1
        driver = debugger.read(at, len(BUS_OFF))
        debugger.write(at, BUS_OFF)
        begin = len(run.bus.frames)
        debugger.go()
        reported = run.bus.wait_for("fault report", is_report, begin)
        expect(code(run.bus.frames[reported]) == "bus_off", f"told {code(run.bus.frames[reported])}")
        time.sleep(0.5)
        run.rest(reported)
        debugger.stop()
        debugger.write(at, driver)
        back = len(run.bus.frames)
        debugger.go()
        run.rest_until_armed(back)
    return "told bus_off, torque 0; back on the bus nothing moved until it was armed again"


def broken(run, instructions, cause):
    with run.debugger() as debugger:
        debugger.run_to(run.symbol("receive_can") & ~1)
        debugger.write(at := debugger.pc(), instructions)
        debugger.run_to(run.symbol("end_by_fault") & ~1)
        begin = len(run.bus.frames)
        debugger.go()
        time.sleep(1)
        spoke = [frame for frame in run.bus.frames[begin:] if frame[0] in CONTROLLERS]
        if run.entry["qemu"]["power_on"]:
            expect(not spoke, "a stopped processor sends nothing")
        record = run.record()
        expect(CAUSES.get(record[1]) == cause, f"the record tells {CAUSES.get(record[1])}")
        # Flash is loaded again at a reset of the machine; the record's memory is not.
        begin = len(run.bus.frames)
        run.board.ask("system_reset")
        reported = run.bus.wait_for("fault report", is_report, begin)
        expect(code(run.bus.frames[reported]) == "processor_exception", f"told {code(run.bus.frames[reported])}")
        run.rest_until_armed(begin)
    return f"record: {cause}, exception {record[2]}, at {record[4]:#x}; told after the reset, nothing moved until it was armed again"


def undefined_instruction(run):
    return broken(run, UNDEFINED, "exception")


def stack_overflow(run):
    return broken(run, PUSH_FOR_EVER, "stack overflow")


CASES = {"SYNC lost": sync_lost, "reset in mid-run": reset, "altered weights": weights, "bus-off": bus_off,
         "undefined instruction": undefined_instruction, "stack overflow": stack_overflow}


def bus_table(options, bus):
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        line = [os.path.join(options.build_dir, "bin", "striker-sil"), "faults", "--plan", PLAN, "--episodes", "1",
                "--seed", str(options.seed), "--bus", bus, "--json", report]
        done = subprocess.run(line, capture_output=True, text=True, check=False)
        expect(done.returncode == 0, f"{bus}: status {done.returncode}: {done.stderr}")
        with open(report, encoding="utf-8") as file:
            return json.load(file)["rows"]


def play_on_the_bus(options, entry, image, interface):
    with (tempfile.TemporaryDirectory() as folder,
          pil_board.Board(entry, image, interface, folder, counts=False)):
        on_the_board = bus_table(options, f"can:{interface}")
    for row, other in zip(on_the_board, bus_table(options, "inproc"), strict=True):
        name = row.get("name") or row.get("case")
        expect(row == other, f"{name}: on the board {row}, in process {other}")
        print(f"ok: {name}: {row['detected_by']}, {row['outcome']}, as in process", flush=True)


def play(options, entry, image, interface):
    """Every case, or the one that was asked for; the exit status."""
    good = True
    cases = {"bus": None, **CASES}
    for name, case in cases.items():
        if options.case not in (None, name):
            continue
        try:
            if case is None:
                play_on_the_bus(options, entry, image, interface)
                continue
            with contextlib.ExitStack() as stack:
                print(f"ok: {name}: {case(Run(options, entry, image, interface, stack))}", flush=True)
        except (Failure, gdb_remote.DebugError, pil_board.BoardError) as failure:
            good = False
            print(f"FAILED: {name}: {failure}", flush=True)
    return 0 if good else 1
