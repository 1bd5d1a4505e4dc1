#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tools/demo and tools/test, copied to where setting up and building are stand-ins: what they refuse, say and keep.
tools/setup: what it takes. STRIKER_POLICY, STRIKER_ROBOT and STRIKER_TESTS: what the real build takes.
Usage: demo_test.py ROOT"""

import os
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "programs"))

import files_case  # noqa: E402

ROOT = sys.argv.pop()


class Tools(files_case.FilesCase):
    def setUp(self):
        super().setUp()
        for folder in ("tools", "path", "build/bin", "out/demo", "firmware/policy/exported", "firmware/robots"):
            os.makedirs(self.file(folder))
        for name in ("demo", "test"):
            shutil.copy(os.path.join(ROOT, "tools", name), self.file(f"tools/{name}"))
        self.script("tools/setup", f'echo "setup $*" >>"{self.file("told")}"')
        self.script("path/cmake", f'echo "cmake $*" >>"{self.file("told")}"')
        self.script("path/ctest", "")
        self.script("build/bin/striker-sil", 'echo "played $*"; : >out/demo/kick.json')
        self.file("out/demo/kick.json", "the last results")
        self.configure()

    def script(self, name, text):
        os.chmod(self.file(name, f"#!/bin/sh\n{text}\n"), 0o755)

    def configure(self, **changes):
        configured = {"STRIKER_POLICY": self.file("firmware/policy/exported/kick.hpp"),
                      "STRIKER_ROBOT": self.file("firmware/robots/forward.toml"), **changes}
        self.file("build/CMakeCache.txt", "".join(f"{name}:FILEPATH={file}\n" for name, file in configured.items()))

    def tool(self, name, *arguments):
        environment = {**os.environ, "PATH": self.file("path") + ":" + os.environ["PATH"]}
        return subprocess.run([self.file(f"tools/{name}"), *arguments], capture_output=True, text=True, check=False, timeout=60,
                              env=environment)

    def test_the_demo_refuses_a_wrong_option_before_it_touches_anything(self):
        for option, value in (("--plant", "foo"), ("--plant", ""), ("--bus", "can"), ("--episodes", "0"), ("--episodes", "-1"),
                              ("--episodes", "900001"), ("--episodes", "x"), ("--seed", "-1"), ("--seed", "1.5"),
                              ("--sed", "1")):
            result = self.tool("demo", option, value)
            self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
            self.assertTrue(result.stderr.startswith("demo: "), result.stderr)
            self.assertIn(option, result.stderr)
            self.assertIn("tools/demo --help", result.stderr)
            self.assertFalse(os.path.exists(self.file("told")), "nothing was set up or built")
            with open(self.file("out/demo/kick.json"), encoding="utf-8") as stream:
                self.assertEqual(stream.read(), "the last results")

    def test_the_demo_sets_up_its_own_part_alone(self):
        result = self.tool("demo", "--bus", "inproc", "--plant", "servo", "--seed", "3")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("played kick --bus inproc --episodes 20 --seed 3 --plant servo", result.stdout)
        with open(self.file("told"), encoding="utf-8") as stream:
            self.assertEqual(stream.readline(), "setup demo\n")

    def test_the_demo_says_loudly_that_it_plays_another_policy_or_robot(self):
        for what in ("POLICY", "ROBOT"):
            self.configure(**{f"STRIKER_{what}": "/home/somebody/mine"})
            result = self.tool("demo", "--bus", "inproc")
            self.assertEqual(result.returncode, 0)
            for word in (f"NOT THE COMMITTED {what}", "/home/somebody/mine", f"cmake -B build -U STRIKER_{what}"):
                self.assertIn(word, result.stderr)

    def test_the_tests_are_not_run_with_another_policy_or_robot(self):
        for what in ("POLICY", "ROBOT"):
            self.configure(**{f"STRIKER_{what}": "/home/somebody/mine"})
            result = self.tool("test")
            self.assertEqual(result.returncode, 2)
            for word in ("/home/somebody/mine", f"-U STRIKER_{what}", "--build-dir"):
                self.assertIn(word, result.stderr)
        with open(self.file("told"), encoding="utf-8") as stream:
            self.assertNotIn("--build ", stream.read())

    def test_the_tests_are_run_with_the_committed_policy_even_where_the_demo_left_them_out(self):
        self.tool("test", "-R", "Nothing")
        with open(self.file("told"), encoding="utf-8") as stream:
            self.assertIn("-DSTRIKER_TESTS=ON", stream.read())

    def test_set_up_knows_its_parts(self):
        for arguments in (("none",), ("",), ("demo", "all")):
            result = subprocess.run([os.path.join(ROOT, "tools/setup"), *arguments], capture_output=True, text=True, check=False)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn("tools/setup --help", result.stderr)


class Configuration(files_case.FilesCase):
    def configure(self, *arguments):
        return subprocess.run(["cmake", "-S", ROOT, "-B", self.file("build"), "-G", "Ninja", *arguments], capture_output=True,
                              text=True, check=False, timeout=300)

    def assert_refused(self, name, *cases):
        for value, word in cases:
            result = self.configure(f"-D{name}={value}")
            self.assertNotEqual(result.returncode, 0, value)
            told = " ".join(result.stderr.split())
            self.assertIn(name, told)
            self.assertIn(word, told)

    def test_a_policy_that_is_none_is_refused_in_words(self):
        self.assert_refused("STRIKER_POLICY", ("", "is empty"), (os.path.join(ROOT, "firmware"), "is a folder"),
                            ("/none/x.hpp", "no such header"), (os.path.join(ROOT, "README.md"), "no policy is in"))

    def test_a_robot_that_is_none_is_refused_in_words(self):
        self.assert_refused("STRIKER_ROBOT", ("", "is empty"), (os.path.join(ROOT, "firmware"), "no such file"),
                            ("/none/x.toml", "no such file"), (os.path.join(ROOT, "README.md"), "is no key with a whole number"))

    def test_without_tests_no_googletest_is_needed(self):
        missing = "-DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON"
        result = self.configure("-DSTRIKER_TESTS=OFF", missing)
        self.assertEqual(result.returncode, 0, result.stderr)
        result = self.configure("-DSTRIKER_TESTS=ON", missing)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("-DSTRIKER_TESTS=OFF", " ".join(result.stderr.split()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
