#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Makes one self-contained page of runs, which opens without a network.

Usage: striker-report RUN... -o report.html

Each RUN is a directory that a program of Striker wrote:
  of kicks      kick.json and bus.log, as tools/demo leaves them in out/demo: the field with a time slider, Q values, the
                line of the log at each moment, and all episodes, worst first
  of a match    match.json, events.jsonl and bus/: the field with ten robots, events to jump to, and what they did
  of a league   league.json: table and pairings with their intervals
  of a campaign runs.jsonl of 'striker-sil campaign': outcomes by fault, and every violated invariant
  of faults     faults.json of 'striker-sil faults --json': the table, every violation, and runs that crashed
  of tools/pil  out/pil/BOARD: the board's kicks as kicks, beside those in one process
  of a training learning_curve.csv and evaluations.csv of striker-train
  of an experiment  experiment.json and tables of striker-experiment

What is no whole result (not driven all along, interrupted, cut) is said above the run. The same runs give the same bytes.
REPORT.html may be there if it is an earlier report.
"""

import argparse
import json
import os
import subprocess
import sys

from striker_files import write_whole
from striker_kinds import read_run
from striker_logs import LogError

HERE = os.path.dirname(os.path.realpath(__file__))
MARK = b"<title>Striker report</title>"  # of every page, so that -o replaces nothing else


def text_of(name):
    with open(os.path.join(HERE, name), encoding="utf-8") as file:
        return file.read()


def page_of(runs):
    page, *scripts = map(text_of, ("striker_report.html", "striker_field.js", "striker_charts.js", "striker_report.js"))
    # HTML must find nothing in it: "</script" would end the script's element, and "<!--<script" hide its end.
    data = json.dumps(runs, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    return page.replace("/*SCRIPT*/", "\n".join(scripts)).replace("/*DATA*/", data)


class ShowVersion(argparse.Action):
    """The build's, which striker-sil knows."""

    def __call__(self, parser, *_):
        told = subprocess.run([os.path.join(HERE, "striker-sil"), "--version"], capture_output=True, text=True, check=False)
        print(told.stdout.strip().replace("striker-sil", "striker-report"))
        parser.exit(0 if told.returncode == 0 else 2)


def main():
    parser = argparse.ArgumentParser(prog="striker-report", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", nargs="+", metavar="RUN", help="a directory of a run")
    parser.add_argument("-o", "--out", required=True, metavar="REPORT.html")
    parser.add_argument("--version", action=ShowVersion, nargs=0, help="show the build's version and exit")
    options = parser.parse_args()
    sys.stdout.reconfigure(errors="backslashreplace")
    try:
        text = page_of([read_run(run) for run in options.run])
    except LogError as error:
        refuse(error)
    try:
        write_whole(options.out, text.encode(), MARK)
    except OSError as error:
        refuse(f"{options.out}: {error.strerror}; give a file that can be written with -o")
    print(f"{options.out}: {len(options.run)} runs, {len(text.encode()) / 1e6:.2f} MB")


def refuse(text):
    print(f"striker-report: {text}", file=sys.stderr)
    sys.exit(2)


if __name__ == "__main__":
    main()
