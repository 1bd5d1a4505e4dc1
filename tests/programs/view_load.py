#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the live view costs the loop: the processor time of striker-sil's first thread, which is the loop, with ten viewers of
whom five never read, against the same run without a view; as fast as it goes, in pairs. Prints the ratios. Fails where the
log's bytes differ or a viewer who reads was shown nothing; never by time.

Usage: view_load.py BIN [--pairs N] [--episodes N] [--match]
"""

import argparse
import filecmp
import glob
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time

from view_client import Run, Viewer


def loop_time_ns(process):
    """What its first thread had, up to 2 ms before its end."""
    ran = 0
    while process.poll() is None:
        try:
            with open(f"/proc/{process.pid}/task/{process.pid}/schedstat", encoding="ascii") as file:
                ran = max(ran, int(file.read().split()[0]))
        except OSError:
            break
        time.sleep(0.002)
    process.wait()
    return ran


def alone(program, folder, words):
    with subprocess.Popen([program, *words], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        return loop_time_ns(process)


def viewed(program, folder, words):
    """Paused until all ten are there."""
    run = Run(program, folder, *words, "--view", "--view-speed", "0.1")
    readers = [Viewer(run) for _ in range(5)]
    never = [Viewer(run) for _ in range(5)]
    seen = [0] * len(readers)

    def read(number):
        for _ in readers[number].states():
            seen[number] += 1

    threads = [threading.Thread(target=read, args=(number,)) for number in range(len(readers))]
    for thread in threads:
        thread.start()
    readers[0].send(do="speed", x="max")
    ran = loop_time_ns(run.process)
    for thread in threads:
        thread.join()
    for one in readers + never:
        one.close()
    if run.process.returncode != 0 or min(seen) < 3:
        sys.exit(f"view_load: exit status {run.process.returncode}, states shown {seen}: {run.text()}")
    return ran, seen


def differing(one, other):
    names = [os.path.relpath(file, one) for file in glob.glob(f"{one}/**/*", recursive=True)
             if os.path.isfile(file) and os.path.basename(file) not in ("stdout", "stderr", "timing.json", "kick.json")]
    return [name for name in names if not filecmp.cmp(os.path.join(one, name), os.path.join(other, name), shallow=False)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="the folder of the programs")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--episodes", type=int, default=2000)
    parser.add_argument("--match", action="store_true", help="a match with halves of --episodes / 20 s instead of kicks")
    options = parser.parse_args()
    program = os.path.join(os.path.abspath(options.bin), "striker-sil")
    words = (["match", "--half-s", str(max(options.episodes // 20, 5)), "-o", "out"] if options.match else
             ["kick", "--episodes", str(options.episodes), "--log", "bus.log"])
    ratios = []
    for pair in range(options.pairs):
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
            without_ns = alone(program, one, words)
            with_ns, seen = viewed(program, other, words)
            if wrong := differing(one, other):
                sys.exit(f"view_load: other bytes with viewers: {', '.join(wrong)}")
        ratios.append(with_ns / without_ns)
        print(f"pair {pair + 1}: the loop ran {without_ns / 1e9:.2f} s alone, {with_ns / 1e9:.2f} s with ten viewers "
              f"({min(seen)} to {max(seen)} states read): {ratios[-1]:.3f}", flush=True)
    print(f"processor time of the loop with viewers: {statistics.median(ratios):.3f} times that without (median of "
          f"{len(ratios)}, {min(ratios):.3f} to {max(ratios):.3f}); the same bytes")


if __name__ == "__main__":
    main()
