#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tools/cluster: what the Slurm script starts, with a program in striker-experiment's place, and that the container's build
names targets and packages that there are. Usage: cluster_test.py SOURCES BUILD"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

SOURCES, BUILD = (os.path.abspath(sys.argv.pop(1)) for _ in range(2))
CLUSTER = os.path.join(SOURCES, "tools", "cluster")


class Cluster(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = directory.name

    def submit(self, **environment):
        keep = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                "OMPI_MCA_rmaps_base_oversubscribe": "1", "SLURM_SUBMIT_DIR": self.directory, **environment}
        return subprocess.run(["bash", os.path.join(CLUSTER, "experiment.slurm")], capture_output=True, text=True, check=False,
                              env={name: value for name, value in keep.items() if not name.startswith("SLURM_JOB")})

    def test_a_process_a_task(self):
        program = os.path.join(self.directory, "striker-experiment")
        with open(program, "w", encoding="utf-8") as stream:
            stream.write('#!/bin/sh\necho "$OMPI_COMM_WORLD_RANK of $OMPI_COMM_WORLD_SIZE: $*"\n')
        os.chmod(program, 0o755)
        result = self.submit(SLURM_NTASKS="3", STRIKER_BIN=self.directory, EXPERIMENT="readings", SEEDS="4")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(result.stdout.splitlines()),
                         [f"{rank} of 3: readings --seeds 4 -o out/readings" for rank in range(3)])

    def test_without_the_program_it_says_so(self):
        result = self.submit()
        self.assertEqual(result.returncode, 2)
        self.assertIn("STRIKER_BIN", result.stderr)

    def test_the_container_builds_what_there_is(self):
        with open(os.path.join(CLUSTER, "Containerfile"), encoding="utf-8") as stream:
            text = stream.read().replace("\\\n", " ")
        targets = re.search(r"--target ([^\n]*)", text)[1].split()
        known = subprocess.run(["cmake", "--build", BUILD, "--target", "help"], capture_output=True, text=True, check=True).stdout
        for target in targets:
            self.assertRegex(known, rf"(?m)^{target}: phony")
        part = re.search(r"tools/setup (\w+)", text)[1]
        there = subprocess.run([os.path.join(SOURCES, "tools/setup"), part], capture_output=True, text=True, check=False)
        self.assertEqual((there.returncode, there.stdout), (0, ""), there.stderr)  # all of that part's are here


if __name__ == "__main__":
    unittest.main(verbosity=2)
