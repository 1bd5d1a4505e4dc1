#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Three roles and two policies in one image: the same answers as the host's program, to the letter."""

import subprocess
import sys

import image_test
import qemu_image


def main():
    parser = qemu_image.board_parser(__doc__)
    parser.add_argument("--host", required=True, help="the program, built for the host")
    parser.add_argument("--build-dir", required=True, help="the board's, built")
    arguments = parser.parse_args()
    board = qemu_image.read_board(arguments.boards, arguments.board)
    host = subprocess.run([arguments.host], capture_output=True, text=True, check=True).stdout
    try:
        target = qemu_image.run(board, image_test.image(arguments.build_dir, "roles"))
    except qemu_image.ImageError as error:
        sys.exit(f"roles_test: {error}")
    print(target, end="")
    sys.exit(0 if image_test.expect(target == host, "the same answers as on the host, to the letter") else 1)


if __name__ == "__main__":
    main()
