"""Runs a bare-metal image on the board that QEMU emulates for it, with one nanosecond an instruction."""

import json
import os
import shutil
import socket
import subprocess
import tempfile
import time

# What a processor is called, and the machine that has one.
BOARDS = {
    "cortex-m0plus": ("Cortex-M0+", "microbit"),
    "cortex-m3": ("Cortex-M3", "mps2-an385"),
    "cortex-m4": ("Cortex-M4F", "mps2-an386"),
    "cortex-m7": ("Cortex-M7", "mps2-an500"),
    "cortex-m33": ("Cortex-M33", "mps2-an505"),
    "cortex-m55": ("Cortex-M55", "mps3-an547"),
    "cortex-r5": ("Cortex-R5F", "xlnx-zcu102"),
}


class ImageError(Exception):
    """The image could not run, or ended with a status other than 0."""


def _semihosting(words):
    return ["-chardev", "stdio,id=console", "-semihosting-config",
            ",".join(["enable=on", "target=native", "chardev=console"] + [f"arg={word}" for word in words])]


def command(cpu, image, words):
    """QEMU's command line, but for what the Cortex-R5F's start needs beside it."""
    machine = BOARDS[cpu][1]
    quiet = ["-display", "none", "-monitor", "none", "-serial", "none", "-icount", "shift=0"]
    if cpu == "cortex-r5":
        return [
            "qemu-system-aarch64", "-M", machine, "-smp", "5", "-m", "128M", "-audiodev", "none,id=a", "-S",
            "-global", "xlnx-zynqmp.boot-cpu=rpu-cpu[0]", "-device", f"loader,file={image},cpu-num=4",
        ] + quiet + _semihosting(words)
    return ["qemu-system-arm", "-M", machine, "-kernel", image] + quiet + _semihosting(words)


def _start_r5(path, process):
    """QEMU 7.2 leaves the R5 switched off: asked over QMP, it starts at the image's entry."""
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
        {"execute": "qom-set", "arguments": {"path": "/machine/soc/rpu-cluster/rpu-cpu[0]",
                                             "property": "start-powered-off", "value": False}},
        {"execute": "system_reset"},
        {"execute": "cont"},
    ):
        stream.write(json.dumps(request) + "\n")
        stream.flush()
        while "event" in (answer := json.loads(stream.readline())):
            pass
        if "error" in answer:
            raise ImageError(f"QEMU: {answer['error']['desc']}")
    return connection


def run(cpu, image, words=(), timeout_s=600):
    """The image's output, once it has ended with status 0."""
    line = command(cpu, image, [os.path.basename(image)] + [str(word) for word in words])
    if shutil.which(line[0]) is None:
        raise ImageError(f"no {line[0]}: tools/setup installs it (Debian: qemu-system-arm)")
    if not os.path.exists(image):
        raise ImageError(f"no image {image}: cmake --preset {cpu} && cmake --build --preset {cpu}")
    with tempfile.TemporaryDirectory() as folder:
        control = os.path.join(folder, "qmp.sock")
        if cpu == "cortex-r5":
            line += ["-qmp", f"unix:{control},server=on,wait=off"]
        with subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as process:
            connection = None
            try:
                if cpu == "cortex-r5":
                    connection = _start_r5(control, process)
                output, complaints = process.communicate(timeout=timeout_s)
            except subprocess.TimeoutExpired as expired:
                raise ImageError(f"{cpu}: no end within {timeout_s} s") from expired
            finally:
                if process.poll() is None:
                    process.kill()
                if connection is not None:
                    connection.close()
    if process.returncode != 0:
        raise ImageError(f"{cpu}: {os.path.basename(image)} ended with status {process.returncode}:\n{output}{complaints}")
    return output


def numbers(output):
    """The "name number" lines of an image's output."""
    found = {}
    for text in output.splitlines():
        name, _, value = text.rpartition(" ")
        if name and value.lstrip("-").isdigit():
            found[name] = int(value)
    return found
