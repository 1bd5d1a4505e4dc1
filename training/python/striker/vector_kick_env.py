# SPDX-License-Identifier: Apache-2.0
"""Many worlds of the kick, one call a step, with the interface of Gymnasium's vector environments."""

import numpy

from striker import _native, checks, spaces
from striker.options import tasks_of
from striker.records import KickRecord

try:
    from gymnasium.vector import VectorEnv
except ImportError:
    VectorEnv = object

AUTORESET_MODES = ("next_step", "same_step")
MOST_WORLDS, MOST_THREADS = 100_000, 256  # a world takes 18 KB, 63 KB with world="full"


def _autoreset_mode(name):
    """As Gymnasium from 1.1 on says it, or its value."""
    try:
        from gymnasium.vector import AutoresetMode
    except ImportError:
        return name
    return {"next_step": AutoresetMode.NEXT_STEP, "same_step": AutoresetMode.SAME_STEP}[name]


class VectorKickEnv(VectorEnv):
    """`num_envs` kicks (KickEnv, whose keywords it takes) in one object.

    step(actions) takes an array of whole numbers, one a world, and returns (observations [n, inputs] float32,
    rewards [n] float64, terminated [n] bool, truncated [n] bool, infos).

    autoreset_mode "next_step": a world whose episode ended begins its next one in the step after, which ignores its
    action and pays 0. "same_step": at once; infos["final_obs"] then holds what the last decision saw, in the rows that
    infos["_final_obs"] marks.

    infos, where any episode ended: arrays "episode_reward", "contact", "contact_decision", "theta_contact_rad",
    "v_contact_m_s", "front_face", and for each a mask, "_episode_reward" and so on, of the worlds that it holds for.

    Episodes: reset(seed=S): world i plays episodes i, i + n, i + 2n, ... of S. reset(seed=[...]): each world its own
    seed's 0, 1, 2, .... options={"episode": N}: from N on. A reset() without a seed goes on: every world begins its next
    episode. Before any seed was given one is drawn from the system. So threads change no result.

    threads: so many step the worlds; the caller's is one of them. Python's lock is free meanwhile.
    copy: False has every step return the same arrays, overwritten; they are otherwise new, and written once.
    reward_function: array = f(KickRecord of arrays), which replaces the task's reward: finite numbers, one a world (what it
    raises comes out of step(), after the decisions were taken); a world that begins an episode
    (next_step) has decision 0.

    Cost: 0.2 us a world and step, divided by the threads. Copies by pickle are in the same state. An environment with
    threads belongs to the process that made it.
    """

    def __init__(self, num_envs=1, *, threads=1, autoreset_mode="next_step", copy=True, config=None,
                 reward_function=None, render_mode=None, **options):
        mode = checks.one_of("autoreset_mode", str(getattr(autoreset_mode, "name", autoreset_mode)).lower(), AUTORESET_MODES)
        num_envs = checks.whole("num_envs", num_envs, 1, MOST_WORLDS)
        threads = checks.whole("threads", threads, 1, MOST_THREADS)
        if render_mode is not None:
            raise ValueError("render_mode: many worlds are not drawn; make a KickEnv")
        self.render_mode = None
        self.num_envs = num_envs
        self.metadata = {"render_modes": [], "autoreset_mode": _autoreset_mode(mode)}
        self._tasks = tasks_of(config, **options)
        self._threads, self._same_step, self._copy = threads, mode == "same_step", copy
        self._worlds = self._new_worlds()
        self._reward_function = checks.function("reward_function", reward_function)
        self._seed = None  # no episode has begun
        self.set_points = numpy.array(self._tasks.set_points)
        inputs, actions = self._tasks.inputs, len(self.set_points)
        self._arrays = self._new_arrays()
        self.single_observation_space = spaces.Box(-numpy.inf, numpy.inf, (inputs,), numpy.float32)
        self.single_action_space = spaces.Discrete(actions)
        self.observation_space = spaces.Box(-numpy.inf, numpy.inf, (num_envs, inputs), numpy.float32)
        self.action_space = spaces.MultiDiscrete(numpy.full(num_envs, actions))

    @property
    def inputs(self):
        """How many an observation has."""
        return self._tasks.inputs

    @property
    def configuration(self):
        """The whole training configuration as text: for export(), so that the programs know the task."""
        return self._tasks.text

    def _new_worlds(self):
        return _native.KickWorlds(self._tasks, self.num_envs, self._threads, self._same_step)

    def _new_arrays(self):
        worlds = self.num_envs
        return (numpy.empty((worlds, self._tasks.inputs), numpy.float32), numpy.empty(worlds),
                numpy.empty(worlds, bool), numpy.empty(worlds, bool))

    def reset(self, *, seed=None, options=None):
        goes_on = seed is None and self._seed is not None and not options
        first = checks.episode_of(options, 0, checks.GREATEST_SEED - self.num_envs)
        if seed is None:
            seed = self._seed if self._seed is not None else int(numpy.random.SeedSequence().generate_state(1)[0])
        observations = self._new_arrays()[0]
        if goes_on:
            self._worlds.go_on(observations)
        elif isinstance(seed, (list, tuple)) or numpy.ndim(seed) > 0:
            seed = [checks.whole("seed", one, 0, checks.GREATEST_SEED) for one in seed]
            self._worlds.reset(seed, first, observations)
        else:
            seed = checks.whole("seed", seed, 0, checks.GREATEST_SEED)
            self._worlds.reset_one_seed(seed, first, observations)
        self._seed = seed
        return observations, {}

    def step(self, actions):
        if self._seed is None:
            raise RuntimeError("no episode has begun: call reset()")
        chosen = numpy.asarray(actions)
        if chosen.dtype.kind not in "iu" or chosen.shape != (self.num_envs,):
            raise ValueError(f"actions: {chosen.dtype} {chosen.shape}, not whole numbers ({self.num_envs},)")
        arrays = self._new_arrays() if self._copy else self._arrays
        records = numpy.empty((self.num_envs, len(KickRecord._fields))) if self._reward_function else None
        finals = numpy.zeros_like(arrays[0]) if self._same_step else None
        if chosen.dtype == numpy.uint64:
            chosen = numpy.minimum(chosen, numpy.uint64(2**63 - 1))  # none of them is an action, nor wraps to one
        ended = self._worlds.step(chosen.astype(numpy.int64, "C", copy=False), *arrays, records, finals)
        observations, rewards, terminated, truncated = arrays
        if records is not None:
            rewards[:] = checks.rewards(self._reward_function(KickRecord(*records.T)), self.num_envs)
        infos = self._worlds.infos(terminated, truncated) if ended else {}
        if ended and self._same_step:
            infos["final_obs"], infos["_final_obs"] = finals, infos["_episode_reward"]
        return observations, rewards, terminated, truncated, infos

    def close(self, **_):
        """Nothing to do: what it holds goes with it."""

    def __getstate__(self):
        return {**self.__dict__, "_tasks": self._tasks.text, "_worlds": self._worlds.state()}

    def __setstate__(self, state):
        self.__dict__.update(state)
        self._tasks = tasks_of(state["_tasks"])
        self._worlds = self._new_worlds()
        if self._seed is not None:
            self._worlds.restore(*state["_worlds"])
