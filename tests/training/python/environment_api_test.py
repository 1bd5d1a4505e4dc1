#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What check_env of Gymnasium (1.4) and parallel_api_test of PettingZoo (1.27) ask of an environment, asked here where neither
is installed, and of the classes that stand in for theirs. Usage: environment_api_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import inspect
import os
import unittest

from package_case import PackageCase

os.environ["MPLBACKEND"] = "Agg"  # a window for "human" that needs no screen

import numpy
import striker

SINGLE = {"the kick": striker.KickEnv,
          "the kick among wheel bodies": lambda **more: striker.KickEnv(world="full", pose="anywhere", **more),
          "the kick in the field's axes": lambda **more: striker.KickEnv(inputs="acs", dummies=1, **more),
          "the match of a team": lambda **more: striker.TeamMatchEnv(max_s=2.0, **more)}


def same(ours, theirs):
    """Equal to the bit, and of the same types."""
    if type(ours) is not type(theirs):
        return False
    if isinstance(ours, dict):
        return ours.keys() == theirs.keys() and all(same(ours[key], theirs[key]) for key in ours)
    if isinstance(ours, (tuple, list)):
        return len(ours) == len(theirs) and all(map(same, ours, theirs))
    if isinstance(ours, numpy.ndarray):
        return ours.dtype == theirs.dtype and numpy.array_equal(ours, theirs)
    return ours == theirs


class EnvironmentApi(PackageCase):
    def each(self):
        for name, make in SINGLE.items():
            with self.subTest(name):
                yield make

    def test_spaces_are_sound(self):
        for make in self.each():
            env = make()
            for space in (env.observation_space, env.action_space):
                if hasattr(space, "n"):
                    self.assertGreater(space.n, 0)
                    self.assertEqual(space.shape, ())
                else:
                    self.assertEqual((space.low.shape, space.high.shape), (space.shape, space.shape))
                    self.assertTrue((space.low < space.high).all())
                for _ in range(100):
                    self.assertIn(space.sample(), space)
                space.seed(5)
                first = [space.sample() for _ in range(5)]
                space.seed(5)
                self.assertTrue(same(first, [space.sample() for _ in range(5)]))
            self.assertFalse(hasattr(env, "seed"))

    def test_a_reset_gives_an_observation_and_a_dictionary(self):
        for make in self.each():
            env = make()
            parameters = inspect.signature(env.reset).parameters
            self.assertEqual({name: value.default for name, value in parameters.items()}, {"seed": None, "options": None})
            for keywords in ({}, {"seed": 1}, {"options": {}}):
                result = env.reset(**keywords)
                self.assertEqual((type(result), len(result)), (tuple, 2))
                self.assertIn(result[0], env.observation_space)
                self.assertIsInstance(result[1], dict)

    def test_a_seed_decides_all_the_resets_after_it(self):
        for make in self.each():
            env = make()
            firsts = [env.reset(seed=123), env.reset(), env.reset(seed=123), env.reset(), env.reset(seed=456)]
            self.assertTrue(same(firsts[:2], firsts[2:4]))
            self.assertFalse(same(firsts[0][0], firsts[4][0]))

    def test_a_step_gives_five_of_the_right_types(self):
        for make in self.each():
            env = make()
            env.reset(seed=1)
            for _ in range(60):
                observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
                self.assertIn(observation, env.observation_space)
                self.assertEqual([type(value) for value in (reward, terminated, truncated, info)], [float, bool, bool, dict])
                self.assertTrue(numpy.isfinite(reward) and numpy.isfinite(observation).all())
                if terminated or truncated:
                    env.reset()

    def test_the_same_seed_and_action_are_the_same_step(self):
        for make in self.each():
            env = make()
            env.action_space.seed(123)
            action = env.action_space.sample()
            steps = []
            for _ in range(2):
                env.reset(seed=123)
                steps.append(env.step(action))
            self.assertTrue(same(*steps))
            self.assertFalse(steps[0][3])

    def test_every_render_mode_that_is_declared_draws(self):
        for make in self.each():
            self.assertGreater(make().metadata["render_fps"], 0)
            self.assertIsNone(make().render_mode)
            for mode in make().metadata["render_modes"]:
                env = make(render_mode=mode)
                self.assertEqual(env.render_mode, mode)
                env.reset(seed=1)
                env.step(env.action_space.sample())
                picture = env.render()
                if mode == "rgb_array":
                    self.assertEqual((picture.dtype, picture.ndim, picture.shape[2]), (numpy.uint8, 3, 3))
                else:
                    self.assertIsNone(picture)
                env.close()
            with self.assertRaises(ValueError):
                make(render_mode="none such")

    def test_it_may_be_closed_twice(self):
        for make in self.each():
            env = make()
            env.close()
            env.close()

    def test_a_team_of_agents_lives_and_ends_together(self):
        env = striker.MatchEnv(max_s=2.0)
        env.reset(seed=0, options={"options": 1})  # PettingZoo's own test gives it that
        for _ in range(2):
            observations, infos = env.reset()
            self.assertTrue(set(env.agents) == set(observations) == set(infos) == set(env.possible_agents))
            alive, rounds = list(env.agents), 0
            while env.agents:
                answers = env.step({agent: env.action_space(agent).sample() for agent in env.agents})
                for answer in answers:
                    self.assertEqual(set(answer), set(alive))
                observations, rewards, terminated, truncated, _ = answers
                for agent in alive:
                    self.assertIs(env.observation_space(agent), env.observation_space(agent))
                    self.assertIs(env.action_space(agent), env.action_space(agent))
                    self.assertIn(observations[agent], env.observation_space(agent))
                    self.assertEqual((type(rewards[agent]), type(terminated[agent]), type(truncated[agent])),
                                     (float, bool, bool))
                ended = [agent for agent in alive if terminated[agent] or truncated[agent]]
                self.assertEqual(set(env.agents), set(alive) - set(ended))
                rounds += 1
            self.assertEqual(ended, alive)
            self.assertIn(rounds, (39, 40))

    def test_two_matches_of_one_seed_are_one_match(self):
        answers = []
        for env in (striker.MatchEnv(max_s=2.0), striker.MatchEnv(max_s=2.0)):
            played = [env.reset(seed=42)]
            for number, agent in enumerate(env.agents):
                env.action_space(agent).seed(42 + number)
            while env.agents:
                played.append(env.step({agent: env.action_space(agent).sample() for agent in env.agents}))
            answers.append(played)
        self.assertTrue(same(*answers))

    def test_a_team_as_one_agent_is_that_team(self):
        team, one = striker.MatchEnv(max_s=2.0), striker.TeamMatchEnv(max_s=2.0)
        seen, infos = team.reset(seed=7)
        self.assertTrue(same((seen["goalkeeper"], infos["goalkeeper"]), one.reset(seed=7)))
        while team.agents:
            action = one.action_space.sample()
            answers = team.step(dict(zip(team.possible_agents, action.reshape(5, 2))))
            self.assertTrue(same([answer["goalkeeper"] for answer in answers], list(one.step(action))))
        for action in (None, numpy.zeros(9), numpy.zeros((5, 2)), numpy.full(10, numpy.nan), ["x"] * 10):
            self.assertRaises((ValueError, RuntimeError), one.step, action)

    def test_many_worlds_say_how_they_begin_anew(self):
        for mode in ("next_step", "same_step"):
            env = striker.VectorKickEnv(3, autoreset_mode=mode)
            said = env.metadata["autoreset_mode"]
            self.assertEqual(getattr(said, "name", said).lower(), mode)
            self.assertEqual((env.observation_space.shape, env.action_space.shape), ((3, 6), (3,)))
            for keywords in ({}, {"seed": 1}, {"seed": [1, 2, 3]}, {"options": {}}):
                observations, infos = env.reset(**keywords)
                self.assertIn(observations, env.observation_space)
                self.assertEqual(infos, {})


if __name__ == "__main__":
    unittest.main(verbosity=2)
