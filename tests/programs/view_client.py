# SPDX-License-Identifier: Apache-2.0
"""A run with a live view, and a client of it: a plain WebSocket (RFC 6455)."""

import base64
import json
import os
import re
import socket
import struct
import subprocess
import time


class Run:
    """striker-sil with --view, in this folder; its terminal's text stays in files."""

    def __init__(self, program, folder, *words):
        self.folder = folder
        self.words = words
        self.out, self.err = (os.path.join(folder, name) for name in ("stdout", "stderr"))
        with open(self.out, "wb") as out, open(self.err, "wb") as err:
            self.process = subprocess.Popen([program, *words], cwd=folder, stdout=out, stderr=err)  # pylint: disable=consider-using-with
        self.url = self.wait_for(r"live view: (http://\S+)")
        self.host, port, self.token = re.fullmatch(r"http://(.+):(\d+)/\?token=([0-9a-f]{32})", self.url).groups()
        self.port = int(port)

    def text(self):
        with open(self.err, encoding="utf-8", errors="replace") as file:
            return file.read()

    def wait_for(self, pattern, seconds=30):
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            found = re.search(pattern, self.text())
            if found:
                return found.group(1)
            if self.process.poll() is not None:
                break
            time.sleep(0.02)
        raise AssertionError(f"no {pattern} in: {self.text()}")

    def connect(self):
        return socket.create_connection((self.host, self.port), timeout=30)

    def upgrade(self, target=None, origin=None, host=None):
        """The bytes that ask for the WebSocket."""
        here = f"{self.host}:{self.port}"
        lines = [f"GET {target or '/live?token=' + self.token} HTTP/1.1", f"Host: {host or here}",
                 "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                 f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}"]
        if origin != "":
            lines.append(f"Origin: {origin or 'http://' + here}")
        return ("\r\n".join(lines) + "\r\n\r\n").encode()

    def ended(self, seconds=120):
        status = self.process.wait(timeout=seconds)
        with open(self.out, encoding="utf-8") as file:
            return status, file.read(), self.text()

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()


class Viewer:
    """One WebSocket that was let in."""

    def __init__(self, run):
        self.socket = run.connect()
        self.socket.sendall(run.upgrade())
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            self.fill()
        head, _, self.bytes = self.bytes.partition(b"\r\n\r\n")
        if b" 101 " not in head:
            self.socket.close()
            raise ConnectionError(head.decode())
        self.state = None

    def fill(self):
        more = self.socket.recv(65536)
        if not more:
            raise ConnectionError("closed")
        self.bytes += more

    def take(self, count):
        while len(self.bytes) < count:
            self.fill()
        taken, self.bytes = self.bytes[:count], self.bytes[count:]
        return taken

    def receive(self):
        """The next message of the server's, as JSON; None for a close. Answers its pings meanwhile."""
        while True:
            first, length = self.take(2)
            if length == 126:
                length = struct.unpack(">H", self.take(2))[0]
            elif length == 127:
                length = struct.unpack(">Q", self.take(8))[0]
            data = self.take(length)
            if first & 0xF == 8:
                return None
            if first & 0xF == 9:
                self.send_frame(data, first=0x8A)
            if first & 0xF == 1:
                return json.loads(data)

    def send_frame(self, data, first=0x81, length=None):
        """Masked, as a client has to. `length` is what is told, if not the truth."""
        told = len(data) if length is None else length
        mask = os.urandom(4)
        size = (bytes([0x80 | told]) if told < 126 else
                bytes([0x80 | 126]) + struct.pack(">H", told) if told < 65536 else
                bytes([0x80 | 127]) + struct.pack(">Q", told))
        self.socket.sendall(bytes([first]) + size + mask + bytes(one ^ mask[i % 4] for i, one in enumerate(data)))

    def send(self, **command):
        self.send_frame(json.dumps(command).encode())

    def states(self):
        while True:
            message = self.receive()
            if message is None or "ended" in message:
                return
            if "state" in message:
                yield message["state"]

    def until(self, holds):
        for state in self.states():
            if holds(state):
                return state
        raise AssertionError("the run ended before")

    def close(self):
        self.socket.close()
