#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Networks of other shapes, from the trainer by way of their exported headers into images: the same answers as the
exporter's, and instructions in proportion to the paper's network."""

import argparse
import os
import subprocess
import sys

import image_test
import qemu_image

# The ball and the robot now and a decision ago; two of the five actions turn.
TWELVE = [name + ago for ago in ("", "@1") for name in ("ball_x", "ball_y", "robot_speed", "ball_vx", "ball_vy", "ball_angle")]
FIVE = [[2.55, 2.55], [0.0, 0.0], [-2.55, -2.55], [2.0, 1.0], [1.0, 2.0]]
SHAPES = {"6-64-3": ["network.hidden=[64]"],
          "6-32-32-3": ["network.hidden=[32, 32]"],
          "6-64-64-64-3": ["network.hidden=[64, 64, 64]"],
          "12-128-128-5": ["network.hidden=[128, 128]", f"task.inputs={TWELVE}", f"task.actions={FIVE}"]}


def export(tools, shape, directory):
    """The header of a network that has hardly learned: its shape is what matters here."""
    settings = ["run.episodes=60", "run.validation_episodes=0", "learner.warm_up=500", *SHAPES[shape]]
    header = os.path.join(directory, shape + ".hpp")
    os.makedirs(directory, exist_ok=True)
    for command in (
        [os.path.join(tools, "striker-train"), "--config", os.path.join(image_test.ROOT, "training/configs/paper.toml"),
         "--seed", "1", "--out", os.path.join(directory, shape), "--force",
         *[word for one in settings for word in ("--set", one)]],
        [os.path.join(tools, "striker-export"), os.path.join(directory, shape, "model.safetensors"), "-o", header,
         "--name", "shape_" + shape.replace("-", "_")],
    ):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
    return header


def measure(board, header, build_dir, inputs):
    image_test.build(board, header, build_dir, ("striker-check", "striker-bench"))
    # Exit status 0 means that all golden vectors passed.
    qemu_image.run(board, image_test.image(build_dir, "check"))
    return qemu_image.numbers(qemu_image.run(board, image_test.image(build_dir, "bench"), ["inputs", inputs]))


def holds(board, shape, header, build_dir):
    print(f"{board['name']}, {shape}")
    measured = measure(board, header, build_dir, 200)
    least, greatest = measured["inference min"], measured["inference max"]
    limit = image_test.inference_limit(board, measured["multiply-accumulates"], header)[0]
    good = image_test.expect(least == greatest, f"{least} to {greatest} instructions, whatever the input")
    return image_test.expect(greatest <= limit, f"{greatest} instructions, of {limit}") and good


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--board", action="append", required=True, help="may be repeated")
    parser.add_argument("--boards", required=True, help="boards.json, of the host's build folder")
    parser.add_argument("--shape", action="append", choices=SHAPES, help="only this one; may be repeated")
    parser.add_argument("--tools", required=True, help="where striker-train and striker-export are")
    parser.add_argument("--build-dir", required=True)
    arguments = parser.parse_args()
    good = True
    try:
        boards = [qemu_image.read_board(arguments.boards, name) for name in arguments.board]
        for shape in arguments.shape or SHAPES:
            header = export(arguments.tools, shape, os.path.join(arguments.build_dir, "exported"))
            for board in boards:
                good &= holds(board, shape, header, os.path.join(arguments.build_dir, shape, board["name"]))
    except qemu_image.ImageError as error:
        sys.exit(f"exported_shapes_test: {error}")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
