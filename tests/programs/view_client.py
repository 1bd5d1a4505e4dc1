# SPDX-License-Identifier: Apache-2.0
"""A run with a live view, and clients of it: a plain WebSocket (RFC 6455), and Debian's Chromium over its DevTools protocol
through pipes."""

import base64
import fcntl
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
        """The next message of the server's, as JSON; None for a close."""
        while True:
            first, length = self.take(2)
            if length == 126:
                length = struct.unpack(">H", self.take(2))[0]
            elif length == 127:
                length = struct.unpack(">Q", self.take(8))[0]
            data = self.take(length)
            if first & 0xF == 8:
                return None
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


class Browser:
    """Chromium without a window. It hears no more than a debugger's messages, through two pipes."""

    def __init__(self, profile):
        low_read, self.to = os.pipe()
        self.back, low_write = os.pipe()
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (low_read, low_write)]
        words = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
                 f"--user-data-dir={profile}", "--remote-debugging-pipe", "about:blank"]
        # Chromium reads from 3 and writes to 4.
        self.process = subprocess.Popen(["bash", "-c", f'exec "$@" 3<&{ends[0]} 4>&{ends[1]}', "bash", *words],  # pylint: disable=consider-using-with
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, pass_fds=ends)
        for end in (low_read, low_write, *ends):
            os.close(end)
        self.bytes = b""
        self.number = 0
        self.events = []
        page = next(target for target in self.call("Target.getTargets")["targetInfos"] if target["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=page["targetId"], flatten=True)["sessionId"]
        for room in ("Page", "Runtime", "Log"):
            self.ask(f"{room}.enable")

    def call(self, method, session=None, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.bytes:
                more = os.read(self.back, 1 << 20)
                if not more:
                    raise ConnectionError("chromium has ended")
                self.bytes += more
            text, _, self.bytes = self.bytes.partition(b"\0")
            answer = json.loads(text)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise AssertionError(answer["error"])
                return answer["result"]
            self.events.append(answer)

    def ask(self, method, **parameters):
        return self.call(method, self.session, **parameters)

    def open(self, url):
        self.ask("Page.navigate", url=url)

    def value(self, script):
        result = self.ask("Runtime.evaluate", expression=script, returnByValue=True)
        if "exceptionDetails" in result:
            raise AssertionError(result["exceptionDetails"])
        return result["result"].get("value")

    def until(self, script, seconds=60):
        """The value of the script as soon as it is true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = self.value(script)
            if value:
                return value
            time.sleep(0.03)
        shown = self.value("document.body.innerText.slice(0, 1500)")
        raise AssertionError(f"never true: {script}; the page says: {shown}; {self.problems()}")

    def click(self, selector):
        """With a mouse, in the middle of what the selector names."""
        place = self.value(f"""(() => {{ const one = document.querySelector({json.dumps(selector)});
            one.scrollIntoView({{ block: "center" }}); const box = one.getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2]; }})()""")
        for kind in ("mousePressed", "mouseReleased"):
            self.ask("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", clickCount=1)

    def picture(self, file):
        with open(file, "wb") as stream:
            stream.write(base64.b64decode(self.ask("Page.captureScreenshot", format="png")["data"]))

    def problems(self):
        """What the page threw or wrote to the console as an error."""
        return [event for event in self.events
                if event["method"] == "Runtime.exceptionThrown" or
                (event["method"] == "Log.entryAdded" and event["params"]["entry"]["level"] == "error")]

    def close(self):
        try:
            self.call("Browser.close")
        except (OSError, ConnectionError):
            pass
        self.process.wait(timeout=30)
        os.close(self.to)
        os.close(self.back)
