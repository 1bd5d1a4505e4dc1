# SPDX-License-Identifier: Apache-2.0
"""A board that QEMU emulates, with its image running, on a CAN interface of this kernel: with the board's own CAN
controller where QEMU has that, else over slcan on the board's first serial port."""

import json
import os
import re
import socket
import struct
import subprocess
import sys
import threading
import time

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "ports"), os.path.join(ROOT, "firmware", "ports", "bare_metal")]

import qemu_image  # noqa: E402
import stack_usage  # noqa: E402

PAINT = 0xC5C5C5C5
START_LIMIT_S = 120
SO_RCVBUFFORCE = 33  # Linux, asm-generic/socket.h


class BoardError(Exception):
    """QEMU did not come up, or ended."""


def open_can(interface):
    bus = socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    try:
        bus.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, 16 << 20)
    except PermissionError:
        bus.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 16 << 20)
    bus.bind((interface,))
    return bus


def to_slcan(packet):
    """A frame of a CAN socket as an slcan line; nothing for what is no standard data frame."""
    identifier, length, data = struct.unpack("=IB3x8s", packet)
    if identifier > 0x7FF:
        return b""
    return f"t{identifier:03X}{length}{data[:length].hex().upper()}\r".encode()


def from_slcan(line):
    """An slcan line as a frame for a CAN socket; None for what is none."""
    if not re.fullmatch(rb"t[0-7][0-9A-F]{2}[0-8]([0-9A-F]{2})*", line) or len(line) != 5 + 2 * int(line[4:5]):
        return None
    data = bytes.fromhex(line[5:].decode())
    return struct.pack("=IB3x8s", int(line[1:4], 16), len(data), data.ljust(8, b"\0"))


class SlcanBridge:
    """Between a serial port, as an open file descriptor, and a CAN interface: a thread each way, until the port closes."""

    def __init__(self, port, interface):
        self._port = port
        self._can = open_can(interface)
        self._threads = [threading.Thread(target=loop, daemon=True) for loop in (self._to_board, self._from_board)]
        for thread in self._threads:
            thread.start()

    def _to_board(self):
        try:
            while True:
                line = to_slcan(self._can.recv(16))
                while line:
                    line = line[os.write(self._port, line):]
        except OSError:
            return  # closed

    def _from_board(self):
        waiting = b""
        try:
            while received := os.read(self._port, 65536):
                *lines, waiting = (waiting + received).split(b"\r")
                for packet in filter(None, map(from_slcan, lines)):
                    self._can.send(packet)
        except OSError:
            return

    def close(self):
        self._can.close()


class Board:
    """`with Board(entry of boards.json, image, interface, folder) as board:` runs it; the end of the block ends it.
    `counts`: virtual time counts instructions, one a nanosecond (-icount shift=0).
    Without an interface a board that speaks slcan has its serial port in `serial`, for a bridge elsewhere."""

    def __init__(self, board, image, interface, folder, counts=True):
        self._board, self._image, self._interface, self._folder = board, image, interface, folder
        self._counts = counts
        self._is_bridged = not board["qemu"]["can"]
        self.serial = self._bridge = self._control = None
        self.symbols = stack_usage.symbols(image)

    def path(self, name):
        return os.path.join(self._folder, name)

    def _command(self):
        line = qemu_image.machine(self._board, self._image)
        if not self._counts:
            at = line.index("-icount")
            del line[at:at + 2]
        if can := self._board["qemu"]["can"]:
            line[line.index("-M") + 1] += f",{can}=pil"
            line += ["-object", "can-bus,id=pil", "-serial", "none",
                     "-object", f"can-host-socketcan,id=host,if={self._interface},canbus=pil"]
        else:
            line += ["-serial", f"unix:{self.path('serial')},server=on,wait=on"]
        return line + ["-qmp", f"unix:{self.path('qmp')},server=on,wait=off",
                       "-gdb", f"unix:{self.path('gdb')},server=on,wait=off"]

    def __enter__(self):
        with open(self.path("qemu.log"), "wb") as log:
            self._process = subprocess.Popen(self._command(), stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        try:
            if self._is_bridged:
                self.serial = self._connect("serial")
                if self._interface:
                    self._bridge = SlcanBridge(self.serial.fileno(), self._interface)
            self._control = self._connect("qmp")
            self._control.settimeout(START_LIMIT_S)
            self._stream = self._control.makefile("rw")
            self._stream.readline()
            self.ask("qmp_capabilities")
            if processor := self._board["qemu"]["power_on"]:
                self.ask("qom-set", path=processor, property="start-powered-off", value=False)
                self.ask("system_reset")
                self.ask("cont")
            self._step_back()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self._process.kill()
        self._process.wait()
        for end in (self._bridge, self.serial, self._control):
            if end is not None:
                end.close()

    def _step_back(self):
        """On one processor the board's, which polls for ever, runs only while nobody else has anything to do."""
        if os.cpu_count() == 1:
            for processor in self.ask("query-cpus-fast"):
                os.sched_setscheduler(processor["thread-id"], os.SCHED_IDLE, os.sched_param(0))

    def _connect(self, name):
        end = time.monotonic() + START_LIMIT_S
        while time.monotonic() < end:
            if self._process.poll() is not None:
                with open(self.path("qemu.log"), encoding="utf-8", errors="replace") as log:
                    raise BoardError(f"QEMU ended at once:\n{log.read()}")
            connection = socket.socket(socket.AF_UNIX)
            try:
                connection.connect(self.path(name))
                return connection
            except OSError:
                connection.close()
                time.sleep(0.05)
        raise BoardError(f"QEMU's {name} did not come up within {START_LIMIT_S} s")

    def ask(self, command, **arguments):
        self._stream.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self._stream.flush()
        while "event" in (answer := json.loads(self._stream.readline())):
            pass
        if "error" in answer:
            raise BoardError(f"QEMU: {command}: {answer['error']['desc']}")
        return answer["return"]

    def read(self, symbol, size):
        """Bytes of the board's memory from a symbol of its image."""
        processor = 4 if self._board["qemu"]["power_on"] else 0  # the R5 comes after four others
        self.ask("memsave", **{"val": self.symbols[symbol], "size": size, "filename": self.path("memory"), "cpu-index": processor})
        with open(self.path("memory"), "rb") as memory:
            return memory.read()

    def word(self, symbol):
        return struct.unpack("<I", self.read(symbol, 4))[0]

    def deepest_stack(self):
        """Bytes of the stack that no longer hold the paint of start-up."""
        size = self.symbols["stack_top"] - self.symbols["stack_bottom"]
        words = struct.unpack(f"<{size // 4}I", self.read("stack_bottom", size))
        return size - 4 * next((i for i, word in enumerate(words) if word != PAINT), len(words))

    def step_instructions(self):
        """Of the dearest step, which lockstep/step_cost.hpp counted; SysTick's clock counts for several."""
        counts = self.word("greatest_step_counts")
        if "cortex-r" in self._board["cpu"]:
            return counts
        return counts * 1_000_000_000 // self._board["clock_hz"]
