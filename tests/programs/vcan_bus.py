# SPDX-License-Identifier: Apache-2.0
"""vcan0 from a test: frames on it, and logs of it."""

import os
import re
import socket
import struct
import time

SO_RCVBUFFORCE = 33  # Linux, asm-generic/socket.h
STANDARD_MASK = socket.CAN_SFF_MASK | socket.CAN_EFF_FLAG | socket.CAN_RTR_FLAG


def read_log(file):
    """[(stamp in ms, identifier, payload)] of a candump -L log."""
    frames = []
    with open(file, encoding="ascii") as log:
        for line in log:
            match = re.fullmatch(r"\((\d{10})\.(\d{6})\) vcan0 ([0-9A-F]{3})#([0-9A-F]*)", line.strip())
            frames.append((int(match[1]) * 1000 + int(match[2]) // 1000, int(match[3], 16), bytes.fromhex(match[4])))
    return frames


def wait_until_still(file):
    size = -1
    while size != os.path.getsize(file):
        size = os.path.getsize(file)
        time.sleep(0.5)


def listening(*identifiers):
    """A socket that hears these identifiers, or all. The kernel drops the newest frame where a reader is slow."""
    bus = socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    if identifiers:
        wanted = b"".join(struct.pack("=II", identifier, STANDARD_MASK) for identifier in identifiers)
        bus.setsockopt(socket.SOL_CAN_RAW, socket.CAN_RAW_FILTER, wanted)
    try:
        bus.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, 64 << 20)
    except PermissionError:
        bus.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 64 << 20)
    bus.bind(("vcan0",))
    bus.settimeout(0.05)
    return bus


def send(bus, identifier, payload):
    bus.send(struct.pack("=IB3x8s", identifier, len(payload), payload.ljust(8, b"\0")))


def collect(bus, seconds):
    frames = []
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            identifier, length, data = struct.unpack("=IB3x8s", bus.recv(16))
            frames.append((identifier, data[:length]))
        except TimeoutError:
            pass
    return frames
