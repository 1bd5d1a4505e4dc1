# SPDX-License-Identifier: Apache-2.0
"""What all of Striker's plotters share: one look, pictures that are written whole, and errors in one line.

The same data give the same bytes: no date, no random identifiers, and in each file's metadata the command without the
folder that it wrote to. Colours are those of Okabe and Ito, which colour-blind people tell apart; the background is
white, so that a picture reads the same on a dark page.
"""

import argparse
import io
import os
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from striker_files import write_whole  # noqa: E402
from striker_records import LogError  # noqa: E402

HERE = os.path.dirname(os.path.realpath(__file__))

BLUE, ORANGE, GREEN, VERMILION, PURPLE, GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "0.45"
TEAMS = {"red": VERMILION, "blue": BLUE}

matplotlib.rcParams.update({
    "svg.hashsalt": "striker",
    "svg.fonttype": "none",
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "axes.grid": True,
    "grid.alpha": 0.3,
    "grid.linewidth": 0.5,
    "axes.prop_cycle": matplotlib.cycler(color=[BLUE, ORANGE, GREEN, VERMILION, PURPLE, "#56B4E9", "0.2", "#F0E442"]),
    "axes.titlesize": 10,
    "legend.fontsize": 8,
})


class PlotError(Exception):
    """What cannot be drawn, in one line."""


def save(figure, directory, name, command):
    """Writes NAME.svg and NAME.png, each whole or not at all, and says so. The folder is made if there is none."""
    os.makedirs(directory, exist_ok=True)
    kinds = {"svg": ({"Date": None, "Description": command}, b"<svg"), "png": ({"Software": None, "Description": command}, b"PNG")}
    for kind, (metadata, mark) in kinds.items():
        target = os.path.join(directory, f"{name}.{kind}")
        picture = io.BytesIO()
        figure.savefig(picture, format=kind, metadata=metadata, dpi=100)
        write_whole(target, picture.getvalue(), mark)
        print(target)
    plt.close(figure)


def parser_of(program, documentation, built_with="striker-sil"):
    """With --out and --version; BUILT_WITH is a program beside this one that knows the build's."""

    class ShowVersion(argparse.Action):
        def __call__(self, parser, *_):
            told = subprocess.run([os.path.join(HERE, built_with), "--version"], capture_output=True, text=True,
                                  check=False)
            print(told.stdout.strip().replace(built_with, program))
            parser.exit(0 if told.returncode == 0 else 2)

    parser = argparse.ArgumentParser(prog=program, description=documentation,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", required=True, metavar="DIR", help="is made if there is none")
    parser.add_argument("--version", action=ShowVersion, nargs=0, help="show the build's version and exit")
    return parser


def run(program, draw, options):
    """Calls draw(options, folder, command); what cannot be drawn or written ends the program with one line."""
    words = [os.path.basename(str(word)) for word in sys.argv[1:]]
    kept = [word for place, word in enumerate(words)
            if word not in ("-o", "--out") and (place == 0 or words[place - 1] not in ("-o", "--out"))]
    sys.stdout.reconfigure(errors="backslashreplace")
    try:
        draw(options, options.out, " ".join([program, *kept]))
    except (PlotError, LogError) as error:
        refuse(program, error)
    except OSError as error:
        refuse(program, f"{error.filename or options.out}: {error.strerror}; give a folder that can be written with -o")


def refuse(program, text):
    print(f"{program}: {text}", file=sys.stderr)
    sys.exit(2)
