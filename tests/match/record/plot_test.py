#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What striker-plot-match and striker-plot-league make of records: the pictures that they promise, the same bytes again,
and one line about what they cannot draw.

Usage: plot_test.py PLOTTER WRITER FILE NAME...

WRITER DIR writes the records, of which FILE is one; NAMEs are the pictures'.
"""

import os
import subprocess
import sys
import tempfile


def plot(plotter, records, pictures, status=0):
    done = subprocess.run([plotter, records, "-o", pictures], capture_output=True, text=True, check=False)
    if done.returncode != status:
        sys.exit(f"{plotter} {records}: status {done.returncode}, not {status}: {done.stdout}{done.stderr}")
    return done.stderr


def contents(folder):
    files = {}
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), "rb") as file:
            files[name] = file.read()
    return files


def expect_refusal(said, plotter, words):
    if said.count("\n") != 1 or not said.startswith(f"{os.path.basename(plotter)}: ") or words not in said:
        sys.exit(f"not a line with {words!r}: {said!r}")


def main():
    plotter, writer, file, *names = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        records, once, again = (os.path.join(folder, name) for name in ("records", "once", "again"))
        subprocess.run([writer, records], check=True)
        plot(plotter, records, once)
        plot(plotter, records, again)
        pictures = contents(once)
        if sorted(pictures) != sorted(f"{name}.{kind}" for name in names for kind in ("svg", "png")):
            sys.exit(f"other pictures: {sorted(pictures)}")
        if pictures != contents(again):
            sys.exit("the same records gave other bytes")
        for name, picture in pictures.items():
            if len(picture) < 5_000 or b"<dc:date>" in picture:
                sys.exit(f"{name}: {len(picture)} bytes, or dated")
        expect_refusal(plot(plotter, os.path.join(folder, "nowhere"), once, 2), plotter, "nowhere")
        with open(os.path.join(records, file), "w", encoding="utf-8") as broken:
            broken.write('{"teams": ')
        expect_refusal(plot(plotter, records, once, 2), plotter, file)
        subprocess.run([writer, records], check=True)
        expect_refusal(plot(plotter, records, os.path.join(records, file), 2), plotter, "-o")
    print(f"{len(names)} pictures")


if __name__ == "__main__":
    main()
