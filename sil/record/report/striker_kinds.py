# SPDX-License-Identifier: Apache-2.0
"""The kinds of runs that a report is made of, told by what their directories hold."""

import os

import striker_runs
import striker_trainings
from striker_logs import LogError

# A directory's kind is told by the first of these files that it has.
KNOWN = {"match.json": striker_runs.match, "pil.json": striker_runs.pil, "kick.json": striker_runs.kicks,
         "league.json": striker_runs.league, "runs.jsonl": striker_runs.campaign, "faults.json": striker_runs.faults,
         "experiment.json": striker_trainings.experiment, "learning_curve.csv": striker_trainings.training}


def read_run(directory):
    """What a report shows of it, as striker_runs.py says; LogError if it cannot be read."""
    for name, read in KNOWN.items():
        if os.path.exists(os.path.join(directory, name)):
            return read(directory)
    raise LogError(f"{directory}: is no run; give a directory with one of {', '.join(KNOWN)}")
