#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Many worlds are as many single ones: what Gymnasium promises of a vector environment, held here without it.
Usage: vector_kick_env_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import multiprocessing
import os
import pickle
import unittest

from package_case import PackageCase

import numpy
import striker

WORLDS = 5


def rollout(env, steps, seed=4):
    """Everything that it answers to random actions, copied."""
    random = numpy.random.default_rng(1)
    answers = [env.reset(seed=seed)[0].copy()]
    for _ in range(steps):
        *arrays, infos = env.step(random.integers(3, size=env.num_envs))
        answers += [array.copy() for array in arrays] + [infos[name] for name in sorted(infos)]
    return answers


def is_equal(ours, theirs):
    return len(ours) == len(theirs) and all(map(numpy.array_equal, ours, theirs))


class VectorKickEnv(PackageCase):
    def test_arrays_are_in_their_spaces(self):
        env = striker.VectorKickEnv(WORLDS)
        self.assertEqual(env.single_action_space.n, 3)
        self.assertEqual(env.single_observation_space.shape, (6,))
        observations, infos = env.reset(seed=1)
        self.assertIn(observations, env.observation_space)
        self.assertEqual(infos, {})
        actions = env.action_space.sample()
        self.assertIn(actions, env.action_space)
        observations, rewards, terminated, truncated, _ = env.step(actions)
        self.assertIn(observations, env.observation_space)
        self.assertEqual([(array.shape, array.dtype) for array in (rewards, terminated, truncated)],
                         [((WORLDS,), numpy.float64), ((WORLDS,), bool), ((WORLDS,), bool)])

    def walk_beside_single_ones(self, seed, mode, first, stride):
        """Steps many worlds and single ones with the same actions; `first` and `stride` number a world's episodes."""
        many = striker.VectorKickEnv(WORLDS, autoreset_mode=mode)
        singles, numbers = [striker.KickEnv() for _ in range(WORLDS)], list(first)
        seeds = seed if isinstance(seed, list) else [seed] * WORLDS
        observations, _ = many.reset(seed=seed)
        for world, single in enumerate(singles):
            alone, _ = single.reset(seed=seeds[world], options={"episode": numbers[world]})
            numpy.testing.assert_array_equal(observations[world], alone)
        random, begins, ends = numpy.random.default_rng(1), [False] * WORLDS, 0
        for _ in range(150):
            actions = random.integers(3, size=WORLDS)
            observations, rewards, terminated, truncated, infos = many.step(actions)
            for world, single in enumerate(singles):
                if begins[world]:
                    numbers[world] += stride
                    alone, _ = single.reset(seed=seeds[world], options={"episode": numbers[world]})
                    numpy.testing.assert_array_equal(observations[world], alone)
                    self.assertEqual((rewards[world], terminated[world], truncated[world]), (0.0, False, False))
                    begins[world] = False
                    continue
                alone, reward, end, over, info = single.step(actions[world])
                self.assertEqual((rewards[world], terminated[world], truncated[world]), (reward, end, over))
                if not (end or over):
                    numpy.testing.assert_array_equal(observations[world], alone)
                    continue
                ends += 1
                for name in info:
                    self.assertTrue(infos["_" + name][world])
                    self.assertEqual(infos[name][world], info[name])
                self.assertEqual(bool(infos["_theta_contact_rad"][world]), info["contact"])
                if mode == "next_step":
                    numpy.testing.assert_array_equal(observations[world], alone)
                    begins[world] = True
                    continue
                numpy.testing.assert_array_equal(infos["final_obs"][world], alone)
                self.assertTrue(infos["_final_obs"][world])
                numbers[world] += stride
                alone, _ = single.reset(seed=seeds[world], options={"episode": numbers[world]})
                numpy.testing.assert_array_equal(observations[world], alone)
            ended = terminated | truncated
            numpy.testing.assert_array_equal(infos.get("_episode_reward", numpy.zeros(WORLDS, bool)), ended)
        self.assertGreater(ends, 10)

    def test_each_world_is_a_single_one_that_begins_anew_in_the_next_step(self):
        self.walk_beside_single_ones(4, "next_step", range(WORLDS), WORLDS)

    def test_each_world_is_a_single_one_that_begins_anew_in_the_same_step(self):
        self.walk_beside_single_ones(4, "same_step", range(WORLDS), WORLDS)

    def test_a_seed_a_world(self):
        self.walk_beside_single_ones([7, 7, 8, 9, 2**63], "next_step", [0] * WORLDS, 1)

    def test_resets_without_a_seed_go_on(self):
        for seed, numbers, stride in ((4, range(WORLDS), WORLDS), ([7, 7, 8, 9, 2**63], [0] * WORLDS, 1)):
            env, single = striker.VectorKickEnv(WORLDS), striker.KickEnv()
            env.reset(seed=seed)
            for turn in (1, 2):
                env.step(numpy.zeros(WORLDS, int))
                observations, _ = pickle.loads(pickle.dumps(env)).reset()
                numpy.testing.assert_array_equal(env.reset()[0], observations)
                for world, number in enumerate(numbers):
                    single.reset(seed=seed if numpy.ndim(seed) == 0 else seed[world])
                    expected, _ = single.reset(options={"episode": number + turn * stride})
                    numpy.testing.assert_array_equal(observations[world], expected)
        again, _ = env.reset(options={"episode": 0})
        numpy.testing.assert_array_equal(again, env.reset(seed=seed)[0])

    def test_threads_change_nothing(self):
        expected = rollout(striker.VectorKickEnv(37), 120)
        for threads in (2, 3):
            self.assertTrue(is_equal(rollout(striker.VectorKickEnv(37, threads=threads), 120), expected))
        self.assertFalse(is_equal(rollout(striker.VectorKickEnv(37), 120, seed=5), expected))

    def test_arrays_are_new_unless_they_are_asked_to_be_the_same(self):
        for copy in (True, False):
            env = striker.VectorKickEnv(WORLDS, copy=copy)
            env.reset(seed=1)
            first, second = env.step(numpy.zeros(WORLDS, int)), env.step(numpy.zeros(WORLDS, int))
            self.assertEqual([ours is theirs for ours, theirs in zip(first[:4], second[:4])], [not copy] * 4)
        self.assertTrue(is_equal(rollout(env, 120), rollout(striker.VectorKickEnv(WORLDS), 120)))

    def test_pickled_copies_go_on_where_they_were(self):
        for mode in ("next_step", "same_step"):
            env = striker.VectorKickEnv(WORLDS, autoreset_mode=mode, pose="anywhere", threads=2)
            for steps in (30, 39, 40, 41):  # some of them just after an end
                rollout(env, steps)
                copy = pickle.loads(pickle.dumps(env))
                for _ in range(60):
                    actions = env.action_space.sample()
                    ours, theirs = env.step(actions), copy.step(actions)
                    self.assertTrue(is_equal(ours[:4], theirs[:4]))
        env.difficulty = 3
        self.assertEqual(pickle.loads(pickle.dumps(env)).difficulty, 3)

    def test_in_several_processes(self):
        expected = rollout(striker.VectorKickEnv(8, threads=2), 60)
        with multiprocessing.get_context("fork").Pool(2) as pool:
            for answers in pool.map(rollout_of_a_new_one, [60, 60]):
                self.assertTrue(is_equal(answers, expected))

    def test_threads_that_a_fork_left_behind_are_missed_aloud(self):
        env = striker.VectorKickEnv(8, threads=2)
        env.reset(seed=1)
        child = os.fork()
        if child == 0:
            try:
                env.step(numpy.zeros(8, int))
                os._exit(1)
            except RuntimeError as error:
                os._exit(0 if "each process" in str(error) else 2)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)
        env.step(numpy.zeros(8, int))

    def test_what_is_no_action_is_refused(self):
        env = striker.VectorKickEnv(WORLDS)
        self.assertRaisesRegex(RuntimeError, r"call reset\(\)", env.step, numpy.zeros(WORLDS, int))
        env.reset(seed=1)
        self.assertRaisesRegex(ValueError, "float64", env.step, numpy.zeros(WORLDS))
        self.assertRaisesRegex(ValueError, r"\(4,\)", env.step, numpy.zeros(4, int))
        self.assertRaisesRegex(ValueError, "0 to 2", env.step, numpy.array([0, 1, 2, 3, 0]))
        self.assertRaisesRegex(ValueError, "one for each of 5 worlds", env.reset, seed=[1, 2])
        for options in ({"num_envs": 0}, {"threads": 0}, {"autoreset_mode": "never"}):
            self.assertRaises(ValueError, striker.VectorKickEnv, **options)

    def test_a_reward_of_ones_own_over_arrays(self):
        env = striker.VectorKickEnv(WORLDS, reward_function=lambda record: 2.0 * record.reward + record.decision)
        plain = striker.VectorKickEnv(WORLDS)
        env.reset(seed=1)
        plain.reset(seed=1)
        decisions = numpy.zeros(WORLDS)
        for _ in range(100):
            actions = plain.action_space.sample()
            *_, rewards, terminated, truncated, _ = plain.step(actions)
            begun = decisions < 0
            decisions = numpy.where(begun, 0, decisions + 1)
            numpy.testing.assert_array_equal(env.step(actions)[1], 2.0 * rewards + decisions)
            decisions[terminated | truncated] = -1


def rollout_of_a_new_one(steps):
    return rollout(striker.VectorKickEnv(8, threads=2), steps)


if __name__ == "__main__":
    unittest.main(verbosity=2)
