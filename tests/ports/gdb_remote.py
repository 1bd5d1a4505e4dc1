# SPDX-License-Identifier: Apache-2.0
"""QEMU's debug port (the GDB remote serial protocol), as far as a test has to stop a processor, look, and go on."""

import select
import socket
import struct
import time


class DebugError(Exception):
    """The debug port refused something, or the processor did not stop in time."""


class Debugger:
    """Packets: $text#checksum, each acknowledged with +. Attached to one cluster of processors, the first is 1."""

    def __init__(self, path, cluster=1, processor=1):
        self._socket = socket.socket(socket.AF_UNIX)
        self._waiting = b""
        for _ in range(200):
            try:
                self._socket.connect(path)
                break
            except OSError:
                time.sleep(0.05)
        else:
            raise DebugError("QEMU's debug port did not come up within 10 s")
        # Attaching stops the machine, which may or may not be told.
        self._send("qSupported:multiprocess+")
        while self._packet(0.2) is not None:
            pass
        if cluster != 1:
            self.ask(f"vAttach;{cluster:x}")
        thread = f"p{cluster:x}.{processor:x}"
        self.ask(f"Hg{thread}")
        self.ask(f"Hc{thread}")

    def close(self):
        self._socket.close()

    def ask(self, text):
        self._send(text)
        answer = self._packet(10)
        if answer is None or answer.startswith("E"):
            raise DebugError(f"{text}: {answer}")
        return answer

    def stop(self):
        self._socket.sendall(b"\x03")
        self.wait()

    def go(self):
        self._send("c")

    def wait(self, timeout_s=30):
        """Until the processor has stopped, at a breakpoint or as asked."""
        if self._packet(timeout_s) is None:
            raise DebugError(f"the processor did not stop within {timeout_s} s")

    def run_to(self, address, timeout_s=30):
        self.ask(f"Z0,{address:x},2")
        self.go()
        self.wait(timeout_s)
        self.ask(f"z0,{address:x},2")

    def read(self, address, size):
        return bytes.fromhex(self.ask(f"m{address:x},{size:x}"))

    def word(self, address):
        return struct.unpack("<I", self.read(address, 4))[0]

    def write(self, address, data):
        self.ask(f"M{address:x},{len(data):x}:{data.hex()}")

    def pc(self):
        return struct.unpack_from("<I", bytes.fromhex(self.ask("g")[:128]), 60)[0]

    def _send(self, text):
        self._socket.sendall(f"${text}#{sum(text.encode()) & 0xFF:02x}".encode())

    def _packet(self, timeout_s):
        """The next packet's text, or None if none came in time."""
        end = time.monotonic() + timeout_s
        while True:
            start = self._waiting.find(b"$")
            stop = self._waiting.find(b"#", start)
            if start >= 0 and 0 <= stop <= len(self._waiting) - 3:
                text = self._waiting[start + 1:stop].decode()
                self._waiting = self._waiting[stop + 3:]
                self._socket.sendall(b"+")
                return text
            if not select.select([self._socket], [], [], max(0, end - time.monotonic()))[0]:
                return None
            received = self._socket.recv(65536)
            if not received:
                raise DebugError("QEMU closed the debug port")
            self._waiting += received
