# SPDX-License-Identifier: Apache-2.0
"""A test case with a folder of its own for the files that programs read and write."""

import os
import tempfile
import unittest

ROBOTS = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "firmware", "robots")


class FilesCase(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)

    def file(self, name, text=None):
        """The path of a file in the folder; written, if a text is given."""
        path = os.path.join(self.directory.name, name)
        if text is not None:
            with open(path, "w", encoding="utf-8") as stream:
                stream.write(text)
        return path
