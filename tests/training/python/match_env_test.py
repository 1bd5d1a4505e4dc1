#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A whole match from Python: what PettingZoo promises of a parallel environment, and that it is the match that striker-sil
plays. Usage: match_env_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import csv
import unittest

from package_case import PackageCase

import numpy
import striker


def constant(left, right):
    return lambda env: {agent: numpy.array([left, right], numpy.float32) for agent in env.agents}


def walk(env, choose, steps, seed=3):
    """Everything that it answers, but for arrays as lists."""
    observations, _ = env.reset(seed=seed)
    answers = []
    for _ in range(steps):
        answers.append({agent: observation.tolist() for agent, observation in observations.items()})
        observations, *rest = env.step(choose(env))
        answers.append(rest)
    return answers


class MatchEnv(PackageCase):
    def test_agents_spaces_and_types(self):
        env = striker.MatchEnv(max_s=1.0)
        self.assertEqual(env.possible_agents, ["goalkeeper", "defender_1", "defender_2", "forward_1", "forward_2"])
        observations, infos = env.reset(seed=1)
        self.assertEqual((env.agents, list(infos)), (env.possible_agents, env.possible_agents))
        self.assertIs(env.observation_space("forward_1"), env.observation_space("forward_1"))
        self.assertEqual([float(env.action_space(agent).high[0]) for agent in env.agents],
                         [float(numpy.float32(speed)) for speed in (1.8, 2.1, 2.1, 2.55, 2.55)])
        for step in range(20):
            for agent in env.possible_agents:
                self.assertIn(observations[agent], env.observation_space(agent))
            observations, rewards, terminated, truncated, infos = env.step(
                {agent: env.action_space(agent).sample() for agent in env.agents})
            for answer in (observations, rewards, terminated, truncated, infos):
                self.assertEqual(list(answer), env.possible_agents)
            self.assertEqual(set(terminated.values()), {False})
            if env.agents == []:
                break
        self.assertEqual(set(truncated.values()), {True})
        self.assertIn(step, (18, 19))
        self.assertRaisesRegex(RuntimeError, r"call reset\(\)", env.step, {})

    def test_each_sees_itself_first(self):
        env = striker.MatchEnv()
        observations, _ = env.reset(seed=1)
        places = {agent: observation[:2].tolist() for agent, observation in observations.items()}
        self.assertEqual(len(set(map(tuple, places.values()))), 5)
        self.assertLess(places["goalkeeper"][0], -3.0)  # in front of the own goal
        for agent, observation in observations.items():
            others = sorted(observation[[5, 10, 15, 20]].tolist() + [places[agent][0]])
            self.assertEqual(others, sorted(place[0] for place in places.values()))
            self.assertEqual(observation[25:].tolist(), observations["goalkeeper"][25:].tolist())

    def test_the_same_seed_and_actions_are_the_same_to_the_bit(self):
        expected = walk(striker.MatchEnv(), constant(1.0, 0.5), 60)
        env = striker.MatchEnv()
        walk(env, constant(-1.0, 1.0), 10, seed=8)
        self.assertEqual(walk(env, constant(1.0, 0.5), 60), expected)
        self.assertNotEqual(walk(env, constant(1.0, 0.5), 60, seed=4), expected)
        self.assertNotEqual(walk(env, constant(0.5, 1.0), 60), expected)

    def test_it_is_the_match_that_striker_sil_plays(self):
        """Red stands; what it is shown is what striker-sil notes that it was shown."""
        self.must_run("striker-sil", "match", "--red", "idle", "--blue", "rules", "--seed", 5, "--first-s", 20, "-o",
                      self.path("out"))
        with open(self.path("out/frames.csv"), encoding="utf-8") as stream:
            rows = {int(row["frame"]): row for row in csv.DictReader(stream)}
        self.assertGreater(len(rows), 200)
        env, compared = striker.MatchEnv("rules"), 0
        observations, _ = env.reset(seed=5)
        for frame in range(1, 400):
            if frame in rows:
                row, seen = rows[frame], observations["goalkeeper"]
                expected = [row["ball_pos_0"], row["ball_pos_1"], row["robot_2_cur_pos_0"], row["robot_4_cur_pos_opp_1"]]
                numpy.testing.assert_allclose([*seen[50:52], seen[10], seen[46]], [float(text) for text in expected],
                                              atol=2e-5)
                compared += 1
            observations, *_ = env.step(constant(0.0, 0.0)(env))
        self.assertGreater(compared, 200)

    def test_the_own_team_frame_turns_with_the_colour(self):
        red, blue = striker.MatchEnv("idle", jitter_mm=0.0), striker.MatchEnv("idle", colour="blue", jitter_mm=0.0)
        ours, theirs = (env.reset(seed=1)[0]["goalkeeper"] for env in (red, blue))
        numpy.testing.assert_allclose(ours[:15], theirs[:15], atol=1e-6)  # without the forwards: kickoff is one team's
        for _ in range(100):
            moved = [env.step(constant(0.5, 0.5)(env))[0]["goalkeeper"] for env in (red, blue)]
        for before, after in ((ours, moved[0]), (theirs, moved[1])):
            sine, cosine = before[2:4]
            self.assertGreater(numpy.dot(after[:2] - before[:2], (cosine, sine)), 0.2)  # ahead

    def test_a_goal_pays_and_a_short_match_terminates(self):
        records = []

        def reward(record):
            records.append(record)
            return {agent: float(number) for number, agent in enumerate(striker.match_env.AGENTS)}

        env = striker.MatchEnv("striker", half_s=20, reward_function=reward)
        env.reset(seed=2)
        while env.agents:
            _, rewards, terminated, truncated, infos = env.step(constant(0.0, 0.0)(env))
        self.assertEqual(list(rewards.values()), [0.0, 1.0, 2.0, 3.0, 4.0])
        self.assertEqual((set(terminated.values()), set(truncated.values())), ({True}, {False}))
        self.assertEqual(infos["goalkeeper"]["state"], "over")
        self.assertEqual(sum(record.conceded for record in records), records[-1].opponent_score)
        self.assertEqual(striker.match_env.goals(records[-1]._replace(scored=0, conceded=1)), -1.0)
        self.assertGreater(records[-1].opponent_score, 0)  # nobody keeps the goal

    def test_a_reward_that_writes_into_its_record_changes_nothing_else(self):
        def scribble(record):
            record.own[:] = record.opponents[:] = 9.0
            record.ball[:] = 9.0
            return 0.0

        seen = []
        for function in (scribble, lambda record: 0.0):
            env = striker.MatchEnv(reward_function=function)
            env.reset(seed=1)
            seen.append([env.step(constant(1.0, 0.5)(env))[0]["forward_1"].tolist() for _ in range(3)])
        self.assertEqual(*seen)

    def test_what_is_wrong_is_refused(self):
        for options in ({"colour": "green"}, {"half_s": 0}, {"plant": "rocket"}, {"slip": 2.0}, {"opponent": "nobody"}):
            self.assertRaises(ValueError, striker.MatchEnv, **options)
        env = striker.MatchEnv()
        env.reset(seed=1)
        self.assertRaisesRegex(ValueError, "finite", env.step, constant(numpy.nan, 0.0)(env))
        self.assertRaises(KeyError, env.step, {"goalkeeper": (0.0, 0.0)})


if __name__ == "__main__":
    unittest.main(verbosity=2)
