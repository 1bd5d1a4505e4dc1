#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Gymnasium's own checker, where it is installed. Usage: gymnasium_checker_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import unittest

from package_case import PackageCase

import gymnasium
import numpy
import striker  # registers the environments
from gymnasium.utils.env_checker import check_env


class Checker(PackageCase):
    def test_one_world(self):
        for options in ({}, {"world": "full", "pose": "anywhere"}, {"inputs": "acs", "dummies": 1}):
            check_env(gymnasium.make("Striker/Kick-v0", **options).unwrapped, skip_render_check=True)
        check_env(striker.KickEnv(render_mode="rgb_array"))

    def test_a_match(self):
        check_env(gymnasium.make("Striker/Match-v0", max_s=2.0).unwrapped)

    def test_many_worlds(self):
        env = gymnasium.make_vec("Striker/Kick-v0", num_envs=4, vectorization_mode="vector_entry_point")
        self.assertIsInstance(env.unwrapped, striker.VectorKickEnv)
        env = gymnasium.wrappers.vector.RecordEpisodeStatistics(env)
        env.reset(seed=1)
        infos = {}
        while "episode" not in infos:
            *_, infos = env.step(numpy.ones(4, int))


if __name__ == "__main__":
    unittest.main(verbosity=2)
