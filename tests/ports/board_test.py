#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What a board.cmake can say, and what cmake answers to one that is wrong. Usage: board_test.py BOARDS_JSON"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import controller_image_test
import image_test
import processor_fault_test
import qemu_image
import stack_usage
import striker_dbc

BOARDS = sys.argv.pop(1)
POLICY = os.path.join(image_test.ROOT, "firmware", "policy", "exported", "kick.hpp")

CLOCK = 4  # FaultCause::clock of fault_record.hpp
OWN_BOARD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "own-board")

# A board that is complete, with fields that each test changes.
FIELDS = {
    "NAME": "elsewhere", "CPU": "cortex-m4", "FLASH_ORIGIN": "0x08000000", "FLASH": "512K", "RAM_ORIGIN": "0x20000000",
    "RAM": "96K", "CLOCK_HZ": "170000000", "INTERRUPTS": "102", "SOURCES": "cortex_m/startup.cpp",
    "CLOCK": "cortex_m/systick_clock.cpp", "CAN": "own_can.cpp", "WATCHDOG": "none", "DEFINITIONS": "OWN_PORT=0x40006400",
}
OWN_MACHINE = {"system": "qemu-system-arm", "machine": "mps2-an386", "arguments": ["-kernel", "{image}"], "power_on": ""}


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
        shutil.copy(os.path.join(OWN_BOARD, "own_can.cpp"), self.folder)

    def configure(self, *definitions):
        return run("cmake", "-G", "Ninja", "-S", image_test.ROOT, "-B", self.build_dir, "-DCMAKE_BUILD_TYPE=Release",
                   *(f"-D{definition}" for definition in definitions))

    def assert_refused(self, definitions, *told):
        done = self.configure(*definitions)
        self.assertNotEqual(done.returncode, 0, definitions)
        message = re.sub(r"\s+", " ", done.stderr)  # cmake breaks its lines
        for text in told:
            self.assertIn(text, message)

    def test_a_board_outside_the_tree_builds_links_and_runs_its_own_can_driver(self):
        board = os.path.join(os.path.dirname(self.folder), "own-board")
        shutil.copytree(OWN_BOARD, board)
        done = self.configure(f"STRIKER_BOARD_DIR={board}")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("cmake", "--build", self.build_dir, "--target", "striker-controller", "striker-check", "striker-check-bus")
        self.assertEqual(done.returncode, 0, done.stdout)
        image = image_test.image(self.build_dir, "controller")
        self.assertGreater(os.path.getsize(image.replace(".elf", ".bin")), 0)
        symbols = run("arm-none-eabi-nm", "-C", image).stdout
        for symbol in ("own_can::frames_received", "own_letter_received", "striker::bare_metal::try_send_can"):
            self.assertRegex(symbols, symbol)
        self.assertNotRegex(symbols, r"uart::")
        lines = self.lines_of(image, b"t1230\r" * 5, awaited=b"\rown 5 ")
        self.assertRegex(lines[0], rb"^own [0-5] t[0-9A-F]{4}")
        heartbeat = striker_dbc.identifier("Heartbeat")
        self.assertGreaterEqual(sum(line[6:10] == b"t%03X" % heartbeat for line in lines), 20, "2,000 ticks")
        self.assertEqual(lines[-1][:6], b"own 5 ", "its interrupt received five frames")

    def lines_of(self, image, sent, awaited):
        """What the image says to letters that were sent to it, in 2,000 ticks, or more until the answer is there: QEMU hands
        letters over in the host's time, and a busy host's is not the board's."""
        path = os.path.join(os.path.dirname(self.folder), "serial")
        line = qemu_image.machine({"qemu": OWN_MACHINE}, image, icount_shift=4) + ["-serial", f"unix:{path},server=on,wait=on"]
        commanded, received = b"t%03X" % striker_dbc.identifier("WheelCommand"), b""
        with subprocess.Popen(line, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            try:
                with controller_image_test.connect(path) as serial:
                    serial.sendall(sent)
                    while (ticks := received.count(commanded)) < 2000 or (ticks < 200000 and awaited not in received):
                        letters = serial.recv(65536)
                        self.assertTrue(letters, "the image stopped")
                        received += letters
            finally:
                process.kill()
        return received.split(b"\r")[:-1]

    def test_a_build_folder_stays_with_its_processor(self):
        self.write()
        self.assertEqual(self.configure(f"STRIKER_BOARD_DIR={self.folder}").returncode, 0)
        self.assert_refused(["STRIKER_BOARD=microbit"], "build is for one board", self.folder)
        self.assert_refused(["STRIKER_BOARD=microbit", "STRIKER_BOARD_DIR="], "microbit has a cortex-m0plus",
                            "a build folder of its own")

    def test_a_board_is_never_asked_for_in_vain(self):
        toolchain = os.path.join(os.path.dirname(self.folder), "host.cmake")
        with open(toolchain, "w", encoding="utf-8") as text:
            text.write("set(CMAKE_CXX_COMPILER c++)\n")
        self.assert_refused(["STRIKER_BOARD=microbit", f"CMAKE_TOOLCHAIN_FILE={toolchain}"],
                            "compiles for Linux: take a build folder of its own")

    def test_an_unknown_board_is_told_with_those_that_there_are(self):
        self.assert_refused(["STRIKER_BOARD=mps2-an999"], "'mps2-an999' is no board", "microbit", "zcu102-r5", "STRIKER_BOARD_DIR")
        self.assert_refused(["STRIKER_BOARD="], "'' is no board", "microbit")
        self.assert_refused([f"STRIKER_BOARD_DIR={self.folder}"], f"STRIKER_BOARD_DIR: there is no {self.folder}/board.cmake",
                            "firmware/ports/README.md")

    def test_a_board_cmake_that_says_nothing_or_too_much_is_told(self):
        self.write()
        path = os.path.join(self.folder, "board.cmake")
        with open(path, encoding="utf-8") as text:
            complete = text.read()
        for text, told in (("", "it does not call striker_add_board"),
                           (complete + complete, "it calls striker_add_board twice"),
                           (complete.replace(")", ""), "board.cmake")):
            with open(path, "w", encoding="utf-8") as board:
                board.write(text)
            self.assert_refused([f"STRIKER_BOARD_DIR={self.folder}"], path, told)

    def test_a_board_may_say_what_it_is_in_a_file_that_it_includes(self):
        self.write()
        os.makedirs(os.path.join(self.folder, "sub"))
        path = os.path.join(self.folder, "board.cmake")
        os.rename(path, os.path.join(self.folder, "sub", "common.cmake"))
        with open(path, "w", encoding="utf-8") as board:
            board.write("include(${CMAKE_CURRENT_LIST_DIR}/sub/common.cmake)\n")
        done = self.configure(f"STRIKER_BOARD_DIR={self.folder}")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_folder_that_cmake_would_take_for_a_list_is_told(self):
        folder = os.path.join(os.path.dirname(self.folder), "my;board")
        os.makedirs(folder)
        with open(os.path.join(folder, "board.cmake"), "w", encoding="utf-8"):
            pass
        # CMake has made the second part a path by itself before anybody can look.
        self.assert_refused([f"STRIKER_BOARD_DIR={folder}"], f"'{os.path.dirname(folder)}/my;", "has a ';' in it", "a path without one")

    def test_a_wrong_field_is_named_with_its_file(self):
        for changes, told in (
            *(({field: None}, f"{field} is missing") for field in FIELDS if field != "DEFINITIONS"),
            ({"NAME": "other"}, "NAME is 'other', but the folder's name is 'elsewhere'"),
            ({"CPU": "cortex-a9"}, "CPU is 'cortex-a9', but start-up code and kernels are for cortex-m0, "),
            ({"FLASH_ORIGIN": "08000000"}, "FLASH_ORIGIN is '08000000', but has to be an address"),
            ({"FLASH_ORIGIN": "0x20100000"}, "FLASH_ORIGIN is '0x20100000', but a Cortex-M runs its code below 0x20000000"),
            ({"RAM": "96kB"}, "RAM is '96kB', but has to be a size"),
            ({"FLASH": "0"}, "FLASH is '0', but has to be a size"),
            ({"FLASH": "32K"}, "FLASH is 32K, but the controller's image may take 48K: give IMAGE_FLASH"),
            ({"RAM": "2K"}, "RAM is 2K, but the controller's image may take 4K"),
            ({"IMAGE_RAM": "much"}, "IMAGE_RAM is 'much', but has to be a size"),
            ({"RAM_ORIGIN": "0x20000400"}, "RAM_ORIGIN is '0x20000400', but has to be a multiple of 4 KB"),
            ({"RAM_ORIGIN": "0x10000000"}, "RAM_ORIGIN is '0x10000000', but a Cortex-M has its RAM at 0x20000000"),
            ({"CPU": "cortex-r5", "RAM_ORIGIN": "0x08001000"}, "FLASH and RAM share addresses"),
            ({"CLOCK_HZ": "170MHz"}, "CLOCK_HZ is '170MHz'"),
            ({"CLOCK_HZ": "32768"}, "CLOCK_HZ is '32768', but a tick of 1 ms has to be whole counts"),
            ({"QEMU_CLOCK_HZ": "fast"}, "QEMU_CLOCK_HZ is 'fast', but has to be a number of hertz"),
            ({"INTERRUPTS": "many"}, "INTERRUPTS is 'many', but has to be a number of lines"),
            ({"HANDLERS": "20"}, "HANDLERS has '20', but wants line=function"),
            ({"HANDLERS": "102=can"}, "HANDLERS has '102=can', but INTERRUPTS says that there are 102"),
            ({"HANDLERS": "20=one 20=other"}, "HANDLERS has two functions for line 20"),
            ({"CPU": "cortex-r5", "HANDLERS": "20=can"}, "HANDLERS is for a Cortex-M's vector table"),
            ({"WATCHDOG": "own.cpp"}, "WATCHDOG: no own.cpp, neither in the board's folder nor in"),
            ({"CAN": "none.cpp"}, "CAN: no none.cpp, neither in the board's folder nor in"),
            ({"SOURCES": "cortex_m"}, "SOURCES: no cortex_m, neither in the board's folder nor in"),
            ({"CAN": "slcan"}, "UART is missing: CAN slcan speaks over it"),
            ({"UART": "devices/cmsdk_uart.cpp"}, "UART belongs to CAN slcan alone"),
            ({"DEFINITIONS": "OWN_PORT"}, "DEFINITIONS has 'OWN_PORT', but wants NAME=VALUE"),
            ({"QEMU_POWER_ON": "/machine"}, "QEMU_POWER_ON is given, but not QEMU_MACHINE"),
            ({"NAME": "elsewhere colour"}, "'colour' belongs to no field"),
        ):
            with self.subTest(told):
                self.write(**changes)
                self.assert_refused([f"STRIKER_BOARD_DIR={self.folder}"], f"{self.folder}/board.cmake: {told}",
                                    "read_board.cmake says what every field means")

    def test_boards_that_nobody_emulates_build_with_their_interrupts_in_the_vector_table(self):
        with open(BOARDS, encoding="utf-8") as text:
            names = [board["name"] for board in json.load(text) if not board["qemu"]]
        self.assertEqual(names, ["stm32f405", "stm32f446"])
        for name in names:
            build_dir = f"{self.build_dir}-{name}"
            image_test.build({"name": name}, POLICY, build_dir, ("striker-controller",))
            image = image_test.image(build_dir, "controller")
            addresses = stack_usage.symbols(image)
            vectors = os.path.join(build_dir, "vectors")
            run("arm-none-eabi-objcopy", "-O", "binary", "-j", ".vectors", image, vectors)
            with open(vectors, "rb") as table:
                entries = [entry & ~1 for entry in struct.unpack(f"<{os.path.getsize(vectors) // 4}I", table.read())]
            self.assertEqual(entries[0], addresses["stack_top"])
            self.assertEqual([entries[1], entries[15], entries[16 + 20]],
                             [addresses[name] for name in ("reset", "tick_interrupt", "can1_reception")])
            self.assertEqual(set(entries[2:15] + entries[16:36] + entries[37:]), {addresses["exception"]})
            self.assertEqual(len(entries), 16 + {"stm32f405": 82, "stm32f446": 97}[name])

            if name == "stm32f405":
                self.clock_does_not_start(image, addresses["kept_fault"])

    def clock_does_not_start(self, image, kept_fault):
        """QEMU's STM32F405 has no clock control: what waits for a crystal there waits in vain."""
        path = os.path.join(os.path.dirname(self.folder), "control")
        memory = os.path.join(os.path.dirname(self.folder), "kept_fault")
        machine = qemu_image.machine({"qemu": {**OWN_MACHINE, "machine": "netduinoplus2"}}, image, icount_shift=3)
        with subprocess.Popen(machine + ["-serial", "none", "-S", "-qmp", f"unix:{path},server=on,wait=off"],
                              stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            try:
                control = processor_fault_test.Control(path)
                control.ask("cont")
                self.assertEqual(control.count("RESET", processor_fault_test.MOST_RESETS, quiet_s=2),
                                 processor_fault_test.MOST_RESETS, "it tries again, and then stops")
                control.ask("pmemsave", val=kept_fault, size=32, filename=memory)
            finally:
                process.kill()
        with open(memory, "rb") as record:
            magic, cause, *_ = struct.unpack("<8I", record.read())
        self.assertEqual((magic, cause), (processor_fault_test.MAGIC, CLOCK), "the record tells why")

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
