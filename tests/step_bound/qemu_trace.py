# SPDX-License-Identifier: Apache-2.0
"""What QEMU executes of an image, translation block by translation block, while it runs."""

import contextlib
import os
import re
import subprocess
import tempfile
import threading

import qemu_image

TRACE = re.compile(r"^Trace \d+: 0x[0-9a-f]+ \[[0-9a-f]+/([0-9a-f]+)/")
GUEST_CODE = re.compile(r"^0x([0-9a-f]+):")


def own_instructions(instructions, listed):
    """QEMU's disassembler does not know Armv8.1-M: the listed range, cut by the analysis' own instructions."""
    found, address = [], listed[0]
    while address <= listed[-1] and address in instructions:
        found.append(address)
        address = instructions[address].next
    return tuple(found if address > listed[-1] else listed)


def blocks(lines, instructions):
    """The addresses of each block that ran, as a tuple that is the same object each time. QEMU tells one before it runs, and
    takes it back where an interrupt comes first."""
    known, reading, told = {}, [], None
    for line in lines:
        if line[0] == "T" and (match := TRACE.match(line)):
            if reading:
                known[reading[0]] = own_instructions(instructions, reading)
                reading = []
            if told is not None:
                yield told
            told = known[int(match[1], 16)]
        elif line.startswith("Stopped execution"):
            told = None
        elif line.startswith("IN:"):
            reading = []
        elif code := GUEST_CODE.match(line):
            reading.append(int(code[1], 16))
    if told is not None:
        yield told


@contextlib.contextmanager
def traced(board, image, words, ranges):
    """The trace's lines, of code within the ranges (start, size)."""
    with tempfile.TemporaryDirectory() as folder:
        pipe, control = os.path.join(folder, "trace"), os.path.join(folder, "qmp.sock")
        os.mkfifo(pipe)
        line = qemu_image.command(board, image, [os.path.basename(image)] + [str(word) for word in words])
        at = line.index("-icount")
        del line[at:at + 2]  # blocks run whole
        line += ["-d", "in_asm,exec,nochain", "-D", pipe, "-dfilter", ",".join(f"{start:#x}+{size:#x}" for start, size in ranges)]
        power_on = board["qemu"]["power_on"]
        if power_on:
            line += ["-qmp", f"unix:{control},server=on,wait=off"]
        with subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            kept = []
            if power_on:
                threading.Thread(target=lambda: kept.append(qemu_image._switch_on(power_on, control, process)), daemon=True).start()
            try:
                with open(pipe, encoding="utf-8", errors="replace") as lines:
                    yield lines
                process.communicate(timeout=60)
            finally:
                if process.poll() is None:
                    process.kill()
                for connection in kept:
                    connection.close()
