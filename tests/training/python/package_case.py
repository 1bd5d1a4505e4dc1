# SPDX-License-Identifier: Apache-2.0
"""What the tests of the Python package share. Each is called with the folder of the programs, and of the package."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy

if "STRIKER_BIN" not in os.environ:  # processes that a test begins find it there
    os.environ["STRIKER_BIN"], os.environ["STRIKER_PACKAGE"] = map(os.path.abspath, (sys.argv.pop(1), sys.argv.pop(1)))
BIN = os.environ["STRIKER_BIN"]
sys.path.insert(0, os.environ["STRIKER_PACKAGE"])


def some_network(inputs=6, hidden=32, actions=3, seed=1):
    """A state dictionary of arrays, whose choices depend on the input."""
    random = numpy.random.default_rng(seed)
    shapes = {"0": (hidden, inputs), "2": (hidden, hidden), "4": (actions, hidden)}
    network = {}
    for name, (rows, columns) in shapes.items():
        network[f"{name}.weight"] = random.normal(0, (2 / columns) ** 0.5, (rows, columns)).astype(numpy.float32)
        network[f"{name}.bias"] = random.normal(0, 0.1, rows).astype(numpy.float32)
    return network


class PackageCase(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = directory.name

    def path(self, name):
        return os.path.join(self.directory, name)

    def run_tool(self, tool, *arguments):
        return subprocess.run([os.path.join(BIN, tool), *map(str, arguments)], capture_output=True, text=True,
                              check=False)

    def must_run(self, tool, *arguments):
        result = self.run_tool(tool, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def read_json(self, name):
        with open(self.path(name), encoding="utf-8") as stream:
            return json.load(stream)
