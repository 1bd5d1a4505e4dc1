# SPDX-License-Identifier: Apache-2.0
"""A whole match of AI Soccer, five robots against a team of rules, with the interface of PettingZoo's parallel
environments."""

import collections

import numpy

from striker import _native, checks, spaces

try:
    from pettingzoo import ParallelEnv
except ImportError:
    ParallelEnv = object

AGENTS = ("goalkeeper", "defender_1", "defender_2", "forward_1", "forward_2")
STATES = ("open_play", "kickoff", "goal_kick", "corner", "penalty", "pause", "over")
FRAME_S = 0.05

MatchRecord = collections.namedtuple("MatchRecord", (
    "own", "opponents", "ball", "clock_s", "half", "score", "opponent_score", "scored", "conceded", "state",
    "has_ball"))
MatchRecord.__doc__ = """A frame of a match, as the team sees it after its orders were carried out, in the own-team frame.

own, opponents         arrays [5, 5], a row a robot by id: x, y (m), heading (rad), 1: may move, 1: touched the ball
ball                   array [3]: x, y, height of its centre, m
clock_s, half          of the half; 1 or 2
score, opponent_score  so far
scored, conceded       goals in this frame
state                  open_play, kickoff, goal_kick, corner, penalty, pause or over
has_ball               the set piece is this team's
"""


def goals(record):
    """The reward that a match pays for itself: 1 for a goal, -1 for one of the opponent's, to each robot."""
    return float(record.scored - record.conceded)


class MatchEnv(ParallelEnv):
    """Five robots a team, each with its own controller on a bus of its own, a frame of 50 ms a step.

    Agents: goalkeeper, defender_1, defender_2, forward_1, forward_2, whose numbers on the field are 0 to 4.

    Actions: the rim speeds of the left and the right wheel in m/s, positive ahead, up to the robot's top speed (1.8, 2.1,
    2.55 m/s); what is faster counts as that. They go over the bus as a team's orders do, and count where the referee lets the robot move: in a pause
    they are ignored.

    Observations: 56 float32 in the own-team frame (x to the opponent's goal, origin in the centre, metres, which turns at
    half-time): of each robot x, y, sine and cosine of the heading, may move: first this one, then the other four by
    number, then the opponents; then the ball's x, y, height, the half's clock in minutes, goals ahead, and 1 if a set
    piece is this team's, -1 if it is the other's.

    Keywords: opponent (a team of striker-sil match: rules, striker, ...), colour ("red" or "blue"), half_s, rules
    ("official", "published"), plant ("servo", "drive"), slip, jitter_mm: as `striker-sil match` has them. max_s truncates
    the episode after so much simulated time; 0: the whole match, which terminates with its end.
    reward_function: f(MatchRecord), a finite float for all agents or a dictionary of one each; goals() otherwise.

    reset(seed=S) is the match of seed S; without one, the next number. The same seed and actions are the same match to
    the bit. A match has no copies by pickle: its controllers are ten running programs' worth of state.
    """

    metadata = {"name": "striker_match_v0", "render_modes": [], "render_fps": 20, "is_parallelizable": True}

    def __init__(self, opponent="rules", *, colour="red", half_s=300, rules="official", plant="servo", slip=0.0,
                 jitter_mm=10.0, max_s=0.0, reward_function=goals, render_mode=None):
        for name, value, choices in (("colour", colour, ("red", "blue")), ("plant", plant, ("servo", "drive")),
                                     ("rules", rules, ("official", "published")), ("render_mode", render_mode, (None,))):
            checks.one_of(name, value, choices)
        half_s = checks.whole("half_s", half_s, 1, 3600)
        slip = checks.number("slip", slip, 0.0, 1.0)
        jitter_mm = checks.number("jitter_mm", jitter_mm, 0.0, 100.0)
        max_s = checks.number("max_s", max_s, 0.0, 1e6)
        self.render_mode = None
        self.possible_agents = list(AGENTS)
        self.agents = []
        self._match = _native.Match(str(opponent), colour == "red", half_s, rules, plant, slip, jitter_mm)
        self._max_s, self._seed = max_s, 0
        self._reward_function = checks.function("reward_function", reward_function) or goals
        self._score = None
        # A robot may be pushed past a line, and a goal is deep: wider than the field.
        self._observation_spaces = {agent: spaces.Box(-numpy.inf, numpy.inf, (56,), numpy.float32) for agent in AGENTS}
        self._action_spaces = {agent: spaces.Box(-speed, speed, (2,), numpy.float32)
                               for agent, speed in zip(AGENTS, _native.TOP_SPEEDS_M_S)}

    def observation_space(self, agent):
        return self._observation_spaces[agent]

    def action_space(self, agent):
        return self._action_spaces[agent]

    def reset(self, seed=None, options=None):
        self._seed = checks.whole("seed", self._seed + 1 if seed is None else seed, 0, checks.GREATEST_SEED)
        self._match.reset(self._seed)
        self.agents = list(AGENTS)
        self._score = (0, 0)
        record = self._look()
        return self._observations(record), {agent: {"seed": self._seed} for agent in AGENTS}

    def step(self, actions):
        if not self.agents:
            raise RuntimeError("the match has ended, or none has begun: call reset()")
        over = self._match.step(self._speeds(actions))
        record = self._look()
        truncated = not over and 0.0 < self._max_s <= self._match.simulated_s()
        if over or truncated:
            self.agents = []
        observations = self._observations(record)  # before anybody else has the record
        rewards = self._rewards(self._reward_function(record))
        info = {"state": record.state, "score": (record.score, record.opponent_score)}
        return (observations, rewards, dict.fromkeys(AGENTS, over), dict.fromkeys(AGENTS, truncated),
                {agent: dict(info) for agent in AGENTS})

    @staticmethod
    def _rewards(reward):
        if not isinstance(reward, dict):
            return dict.fromkeys(AGENTS, checks.reward(reward))
        missing = [agent for agent in AGENTS if agent not in reward]
        if missing:
            raise KeyError(f"reward_function returned none for {missing[0]}; give a number, or one for each agent")
        return {agent: checks.reward(reward[agent]) for agent in AGENTS}

    def _speeds(self, actions):
        speeds = numpy.zeros((len(AGENTS), 2))
        for row, agent in zip(speeds, AGENTS):
            if not isinstance(actions, dict) or agent not in actions:
                raise KeyError(f"actions: {agent} has none; give a dictionary of two speeds for each agent")
            given = numpy.asarray(actions[agent])
            if given.dtype.kind not in "fiu" or given.shape != (2,) or not numpy.isfinite(given).all():
                raise ValueError(f"actions[{agent!r}] {checks.shown(actions[agent])}: two finite speeds in m/s")
            row[:] = given
        return speeds

    def __getstate__(self):
        raise TypeError("a MatchEnv cannot be pickled or copied: make one in each process")

    def render(self):
        return None

    def close(self):
        """Nothing to do: what it holds goes with it."""

    def _look(self):
        robots, situation = self._match.robots(), self._match.situation()
        clock_s, half, score, opponent_score, state, has_ball = situation[3:]
        scored, conceded = score - self._score[0], opponent_score - self._score[1]
        self._score = (score, opponent_score)
        return MatchRecord(robots[:5], robots[5:], numpy.array(situation[:3]), clock_s, int(half), int(score),
                           int(opponent_score), int(scored), int(conceded), STATES[int(state)], bool(has_ball))

    @staticmethod
    def _observations(record):
        seen = numpy.concatenate((record.own, record.opponents))
        robots = numpy.column_stack((seen[:, :2], numpy.sin(seen[:, 2]), numpy.cos(seen[:, 2]), seen[:, 3]))
        in_set_piece = record.state in STATES[1:5]
        common = (*record.ball, record.clock_s / 60.0, record.score - record.opponent_score,
                  (1.0 if record.has_ball else -1.0) if in_set_piece else 0.0)
        observations = {}
        for number, agent in enumerate(AGENTS):
            order = [number, *(other for other in range(5) if other != number), *range(5, 10)]
            observations[agent] = numpy.concatenate((robots[order].ravel(), common)).astype(numpy.float32)
        return observations
