#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""From a model to a header and to software in the loop, without a compiler: its score at each station.

    training/python/examples/model_to_sil.py build/bin dqn.safetensors -o dqn.hpp
"""

import argparse
import json
import os
import subprocess
import tempfile


def run(bin_directory, program, *arguments):
    """The JSON file that a program of Striker writes."""
    with tempfile.TemporaryDirectory() as directory:
        report = os.path.join(directory, "report.json")
        to = "--report" if program == "striker-export" else "--json"
        subprocess.run([os.path.join(bin_directory, program), *arguments, to, report], check=True,
                       stdout=subprocess.DEVNULL)
        with open(report, encoding="utf-8") as stream:
            return json.load(stream)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="where striker-evaluate, striker-export and striker-sil are")
    parser.add_argument("model", help="safetensors or ONNX")
    parser.add_argument("-o", "--output", required=True, help="the header to write")
    parser.add_argument("--episodes", type=int, default=1000)
    arguments = parser.parse_args()
    which = ["--episodes", str(arguments.episodes), "--seed", "1000"]
    played = run(arguments.bin, "striker-evaluate", "--model", arguments.model, *which)
    print(f"float network     {played['mean_reward']:6.3f} +- {played['reward_ci95']:.3f}")
    exported = run(arguments.bin, "striker-export", arguments.model, "-o", arguments.output)
    print(f"integer network   {exported['reward']['integer_mean']:6.3f} against {exported['reward']['float_mean']:.3f} of the "
          f"float one, on {exported['reward']['episodes']} other episodes; the same action in {exported['agreement']:.2%}")
    for plant in ("servo", "drive"):
        looped = run(arguments.bin, "striker-sil", "kick", "--policy", arguments.output, "--plant", plant, *which)
        print(f"on the bus, {plant} {looped['mean_reward']:6.3f} +- {looped['reward_ci95']:.3f}")


if __name__ == "__main__":
    main()
