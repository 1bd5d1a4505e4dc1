# SPDX-License-Identifier: Apache-2.0
"""One world of the kick, with Gymnasium's interface."""

import numpy

from striker import _native, checks, spaces
from striker.options import tasks_of
from striker.records import KickRecord

try:
    from gymnasium import Env
except ImportError:
    Env = object


class KickEnv(Env):
    """The kick task: 40 decisions of 50 ms; the ball starts 2 m away and rolls towards the robot, and the robot is to
    hit it ahead, and fast.

    Keywords are those of the table [task] in training/configs/paper.toml, with its defaults: kind, world, pose,
    velocities, equations, inputs, dummies, mirrored and actions; `ball` and `reward` are dictionaries for the tables of
    those names, `robot` is one or the path of a robot's description, and `config` is the path (or the text) of a
    training configuration that they are changes to. What is wrong with one is a RuntimeError that names it.

    reward_function: float = f(KickRecord), which replaces the task's reward: a finite number. What it raises comes out of
    step(), after the decision was taken. `info["episode_reward"]` stays the task's.

    Actions are numbers of set-points (`set_points`), observations float32, an element an input. An episode is
    terminated by its contact (unless reward={"after_contact": "go on"}), and truncated after its 40th decision.

    Episodes: reset(seed=S) is episode 0 of S, and every reset() after it the next one: those that striker-evaluate and
    striker-sil play with --seed S. options={"episode": N} is episode N; a training of seed S plays
    FIRST_TRAINING_EPISODE, FIRST_TRAINING_EPISODE + 1, ... . Before any seed was given one is drawn from the system.

    Cost: about 1 us a step on the plane, 45 us with world="full". A copy by pickle is in the same state, within the
    episode too, and has whatever else a subclass keeps in itself. One thread may use it.
    """

    metadata = {"render_modes": ["rgb_array", "human"], "render_fps": 20}

    def __init__(self, render_mode=None, *, config=None, reward_function=None, **options):
        self.render_mode = checks.one_of("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        self._tasks = tasks_of(config, **options)
        self._kick = _native.Kick(self._tasks)
        self._reward_function = checks.function("reward_function", reward_function)
        self._next_episode = None  # (seed, number); None: no seed yet
        self._picture = None
        self.set_points = numpy.array(self._tasks.set_points)
        self.observation_space = spaces.Box(-numpy.inf, numpy.inf, (self._tasks.inputs,), numpy.float32)
        self.action_space = spaces.Discrete(len(self.set_points))

    @property
    def inputs(self):
        """How many an observation has."""
        return self._tasks.inputs

    @property
    def configuration(self):
        """The whole training configuration as text: for export(), so that the programs know the task."""
        return self._tasks.text

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            seed = checks.whole("seed", seed, 0, checks.GREATEST_SEED)
        if Env is not object:
            super().reset(seed=seed)
        if seed is not None:
            seed, episode = seed, 0
        elif self._next_episode is None:
            seed, episode = int(numpy.random.SeedSequence().generate_state(1)[0]), 0
        else:
            seed, episode = self._next_episode
        episode = checks.episode_of(options, episode, checks.GREATEST_SEED - 1)
        observation = self._kick.reset(seed, episode)
        self._next_episode = (seed, episode + 1)
        if self.render_mode == "human":
            self.render()
        return observation, {"seed": seed, "episode": episode}

    def step(self, action):
        result = self._kick.step(action)
        if self._reward_function is not None:
            observation, _, *rest = result
            result = (observation, checks.reward(self._reward_function(KickRecord(*self._kick.record()))), *rest)
        if self.render_mode == "human":
            self.render()
        return result

    def render(self):
        """rgb_array: an array [height, width, 3] of uint8. human: a window, which shows each step as it is taken."""
        if self.render_mode is None:
            return None
        if self._next_episode is None:
            raise RuntimeError("there is nothing to draw yet: call reset()")
        if self._picture is None:
            from striker.drawing import KickPicture
            self._picture = KickPicture(self.render_mode == "human")
        return self._picture.draw(self._kick.places(), 1.0 / self.metadata["render_fps"])

    def close(self):
        if self._picture is not None:
            self._picture.close()
            self._picture = None

    def __getstate__(self):
        return {**self.__dict__, "_tasks": self._tasks.text, "_kick": self._kick.state(), "_picture": None}

    def __setstate__(self, state):
        self.__dict__.update(state)
        self._tasks = tasks_of(state["_tasks"])
        self._kick = _native.Kick(self._tasks)
        if self._next_episode is not None:
            self._kick.restore(*state["_kick"])
