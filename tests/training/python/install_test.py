#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""pip installs the package, without network, and it plays away from the build. Usage: install_test.py BIN_DIRECTORY
PACKAGE_DIRECTORY"""

import os
import shutil
import subprocess
import sys
import unittest

from package_case import BIN, PackageCase

SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../training/python")


class Install(PackageCase):
    def install(self, build, target):
        shutil.copytree(SOURCES, self.path("python"))  # pip leaves its own files beside the sources
        return subprocess.run([sys.executable, "-m", "pip", "install", self.path("python"), "--no-build-isolation",
                               "--no-index", "--no-deps", "--target", target], capture_output=True, text=True,
                              check=False, env={**os.environ, "STRIKER_BUILD": build})

    def test_a_build_without_the_module_is_told(self):
        installed = self.install("build", self.path("site"))
        self.assertNotEqual(installed.returncode, 0)
        self.assertRegex(installed.stdout + installed.stderr, r"setup.py: no build/python/striker/_native\..*: STRIKER_BUILD is the whole path")

    def test_pip_installs_it(self):
        target = self.path("site")
        installed = self.install(os.path.dirname(BIN), target)
        self.assertEqual(installed.returncode, 0, installed.stdout + installed.stderr)
        said = subprocess.run([sys.executable, "-c", "import striker; env = striker.KickEnv(); env.reset(seed=1);"
                               "print(striker.__file__, env.step(0)[1])"], capture_output=True, text=True, check=False,
                              env={"PYTHONPATH": target}, cwd=self.directory)
        self.assertEqual(said.stdout, f"{target}/striker/__init__.py -0.1\n", said.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
