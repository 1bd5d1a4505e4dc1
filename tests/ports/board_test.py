#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What a board.cmake can say, and what cmake answers to one that is wrong. Usage: board_test.py BOARDS_JSON"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import image_test

BOARDS = sys.argv.pop(1)
TOOLCHAIN = f"-DCMAKE_TOOLCHAIN_FILE={image_test.ROOT}/firmware/ports/arm-none-eabi.cmake"

# A second board with a Cortex-M4, outside the tree, with a CAN controller of its own.
FIELDS = {
    "NAME": "elsewhere", "CPU": "cortex-m4", "FLASH_ORIGIN": "0x08000000", "FLASH": "512K", "RAM_ORIGIN": "0x20000000",
    "RAM": "96K", "CLOCK_HZ": "170000000", "INTERRUPTS": "102", "SOURCES": "cortex_m/startup.cpp",
    "CLOCK": "cortex_m/systick_clock.cpp", "CAN": "own_can.cpp", "WATCHDOG": "none", "DEFINITIONS": "OWN_CAN=0x40006400",
}
OWN_CAN = """
#include "firmware/ports/bare_metal/can_bus.hpp"
static_assert(OWN_CAN == 0x40006400 && STRIKER_CLOCK_HZ == 170'000'000);
namespace striker::bare_metal {
void start_can() {}
bool receive_can(can::Frame&) { return false; }
bool try_send_can(const can::Frame&) { return false; }
can::BusHealth can_health() { return can::BusHealth::bus_off; }
}  // namespace striker::bare_metal
"""


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Board(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.build_dir = os.path.join(directory.name, "build")
        self.folder = os.path.join(directory.name, "elsewhere")

    def write(self, **changes):
        os.makedirs(self.folder, exist_ok=True)
        fields = {name: text for name, text in {**FIELDS, **changes}.items() if text is not None}
        with open(os.path.join(self.folder, "board.cmake"), "w", encoding="utf-8") as board:
            board.write("striker_add_board(" + " ".join(f"{name} {text}" for name, text in fields.items()) + ")\n")
        with open(os.path.join(self.folder, "own_can.cpp"), "w", encoding="utf-8") as source:
            source.write(OWN_CAN)

    def configure(self, board):
        return run("cmake", "-G", "Ninja", "-S", image_test.ROOT, "-B", self.build_dir, TOOLCHAIN,
                   "-DCMAKE_BUILD_TYPE=Release", f"-DSTRIKER_BOARD={board}")

    def assert_refused(self, board, *told):
        done = self.configure(board)
        self.assertNotEqual(done.returncode, 0, board)
        message = re.sub(r"\s+", " ", done.stderr)  # cmake breaks its lines
        for text in told:
            self.assertIn(text, message)

    def test_a_board_outside_the_tree_with_a_can_controller_of_its_own(self):
        self.write()
        done = self.configure(self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("cmake", "--build", self.build_dir, "--target", "striker-controller")
        self.assertEqual(done.returncode, 0, done.stdout)
        image = image_test.image(self.build_dir, "controller")
        self.assertGreater(os.path.getsize(image.replace(".elf", ".bin")), 0)
        symbols = run("arm-none-eabi-nm", "-C", image).stdout
        self.assertRegex(symbols, r"(?m)^0800[0-9a-f]{4} . reset$")
        self.assertRegex(symbols, r"striker::bare_metal::try_send_can")
        self.assertNotRegex(symbols, r"uart::|Slcan")
        for changes, told in (({"RAM_ORIGIN": "0x20000400"}, "RAM_ORIGIN has to be a multiple of 4 KB"),
                              ({"RAM_ORIGIN": "0x10000000"}, "has its RAM above")):
            self.write(**changes)
            done = run("cmake", "--build", self.build_dir, "--target", "striker-controller")
            self.assertNotEqual(done.returncode, 0, changes)
            self.assertIn(told, done.stdout)

    def test_a_build_folder_stays_with_its_processor(self):
        self.write()
        self.assertEqual(self.configure(self.folder).returncode, 0)
        self.assert_refused("microbit", "microbit has a cortex-m0plus", "a build folder of its own")

    def test_an_unknown_board_is_told_with_those_that_there_are(self):
        self.assert_refused("mps2-an999", "'mps2-an999' is no board", "microbit", "zcu102-r5")
        self.assert_refused("", "'' is no board", "microbit")
        self.assert_refused(self.folder, f"there is no {self.folder}/board.cmake")

    def test_a_wrong_field_is_named_with_its_file(self):
        for changes, told in (
            *(({field: None}, f"{field} is missing") for field in FIELDS if field != "DEFINITIONS"),
            ({"NAME": "other"}, "NAME is 'other', but the folder's name is 'elsewhere'"),
            ({"FLASH_ORIGIN": "08000000"}, "FLASH_ORIGIN is '08000000', but has to be an address"),
            ({"RAM": "96kB"}, "RAM is '96kB', but has to be a size"),
            ({"CLOCK_HZ": "170MHz"}, "CLOCK_HZ is '170MHz'"),
            ({"QEMU_CLOCK_HZ": "fast"}, "QEMU_CLOCK_HZ is 'fast', but has to be a number of hertz"),
            ({"INTERRUPTS": "many"}, "INTERRUPTS is 'many', but has to be a number of lines"),
            ({"WATCHDOG": "own.cpp"}, "WATCHDOG: no own.cpp, neither in the board's folder nor in"),
            ({"CAN": "none.cpp"}, "CAN: no none.cpp, neither in the board's folder nor in"),
            ({"CAN": "slcan"}, "UART is missing: CAN slcan speaks over it"),
            ({"UART": "devices/cmsdk_uart.cpp"}, "UART belongs to CAN slcan alone"),
            ({"NAME": "elsewhere colour"}, "'colour' belongs to no field"),
        ):
            with self.subTest(told):
                self.write(**changes)
                self.assert_refused(self.folder, f"{self.folder}/board.cmake: {told}")

    def test_every_board_has_a_preset_of_its_name(self):
        with open(BOARDS, encoding="utf-8") as text:
            boards = sorted(board["name"] for board in json.load(text))
        with open(os.path.join(image_test.ROOT, "CMakePresets.json"), encoding="utf-8") as text:
            presets = json.load(text)
        configured = sorted(preset["name"] for preset in presets["configurePresets"] if preset.get("inherits") == "board")
        built = {preset["name"] for preset in presets["buildPresets"]}
        self.assertEqual(configured, boards)
        self.assertEqual(set(boards) - built, set())


if __name__ == "__main__":
    unittest.main()
