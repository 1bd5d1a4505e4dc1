#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Clients of the live view that are broken, slow or hostile: each is refused, whoever behaves is still served, and the run
writes the bytes that it writes without a view.

Usage: view_hostile_test.py BIN   (the folder of the programs)
"""

import os
import select
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from view_client import Run, Viewer

BIN = sys.argv.pop(1)
SIL = os.path.join(BIN, "striker-sil")
KICKS = ["kick", "--episodes", "10", "--seed", "4", "--log", "bus.log", "--json", "kick.json"]


def answer_to(run, data, patience=20):
    """Everything that comes back until the server closes."""
    with run.connect() as connection:
        connection.settimeout(patience)
        try:
            connection.sendall(data)
        except OSError:
            pass
        answer = b""
        try:
            while more := connection.recv(65536):
                answer += more
        except ConnectionError:
            pass
        return answer


def is_closed(viewer, within_s=10):
    """After what comes on its own, and long before a client is taken for dead."""
    begun = time.monotonic()
    viewer.socket.settimeout(within_s)
    try:
        while time.monotonic() - begun < within_s:
            if viewer.receive() is None:
                return True
    except (ConnectionError, ValueError):
        return True
    except socket.timeout:
        pass
    return False


def first_closed(connections, count):
    """The places of those that the server closes first."""
    closed = []
    while len(closed) < count:
        left = [one for place, one in enumerate(connections) if place not in closed]
        readable, _, _ = select.select(left, [], [], 20)
        if not readable:
            raise AssertionError(f"{len(closed)} were closed, not {count}")
        closed += [connections.index(one) for one in readable]
    return closed


class Hostile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.addClassCleanup(cls.temporary.cleanup)
        plain = os.path.join(cls.temporary.name, "plain")
        os.mkdir(plain)
        subprocess.run([SIL, *KICKS], cwd=plain, check=True, capture_output=True)
        with open(os.path.join(plain, "bus.log"), "rb") as log:
            cls.log = log.read()

    def begin(self):
        """Slow, so that it lasts for minutes."""
        run = Run(SIL, tempfile.mkdtemp(dir=self.temporary.name), *KICKS, "--view", "--view-speed", "0.1")
        self.addCleanup(run.close)
        return run

    def ends_as_without_a_view(self, run):
        """Speeds it up, and compares its files."""
        viewer = Viewer(run)
        viewer.send(do="speed", x="max")
        status, _, said = run.ended()
        viewer.close()
        self.assertEqual(status, 0, said)
        with open(os.path.join(run.folder, "bus.log"), "rb") as log:
            self.assertEqual(log.read(), self.log)

    def refused(self, run, data, status):
        answer = answer_to(run, data)
        self.assertTrue(answer.startswith(b"HTTP/1.1 " + status), (data[:80], answer[:80]))
        self.assertNotIn(run.token.encode(), answer)
        self.assertNotIn(b"<script", answer)

    def test_requests_that_are_not_let_in(self):
        run = self.begin()
        here = f"{run.host}:{run.port}"
        page = f"GET /?token={run.token} HTTP/1.1\r\n"
        for request in (run.upgrade(target="/live"), run.upgrade(target="/live?token=" + "0" * 32), run.upgrade(origin=""),
                        run.upgrade(origin="http://evil.example"), run.upgrade(origin="null"),
                        run.upgrade(host=f"evil.example:{run.port}", origin=f"http://evil.example:{run.port}"),
                        run.upgrade().replace(b"Origin:", f"Origin: http://{here}\r\nOrigin:".encode()),
                        f"GET / HTTP/1.1\r\nHost: {here}\r\n\r\n".encode(), (page + "\r\n").encode(),
                        f"{page}Host: evil.example:{run.port}\r\n\r\n".encode(),
                        f"{page}Host: {here}\r\nHost: {here}\r\n\r\n".encode(),
                        f"GET /etc/passwd HTTP/1.1\r\nHost: {here}\r\n\r\n".encode()):
            self.refused(run, request, b"403")
        self.refused(run, f"GET /x?token={run.token} HTTP/1.1\r\nHost: {here}\r\n\r\n".encode(), b"404")
        self.refused(run, f"DELETE /?token={run.token} HTTP/1.1\r\nHost: {here}\r\n\r\n".encode(), b"405")
        let_in = answer_to(run, f"{page}Host: {here}\r\n\r\n".encode())
        self.assertTrue(let_in.startswith(b"HTTP/1.1 200"), let_in[:80])
        for promise in (b"Content-Security-Policy: default-src 'none'; ", b"connect-src 'self'; ", b"frame-ancestors 'none'",
                        b"Referrer-Policy: no-referrer", b"Cache-Control: no-store"):
            self.assertIn(promise, let_in.partition(b"\r\n\r\n")[0])
        for way_out in (b"http://", b"https:", b"src=", b"@import"):
            self.assertNotIn(way_out, let_in)
        self.ends_as_without_a_view(run)

    def test_bytes_that_are_no_request(self):
        run = self.begin()
        here = f"{run.host}:{run.port}"
        head = f"GET /?token={run.token} HTTP/1.1\r\nHost: {here}\r\n"
        for data in (b"\0" * 5000, os.urandom(5000), b"GET\r\n\r\n", b"A" * 100_000, head.encode() + b"X: " + b"y" * 8000,
                     head.encode() + b"".join(b"X%d: y\r\n" % i for i in range(2000)) + b"\r\n",
                     f"{head}Content-Length: 1000000\r\n\r\n".encode() + b"z" * 10_000,
                     f"{head}Transfer-Encoding: chunked\r\n\r\nffffffff\r\n".encode(), b"\x16\x03\x01\x02\x00\x01\x00"):
            self.assertNotIn(b"200 OK", answer_to(run, data))
        self.ends_as_without_a_view(run)

    def test_messages_that_are_no_commands_close_their_connection(self):
        run = self.begin()
        attacks = {
            "no JSON": lambda one: one.send_frame(b"hello"),
            "no command": lambda one: one.send(do="shell"),
            "too long": lambda one: one.send_frame(b'{"do":"pause"' + b" " * 300 + b"}"),
            "a length of 2^62": lambda one: one.send_frame(b"x" * 100, length=1 << 62),
            "binary": lambda one: one.send_frame(b'{"do":"pause"}', first=0x82),
            "no UTF-8": lambda one: one.send_frame(b"\xff\xfe", first=0x81),
            "a reserved operation": lambda one: one.send_frame(b"", first=0x8B),
            "reserved bits": lambda one: one.send_frame(b"x", first=0xF1),
            "not masked": lambda one: one.socket.sendall(b"\x81\x0e" + b'{"do":"pause"}'),
            "fragments without an end": lambda one: [one.send_frame(b" " * 100, first=first) for first in [1] + 50 * [0]],
            "a long ping": lambda one: one.send_frame(b"x" * 126, first=0x89),
            "random bytes": lambda one: one.socket.sendall(os.urandom(10_000)),
            "a command every 10 ms": lambda one: [(one.send(do="speed", x=0.1), time.sleep(0.01)) for _ in range(200)],
            "a flood of commands": lambda one: [one.send(do="speed", x=1) for _ in range(500)],
        }
        for name, attack in attacks.items():
            viewer = Viewer(run)
            try:
                attack(viewer)
            except ConnectionError:
                pass
            self.assertTrue(is_closed(viewer), name)
            viewer.close()
        watcher = Viewer(run)
        self.assertFalse(watcher.until(lambda state: True)["paused"])
        watcher.close()
        self.ends_as_without_a_view(run)

    def test_a_flood_of_pings_is_read_as_slowly_as_messages_and_others_are_served(self):
        run = self.begin()
        watcher, flooder = Viewer(run), Viewer(run)
        begun = time.monotonic()
        ping = bytes([0x89, 0x80, 1, 2, 3, 4])

        def flood():
            try:
                while time.monotonic() - begun < 3:
                    flooder.socket.sendall(1000 * ping)
            except OSError:
                pass

        thread = threading.Thread(target=flood)
        thread.start()
        answered = 0
        flooder.socket.settimeout(0.1)
        while time.monotonic() - begun < 3:
            try:
                answered += flooder.socket.recv(65536).count(b"\x8a\x00")
            except socket.timeout:
                pass
        self.assertGreater(answered, 100)
        self.assertLess(answered, (time.monotonic() - begun + 2) * 16 * 1024 / len(ping))
        watcher.until(lambda state: state["tick"] > 0)
        flooder.close()
        thread.join()
        self.ends_as_without_a_view(run)

    def test_connections_that_never_ask_end_and_keep_nobody_out_for_long(self):
        run = self.begin()
        half, quiet = Viewer(run), Viewer(run)
        half.socket.sendall(bytes([0x81, 0x80 | 20, 1, 2, 3, 4]) + b"half")  # of a frame, and no more of it
        listener = threading.Thread(target=lambda: list(quiet.states()))
        listener.start()
        silent = [run.connect() for _ in range(100)]
        self.assertGreaterEqual(min(first_closed(silent, 30)), 60, "those that were too many are closed before any other")
        slow = run.connect()
        begun = time.monotonic()
        dribbled = 0
        try:
            while time.monotonic() - begun < 30:
                slow.sendall(b"G")
                dribbled += 1
                time.sleep(0.5)
        except OSError:
            pass
        self.assertLess(dribbled, 60, "the slow one was never closed")
        for connection in silent:
            connection.settimeout(20)
            try:
                self.assertEqual(connection.recv(1), b"")
            except ConnectionError:
                pass
            connection.close()
        slow.close()
        half.socket.settimeout(40)
        try:
            while half.socket.recv(65536):  # and no ping is answered
                pass
        except ConnectionError:
            pass
        self.assertGreater(time.monotonic() - begun, 15)
        self.assertTrue(listener.is_alive(), "who answers pings stays")
        self.ends_as_without_a_view(run)
        listener.join()
        quiet.close()

    def test_ten_viewers_of_whom_five_never_read_and_a_crowd_behind_them(self):
        run = self.begin()
        readers = [Viewer(run) for _ in range(5)]
        never = [Viewer(run) for _ in range(5)]
        seen = [0] * len(readers)

        def read(number):
            for _ in readers[number].states():
                seen[number] += 1

        threads = [threading.Thread(target=read, args=(number,)) for number in range(len(readers))]
        for thread in threads:
            thread.start()
        crowd = []
        for _ in range(30):
            try:
                crowd.append(Viewer(run))
            except ConnectionError:
                pass
        self.assertLessEqual(len(crowd) + 10, 16)
        for one in crowd:
            one.close()
        time.sleep(1)
        self.ends_as_without_a_view(run)
        for thread in threads:
            thread.join(30)
            self.assertFalse(thread.is_alive())
        self.assertTrue(all(count > 5 for count in seen), seen)
        for one in readers + never:
            one.close()

    def test_a_port_in_use_is_told_in_a_line(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            done = subprocess.run([SIL, "kick", "--view", str(port)], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn(f"--view {port}", done.stderr)
        self.assertIn("give another port", done.stderr)

    def test_wrong_options_are_told_in_a_line(self):
        for words, named in ((["--view", "70000"], "--view"), (["--view", "--view-bind", "nowhere"], "--view-bind nowhere"),
                             (["--view", "--view-speed", "0"], "--view-speed"), (["--view-speed", "1"], "--view")):
            done = subprocess.run([SIL, "kick", *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(named, done.stderr)

    def test_a_stop_signal_ends_a_paused_run_with_a_viewer_who_never_reads(self):
        run = self.begin()
        viewer = Viewer(run)
        viewer.send(do="pause")
        viewer.until(lambda state: state["paused"])
        run.process.terminate()
        self.assertEqual(run.ended(30)[0], 130)
        viewer.close()


if __name__ == "__main__":
    unittest.main()
