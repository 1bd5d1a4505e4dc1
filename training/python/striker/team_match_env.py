# SPDX-License-Identifier: Apache-2.0
"""A match whose five robots are one agent, with Gymnasium's interface."""

import numpy

from striker import spaces
from striker.match_env import AGENTS, MatchEnv

try:
    from gymnasium import Env
except ImportError:
    Env = object


class TeamMatchEnv(Env):
    """A MatchEnv, whose keywords it takes, for learners that know one agent.

    Actions: ten rim speeds in m/s, the left and the right wheel of the goalkeeper, of defender 1, 2 and of forward 1, 2.
    Observations: 56 float32, what MatchEnv shows the goalkeeper: the own five by number, the opponents, ball and score.
    Rewards: the mean of the robots', so 1 for a goal and -1 for one of the opponent's.
    info: "state", "score", after a reset "seed".
    """

    metadata = {"render_modes": [], "render_fps": 20}

    def __init__(self, opponent="rules", *, render_mode=None, **options):
        self._match = MatchEnv(opponent, render_mode=render_mode, **options)
        self.render_mode = None
        bounds = [self._match.action_space(agent) for agent in AGENTS]
        # Gymnasium's Box takes arrays as bounds, and so does the one that stands in for it.
        self.action_space = spaces.Box(numpy.concatenate([bound.low for bound in bounds]),
                                       numpy.concatenate([bound.high for bound in bounds]), (10,), numpy.float32)
        self.observation_space = spaces.Box(-numpy.inf, numpy.inf, (56,), numpy.float32)

    def reset(self, *, seed=None, options=None):
        observations, infos = self._match.reset(seed=seed, options=options)
        if Env is not object:
            super().reset(seed=seed)
        return observations["goalkeeper"], infos["goalkeeper"]

    def step(self, action):
        speeds = numpy.asarray(action)
        if speeds.dtype.kind not in "fiu" or speeds.shape != (10,):
            raise ValueError(f"action: {speeds.dtype} {speeds.shape}, not ten speeds (10,)")
        pairs = dict(zip(AGENTS, speeds.reshape(5, 2)))
        observations, rewards, terminated, truncated, infos = self._match.step(pairs)
        return (observations["goalkeeper"], sum(rewards.values()) / len(rewards), terminated["goalkeeper"],
                truncated["goalkeeper"], infos["goalkeeper"])

    def render(self):
        return None

    def close(self):
        self._match.close()
