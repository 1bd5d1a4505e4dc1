#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What Gymnasium promises of an environment, held here without it: spaces, seeds, types, ends, copies.
Usage: kick_env_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import multiprocessing
import pickle
import unittest

from package_case import PackageCase

import numpy
import striker


def walk(env, steps, seed=11):
    """What an environment answers to `steps` random actions, over as many episodes as that takes, as one list."""
    random = numpy.random.default_rng(seed)
    observation, _ = env.reset(seed=seed)
    answers = [observation.tolist()]
    for _ in range(steps):
        observation, reward, terminated, truncated, info = env.step(int(random.integers(env.action_space.n)))
        answers.append((observation.tolist(), reward, terminated, truncated, info))
        if terminated or truncated:
            answers.append(env.reset()[0].tolist())
    return answers


class Harder(striker.KickEnv):
    """An environment of one's own, whose constructor is another one."""

    def __init__(self, difficulty):
        super().__init__(pose="anywhere", reward_function=half)
        self.difficulty = difficulty


def half(record):
    return record.reward / 2.0


def walk_of_a_new_one(steps):
    return walk(striker.KickEnv(pose="anywhere", dummies=2), steps)


class KickEnv(PackageCase):
    def test_observations_and_actions_are_in_their_spaces(self):
        env = striker.KickEnv()
        self.assertEqual((env.observation_space.shape, env.observation_space.dtype), ((6,), numpy.float32))
        self.assertEqual(env.action_space.n, 3)
        observation, info = env.reset(seed=1)
        self.assertEqual(info, {"seed": 1, "episode": 0})
        for _ in range(200):
            self.assertIn(observation, env.observation_space)
            action = env.action_space.sample()
            self.assertIn(action, env.action_space)
            observation, reward, terminated, truncated, info = env.step(action)
            self.assertEqual([type(value) for value in (reward, terminated, truncated, info)],
                             [float, bool, bool, dict])
            if terminated or truncated:
                observation, _ = env.reset()

    def test_what_was_given_out_does_not_change(self):
        env = striker.KickEnv()
        first, _ = env.reset(seed=1)
        kept = first.copy()
        env.step(0)
        numpy.testing.assert_array_equal(first, kept)

    def test_a_seed_is_an_episode_and_the_next_resets_are_the_next_ones(self):
        env, other = striker.KickEnv(), striker.KickEnv()
        firsts = [env.reset(seed=5)[0].tolist(), env.reset()[0].tolist(), env.reset()[0].tolist()]
        self.assertEqual(len({tuple(first) for first in firsts}), 3)
        self.assertEqual(other.reset(seed=5)[0].tolist(), firsts[0])
        self.assertEqual(other.reset(options={"episode": 2})[0].tolist(), firsts[2])
        self.assertEqual(other.reset(seed=5, options={"episode": 1})[0].tolist(), firsts[1])
        self.assertNotEqual(other.reset(seed=6)[0].tolist(), firsts[0])

    def test_without_a_seed_the_system_draws_one(self):
        self.assertNotEqual(striker.KickEnv().reset()[1]["seed"], striker.KickEnv().reset()[1]["seed"])

    def test_the_same_seed_and_actions_are_the_same_to_the_bit(self):
        options = {"pose": "anywhere", "dummies": 2}
        expected = walk(striker.KickEnv(**options), 300)
        env = striker.KickEnv(**options)
        walk(env, 17, seed=3)
        self.assertEqual(walk(env, 300), expected)  # whatever was played before

    def test_many_in_one_process_do_not_meet(self):
        expected = walk(striker.KickEnv(), 200)
        envs = [striker.KickEnv() for _ in range(3)]
        for env in envs:
            env.reset(seed=99)
            env.step(0)
        self.assertEqual([walk(env, 200) for env in envs], [expected] * 3)

    def test_many_processes_play_the_same(self):
        expected = walk_of_a_new_one(150)
        for method in ("fork", "spawn"):
            with multiprocessing.get_context(method).Pool(2) as pool:
                self.assertEqual(pool.map(walk_of_a_new_one, [150, 150]), [expected] * 2)

    def test_time_that_is_over_truncates_and_a_contact_terminates(self):
        env, ends = striker.KickEnv(), set()
        for episode in range(60):
            env.reset(seed=2, options={"episode": episode})
            for decision in range(1, 41):
                _, _, terminated, truncated, info = env.step(1)
                if terminated or truncated:
                    break
                self.assertEqual(info, {})
            self.assertNotEqual(terminated, truncated)
            self.assertEqual(terminated, info["contact"])
            self.assertEqual(truncated, decision == 40 and not info["contact"])
            self.assertEqual("theta_contact_rad" in info, info["contact"])
            ends.add(truncated)
        self.assertEqual(ends, {False, True})

    def test_an_episode_may_go_on_after_its_contact(self):
        env = striker.KickEnv(reward={"after_contact": "go on"})
        contacts = 0
        for episode in range(30):
            env.reset(seed=2, options={"episode": episode})
            flags = [env.step(1)[2:] for _ in range(40)]
            self.assertEqual([(terminated, truncated) for terminated, truncated, _ in flags],
                             [(False, False)] * 39 + [(False, True)])
            contacts += flags[-1][2]["contact"]
        self.assertGreater(contacts, 0)

    def test_no_step_outside_an_episode_and_no_action_that_is_none(self):
        env = striker.KickEnv()
        self.assertRaisesRegex(RuntimeError, r"call reset\(\)", env.step, 0)
        env.reset(seed=1)
        for action in (3, -1):
            self.assertRaisesRegex(ValueError, "0 to 2", env.step, action)
        self.assertRaises(TypeError, env.step, "ahead")
        self.assertRaises(TypeError, env.step, 0.5)
        while not any(env.step(1)[2:4]):
            pass
        self.assertRaisesRegex(RuntimeError, r"call reset\(\)", env.step, 0)

    def test_a_pickled_copy_goes_on_where_it_was(self):
        env = striker.KickEnv(pose="anywhere", dummies=1, velocities="both")
        env.reset(seed=3)
        env.reset()
        for action in (0, 0, 2, 1):
            env.step(action)
        copy = pickle.loads(pickle.dumps(env))
        random = numpy.random.default_rng(1)
        for _ in range(120):
            action = int(random.integers(3))
            ours, theirs = env.step(action), copy.step(action)
            numpy.testing.assert_array_equal(ours[0], theirs[0])
            self.assertEqual(ours[1:], theirs[1:])
            if ours[2] or ours[3]:
                numpy.testing.assert_array_equal(env.reset()[0], copy.reset()[0])
        own = Harder(3)
        own.reset(seed=1)
        own.step(0)
        own.action_space.seed(5)
        other = pickle.loads(pickle.dumps(own))
        self.assertEqual((type(other), other.difficulty), (Harder, 3))
        self.assertEqual([other.action_space.sample() for _ in range(20)], [own.action_space.sample() for _ in range(20)])
        numpy.testing.assert_array_equal(other.step(1)[0], own.step(1)[0])
        unbegun = pickle.loads(pickle.dumps(striker.KickEnv()))
        self.assertRaises(RuntimeError, unbegun.step, 0)

    def test_every_option_of_the_task_counts(self):
        plain = walk(striker.KickEnv(), 1000)
        for option in ({"kind": "aimed"}, {"world": "full"}, {"pose": "anywhere", "inputs": "acs"},
                       {"velocities": "estimated"}, {"equations": "printed"}, {"inputs": ["ball_x", "robot_speed@1"]},
                       {"dummies": 1}, {"mirrored": True}, {"actions": [[1.0, 1.0], [0.0, 0.0], [-1.0, -1.0]]},
                       {"ball": {"speed_m_s": [0.5, 1]}}, {"reward": {"waiting": -0.2}},
                       {"robot": {"torque_limit_mNm": 200}}):
            self.assertTrue(walk(striker.KickEnv(**option), 1000) != plain, option)

    def test_an_option_keeps_every_digit(self):
        waiting = -0.1234567890123456
        env = striker.KickEnv(reward={"waiting": waiting}, actions=numpy.array([[1.0, 1.0], [0.0, 0.0]]))
        env.reset(seed=1)
        self.assertEqual(env.step(0)[1], waiting)

    def test_a_wrong_option_is_named_with_what_it_may_be(self):
        for option, said in (({"world": "slow"}, 'task.world.*"fast" or "full"'), ({"dummies": 101}, "0 to 100"),
                             ({"inputs": ["ball_z"]}, "ball_z"), ({"ball": {"sped": 1}}, "ball.sped"),
                             ({"kind": "aimed", "reward": {"angle": 1.0}}, "reward.angle"),
                             ({"config": "/nowhere.toml"}, "/nowhere.toml")):
            self.assertRaisesRegex(RuntimeError, said, striker.KickEnv, **option)
        self.assertRaisesRegex(TypeError, "wrold.*world", striker.KickEnv, wrold="fast")
        self.assertRaisesRegex(ValueError, "rgb_array", striker.KickEnv, render_mode="ascii")

    def test_a_reward_of_ones_own_replaces_the_tasks(self):
        seen = []

        def reward(record):
            seen.append(record)
            return record.decision + 10.0 * record.just_contact

        env, plain = striker.KickEnv(reward_function=reward), striker.KickEnv()
        for episode in range(20):
            observation, _ = env.reset(seed=2, options={"episode": episode})
            plain.reset(seed=2, options={"episode": episode})
            for decision in range(1, 41):
                observation, paid, terminated, truncated, info = env.step(1)
                expected = plain.step(1)
                self.assertEqual(paid, decision + 10.0 * terminated)
                self.assertEqual((terminated, truncated, info), expected[2:])
                record = seen[-1]
                self.assertEqual((record.decision, record.action, record.reward), (decision, 1, expected[1]))
                self.assertEqual((record.terminated, record.truncated), (terminated, truncated))
                self.assertEqual(record.decisions_left, 40 - decision)
                self.assertAlmostEqual(record.ball_x_m / 2.0, float(observation[0]), 6)
                if terminated:
                    self.assertEqual(record.theta_contact_rad, info["theta_contact_rad"])
                if terminated or truncated:
                    break

    def test_pictures_show_what_happens(self):
        env = striker.KickEnv(render_mode="rgb_array")
        env.reset(seed=1)
        first = env.render()
        self.assertEqual((first.shape, first.dtype), ((400, 400, 3), numpy.uint8))
        self.assertTrue((first == env.render()).all())
        env.step(0)
        self.assertFalse((first == env.render()).all())
        env.close()
        self.assertIsNone(striker.KickEnv().render())


if __name__ == "__main__":
    unittest.main(verbosity=2)
