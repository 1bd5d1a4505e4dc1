#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The same seeds are the same episodes in Python as in striker-evaluate and striker-train, rewards to the last digit.
Usage: same_episodes_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import csv
import os
import unittest

from package_case import PackageCase, some_network

import numpy
import striker

PAPER = os.path.join(os.path.dirname(__file__), "../../../training/configs/paper.toml")
MIRRORED = """[task]
mirrored = true
velocities = "estimated"
inputs = ["ball_x", "ball_y", "robot_speed", "ball_vx", "ball_vy", "ball_angle", "decisions_left", "robot_speed@1"]
"""


class SameEpisodes(PackageCase):
    def evaluated(self, model, episodes, seed, *options):
        """The rewards that striker-evaluate writes, all digits of them."""
        self.must_run("striker-evaluate", "--model", model, "--episodes", episodes, "--seed", seed, "--json",
                      self.path("r.json"), *options)
        return [row["reward"] for row in self.read_json("r.json")["rows"]]

    def played(self, env, network, episodes, seed):
        rewards = []
        for number in range(episodes):
            observation, _ = env.reset(seed=seed if number == 0 else None)
            total, ended = 0.0, False
            while not ended:
                observation, reward, terminated, truncated, info = env.step(network(observation))
                total += reward
                ended = terminated or truncated
            self.assertEqual(total, info["episode_reward"])
            rewards.append(total)
        return rewards

    def played_by_many(self, env, network, episodes, seed):
        """By world and number; each world's k-th episode is k * worlds + world."""
        observations, _ = env.reset(seed=seed)
        rewards, numbers = {}, numpy.arange(env.num_envs)
        while min(numbers) < episodes:
            observations, _, terminated, truncated, infos = env.step(network(observations))
            for world in numpy.flatnonzero(terminated | truncated):
                rewards[numbers[world]] = infos["episode_reward"][world]
                numbers[world] += env.num_envs
        return [rewards[number] for number in range(episodes)]

    def model(self, **network):
        striker.export(some_network(seed=17, **network), self.path("m.safetensors"))  # it meets the ball in a third
        return self.path("m.safetensors"), striker.Network(self.path("m.safetensors"))

    def test_a_thousand_episodes_of_the_fast_world(self):
        model, network = self.model()
        expected = self.evaluated(model, 1000, 1000, "--world", "fast")
        self.assertGreater(len(set(expected)), 200)
        self.assertEqual(self.played(striker.KickEnv(), network, 1000, 1000), expected)
        for options in ({"threads": 2}, {"autoreset_mode": "same_step", "copy": False}):
            many = striker.VectorKickEnv(16, **options)
            self.assertEqual(self.played_by_many(many, network, 1000, 1000), expected)

    def test_among_wheel_bodies_from_anywhere_with_estimated_velocities(self):
        model, network = self.model()
        expected = self.evaluated(model, 40, 7, "--pose", "anywhere", "--velocities", "estimated")
        env = striker.KickEnv(world="full", pose="anywhere", velocities="estimated")
        self.assertEqual(self.played(env, network, 40, 7), expected)

    def test_of_a_configuration_with_a_mirror(self):
        model, network = self.model(inputs=8)
        with open(self.path("m.toml"), "w", encoding="utf-8") as stream:
            stream.write(MIRRORED)
        expected = self.evaluated(model, 200, 3, "--world", "fast", "--velocities", "estimated", "--config",
                                  self.path("m.toml"))
        self.assertEqual(self.played(striker.KickEnv(config=self.path("m.toml")), network, 200, 3), expected)

    def test_the_aimed_kick(self):
        with open(self.path("a.toml"), "w", encoding="utf-8") as stream:
            stream.write('[task]\nkind = "aimed"\n')
        model, network = self.model()
        expected = self.evaluated(model, 200, 5, "--world", "fast", "--config", self.path("a.toml"))
        self.assertEqual(self.played(striker.KickEnv(kind="aimed"), network, 200, 5), expected)

    def test_an_export_tells_the_programs_its_task(self):
        env = striker.KickEnv(pose="anywhere", inputs=["ball_x", "ball_y", "decisions_left"])
        striker.export(some_network(inputs=3), self.path("e.safetensors"), env=env)
        network = striker.Network(self.path("e.safetensors"))
        expected = self.evaluated(self.path("e.safetensors"), 100, 2, "--world", "fast", "--pose", "anywhere")
        self.assertEqual(self.played(striker.KickEnv(config=network.configuration), network, 100, 2), expected)

    def test_the_episodes_of_a_training(self):
        self.must_run("striker-train", "--config", PAPER, "--seed", 4, "--out", self.path("run"), "--set",
                      "run.episodes=40", "--set", "run.validation_episodes=0", "--set",
                      "task.actions=[[0.0, 0.0], [0.0, 0.0]]")
        with open(self.path("run/learning_curve.csv"), encoding="utf-8") as stream:
            expected = [(int(row["steps"]), row["contact"]) for row in csv.DictReader(stream)]
        env = striker.KickEnv(actions=[[0.0, 0.0], [0.0, 0.0]])  # so that no choice matters
        env.reset(seed=4)
        played = []
        for number in range(40):
            env.reset(options={"episode": striker.FIRST_TRAINING_EPISODE + number})
            steps, ended = 0, False
            while not ended:
                _, _, terminated, truncated, info = env.step(0)
                steps, ended = steps + 1, terminated or truncated
            played.append((steps, "1" if info["contact"] else "0"))
        self.assertEqual(played, expected)
        self.assertGreater(len(set(played)), 3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
