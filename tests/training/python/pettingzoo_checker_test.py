#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""PettingZoo's own checker, where it is installed. Usage: pettingzoo_checker_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import unittest

from package_case import PackageCase

import striker
from pettingzoo.test import parallel_api_test, parallel_seed_test


class Checker(PackageCase):
    def test_a_match(self):
        parallel_api_test(striker.MatchEnv(max_s=2.0), num_cycles=200)
        parallel_seed_test(lambda: striker.MatchEnv(max_s=2.0), num_cycles=200)


if __name__ == "__main__":
    unittest.main(verbosity=2)
