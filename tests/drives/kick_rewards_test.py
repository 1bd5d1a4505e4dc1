#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The same kicks with Striker's own drives, with ODrives, and with drives of CiA 402: the mean reward is within 0.3.
Usage: kick_rewards_test.py DRIVE_KICKS [EPISODES]; 500 for the figures of firmware/can/README.md"""

import statistics
import subprocess
import sys
import unittest

KICKS = sys.argv[1]
EPISODES = sys.argv[2] if len(sys.argv) > 2 else "120"
del sys.argv[1:]


def rewards(kind):
    done = subprocess.run([KICKS, kind, EPISODES], check=True, capture_output=True, text=True)
    return [float(line) for line in done.stdout.split()]


class Rewards(unittest.TestCase):
    def test_within_three_tenths_of_strikers_own(self):
        own = rewards("striker")
        self.assertEqual(len(own), int(EPISODES))
        self.assertGreater(statistics.mean(own), 6.0, "it kicks at all")
        for kind in ("odrive", "cia402"):
            with self.subTest(kind):
                pairs = [other - mine for other, mine in zip(rewards(kind), own, strict=True)]
                print(f"{kind}: {statistics.mean(pairs):+.4f} on {EPISODES} episodes, own {statistics.mean(own):.4f}")
                self.assertLess(abs(statistics.mean(pairs)), 0.3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
