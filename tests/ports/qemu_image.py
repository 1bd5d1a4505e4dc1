# SPDX-License-Identifier: Apache-2.0
"""Runs a bare-metal image on the board that QEMU emulates for it, with one nanosecond an instruction unless told otherwise."""

import argparse
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time


class ImageError(Exception):
    """The image could not run, or ended with a status other than 0."""


def read_boards(path):
    """The boards that QEMU emulates, by name, of the boards.json that a host's build writes."""
    try:
        with open(path, encoding="utf-8") as text:
            return {board["name"]: board for board in json.load(text) if board["qemu"]}
    except FileNotFoundError:
        raise ImageError(f"no {path}: cmake --preset release writes it") from None


def board_parser(description):
    """Of a program that asks `read_board` for the board that its command line names."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--board", required=True)
    parser.add_argument("--boards", required=True, help="boards.json, of the host's build folder")
    return parser


def read_board(path, name):
    boards = read_boards(path)
    if name not in boards:
        raise ImageError(f"--board: '{name}' is none of {path}: {', '.join(boards)}")
    return boards[name]


def _semihosting(words):
    return ["-chardev", "stdio,id=console", "-semihosting-config",
            ",".join(["enable=on", "target=native", "chardev=console"] + [f"arg={word}" for word in words])]


def machine(board, image, icount_shift=0):
    """QEMU's command line for the board with the image in its memory, but without anything to say it with. An instruction
    takes 2 ^ `icount_shift` nanoseconds: where nobody counts them, an image that waits is over sooner with more."""
    qemu = board["qemu"]
    start = [word.replace("{image}", image) for word in qemu["arguments"]]
    return [qemu["system"], "-M", qemu["machine"], *start, "-display", "none", "-monitor", "none", "-icount", f"shift={icount_shift}"]


def command(board, image, words):
    """QEMU's command line, but for what a processor that has to be switched on needs beside it."""
    return machine(board, image) + ["-serial", "none"] + _semihosting(words)


def _switch_on(processor, path, process, starts=True):
    """QEMU leaves the processor off: asked over QMP, it starts at the image's entry, or waits there for a debugger."""
    connection = socket.socket(socket.AF_UNIX)
    for _ in range(200):
        if process.poll() is not None:
            raise ImageError(f"QEMU ended at once:\n{process.stderr.read()}")
        try:
            connection.connect(path)
            break
        except OSError:
            time.sleep(0.05)
    else:
        raise ImageError("QEMU's control socket did not come up within 10 s")
    stream = connection.makefile("rw")
    stream.readline()
    for request in (
        {"execute": "qmp_capabilities"},
        {"execute": "qom-set", "arguments": {"path": processor, "property": "start-powered-off", "value": False}},
        {"execute": "system_reset"},
        *([{"execute": "cont"}] if starts else []),
    ):
        stream.write(json.dumps(request) + "\n")
        stream.flush()
        while "event" in (answer := json.loads(stream.readline())):
            pass
        if "error" in answer:
            raise ImageError(f"QEMU: {answer['error']['desc']}")
    return connection


def run(board, image, words=(), timeout_s=600):
    """The image's output, once it has ended with status 0."""
    name, power_on = board["name"], board["qemu"]["power_on"]
    line = command(board, image, [os.path.basename(image)] + [str(word) for word in words])
    if shutil.which(line[0]) is None:
        raise ImageError(f"no {line[0]}: tools/setup installs it (Debian: qemu-system-arm)")
    if not os.path.exists(image):
        raise ImageError(f"no image {image}: cmake --preset {name} && cmake --build --preset {name}")
    with tempfile.TemporaryDirectory() as folder:
        control = os.path.join(folder, "qmp.sock")
        if power_on:
            line += ["-qmp", f"unix:{control},server=on,wait=off"]
        with subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as process:
            connection = None
            try:
                if power_on:
                    connection = _switch_on(power_on, control, process)
                output, complaints = process.communicate(timeout=timeout_s)
            except subprocess.TimeoutExpired as expired:
                raise ImageError(f"{name}: no end within {timeout_s} s") from expired
            finally:
                if process.poll() is None:
                    process.kill()
                if connection is not None:
                    connection.close()
    if process.returncode != 0:
        raise ImageError(f"{name}: {os.path.basename(image)} ended with status {process.returncode}:\n{output}{complaints}")
    return output


def numbers(output):
    """The "name number" lines of an image's output."""
    found = {}
    for text in output.splitlines():
        name, _, value = text.rpartition(" ")
        if name and value.lstrip("-").isdigit():
            found[name] = int(value)
    return found
