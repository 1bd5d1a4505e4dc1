#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Whatever a caller does with the package: an exception that says what is wrong, and never the end of the process.
Usage: hostile_use_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import copy
import multiprocessing
import os
import pickle
import resource
import threading
import unittest

from package_case import PackageCase, some_network

import numpy
import striker
from striker import _native

WHOLE = "whole number"


def steps_of_a_new_one(seed):
    env = striker.KickEnv()
    env.reset(seed=seed)
    return [env.step(1)[0].tolist() for _ in range(10)]


def make_with_little_room():
    """Ends with another status than 0 unless it is told so."""
    resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
    try:
        striker.VectorKickEnv(300, threads=256)
    except RuntimeError as error:
        os._exit(0 if str(error).startswith("threads 256: the system gives ") else 2)
    os._exit(1)


class HostileUse(PackageCase):
    def refused(self, error, said, function, *arguments, **keywords):
        with self.subTest(arguments=str(arguments)[:80], keywords=str(keywords)[:80]), self.assertRaises(error) as caught:
            function(*arguments, **keywords)
        text = str(caught.exception)
        self.assertRegex(text, said)
        self.assertNotIn("incompatible", text)  # pybind11's own, which tells nobody what to do
        self.assertLess(len(text), 400)

    def test_actions_of_one_world(self):
        env = striker.KickEnv()
        env.reset(seed=1)
        for action in (1.0, numpy.float32(1), None, "1", [1], numpy.nan, 1j, numpy.array([1]), object()):
            self.refused(TypeError, "^action .*: it must be a whole number, 0 to 2", env.step, action)
        for action in (-1, 3, 2**63, 2**70, -(2**70), numpy.uint64(2**64 - 1)):
            self.refused(ValueError, "^action .*: it must be a whole number, 0 to 2", env.step, action)
        for action in (0, True, numpy.int8(2), numpy.uint64(1), numpy.array(1)):
            env.step(action)

    def test_actions_of_many(self):
        env = striker.VectorKickEnv(4)
        env.reset(seed=1)
        for actions in (None, 1, "abcd", [0.0] * 4, [True] * 4, numpy.zeros((4, 1), int), numpy.zeros(3, int), [[0], [0, 1]],
                        numpy.zeros(4, object), numpy.zeros(4, complex)):
            self.refused(ValueError, ".", env.step, actions)
        for actions in ([0, 1, 2, 3], [-1, 0, 0, 0], numpy.array([0, 0, 0, 2**64 - 1], numpy.uint64)):
            self.refused(ValueError, "^action .*: it must be a whole number, 0 to 2", env.step, actions)
        for actions in ([0, 1, 2, 0], numpy.zeros(8, numpy.uint8)[::2], numpy.zeros(4, ">i8")):
            env.step(actions)

    def test_seeds_and_episodes(self):
        for env in (striker.KickEnv(), striker.VectorKickEnv(2), striker.MatchEnv()):
            for seed in (-1, 2**64, 10**30):
                self.refused(ValueError, f"^seed {seed}: it may be 0 to {2**64 - 1}", env.reset, seed=seed)
            for seed in (1.5, numpy.nan, "x", b"1", 1j, {}):
                self.refused(TypeError, f"^seed .*: it must be a {WHOLE}", env.reset, seed=seed)
            env.reset(seed=2**64 - 1)
            env.reset(seed=numpy.uint64(7))
        for env in (striker.KickEnv(), striker.VectorKickEnv(2)):
            for episode in (-1, 2**64):
                self.refused(ValueError, r"^options\['episode'\] .* may be 0 to", env.reset, options={"episode": episode})
            for episode in (0.5, "x", None):
                self.refused(TypeError, WHOLE, env.reset, options={"episode": episode})
            for options in (5, [1], {"epsiode": 1}, "episode"):
                self.refused(ValueError, "^options .*'episode'", env.reset, options=options)
            env.reset(seed=1, options={})
        for seeds in ([1, 2], [1], []):
            self.refused(ValueError, "one for each of 3 worlds", striker.VectorKickEnv(3).reset, seed=seeds)
        last = striker.KickEnv()
        last.reset(seed=1, options={"episode": 2**64 - 2})
        self.refused(ValueError, "episode", last.reset)

    def test_keywords(self):
        make, many, match = striker.KickEnv, striker.VectorKickEnv, striker.MatchEnv
        for keywords in ({"num_envs": 2.5}, {"num_envs": "3"}, {"num_envs": None}, {"threads": 1.5}, {"reward_function": 5}):
            self.refused(TypeError, f"^{next(iter(keywords))} ", many, **keywords)
        for keywords in ({"num_envs": 10**12}, {"num_envs": -1}, {"threads": 1000}, {"autoreset_mode": 5},
                         {"render_mode": "human"}):
            self.refused(ValueError, f"^{next(iter(keywords))}", many, **keywords)
        for keywords in ({"ball": 5}, {"reward": [1]}, {"robot": 5}, {"config": 5}, {"pose": {}}, {"reward_function": "x"}):
            self.refused(TypeError, ".", make, **keywords)
        for keywords in ({"actions": [[numpy.nan, 1], [1, 1]]}, {"actions": [[1, 1]] * 300}, {"dummies": 10**30},
                         {"inputs": []}, {"inputs": ["ball_x@5"]}, {"ball": {"speed_m_s": [1, numpy.inf]}},
                         {"kind": 'a"\n[x]\ny="1'}, {"kind": "\0"}, {"kind": "\udc80"}, {"robot": "/dev/zero"},
                         {"config": "/dev/zero"}, {"config": "/"}, {"config": "a\nb"}):
            self.assertRaises(RuntimeError, make, **keywords)
        self.refused(RuntimeError, r"task.actions = \[ \[ 1, 1 \], .*\.\.\.: must be a list of 2 to 16 pairs", make, actions=[[1, 1]] * 300)
        for keywords in ({"half_s": 2.7}, {"half_s": "x"}, {"slip": "x"}, {"max_s": None}, {"reward_function": 5}):
            self.refused(TypeError, f"^{next(iter(keywords))} ", match, **keywords)
        for keywords in ({"slip": numpy.nan}, {"jitter_mm": numpy.inf}, {"max_s": -1}, {"colour": None}, {"opponent": 5}):
            self.refused(ValueError, ".", match, **keywords)

    def test_actions_of_a_team(self):
        env = striker.MatchEnv()
        self.refused(RuntimeError, r"call reset\(\)", env.step, {})
        env.reset(seed=1)
        good = {agent: (0.0, 0.0) for agent in env.agents}
        for actions in (None, {}, [1], {"goalkeeper": (0, 0)}):
            self.refused(KeyError, "actions: .* has none", env.step, actions)
        for speeds in ((0,), (0, 0, 0), "x", None, (numpy.nan, 0), (0, -numpy.inf), 1j, (True, False), [[0], [0, 1]]):
            self.refused(ValueError, ".", env.step, {**good, "forward_1": speeds})
        fast, top = striker.MatchEnv(), striker.MatchEnv()
        fast.reset(seed=1)
        top.reset(seed=1)
        for _ in range(20):  # what is too fast is the top speed
            seen = [one.step({agent: (speed, -speed) for agent in one.agents})[0]["forward_1"].tolist()
                    for one, speed in ((fast, 1e300), (top, 2.55))]
        self.assertEqual(*seen)

    def test_copies_that_were_altered(self):
        env = striker.KickEnv()
        env.reset(seed=1)
        env.step(0)
        for actions in ([200], [0] * 41):
            state = env.__getstate__()
            state["_kick"] = (1, 1, actions)
            self.refused(ValueError, "none of an episode", striker.KickEnv.__new__(striker.KickEnv).__setstate__, state)
        many = striker.VectorKickEnv(2)
        many.reset(seed=1)
        for players in ([(1, 1, [0])], [(1, 1, [0])] * 3, [(1, 1, [77])] * 2):
            state = many.__getstate__()
            state["_worlds"] = (2, players)
            self.refused(ValueError, "copy", striker.VectorKickEnv.__new__(striker.VectorKickEnv).__setstate__, state)
        for copied in (pickle.dumps, copy.deepcopy):
            self.refused(TypeError, "make one in each process", copied, striker.MatchEnv())

    def test_a_number_that_plays_itself(self):
        env = striker.KickEnv()

        class Action:
            def __index__(self):
                for _ in range(40):
                    if env.step(0)[3]:
                        break
                return 0

        env.reset(seed=1)
        self.refused(RuntimeError, r"call reset\(\)", env.step, Action())
        self.assertEqual(copy.deepcopy(env).reset()[0].tolist(), env.reset()[0].tolist())

    def test_rewards_that_are_none(self):
        def forgotten(record):
            del record

        for error, function in ((TypeError, forgotten), (TypeError, lambda record: "1"), (ValueError, lambda record: numpy.nan)):
            for env in (striker.KickEnv(reward_function=function), striker.MatchEnv(reward_function=function)):
                env.reset(seed=1)
                action = 0 if isinstance(env, striker.KickEnv) else dict.fromkeys(env.agents, (0.0, 0.0))
                self.refused(error, "^reward_function returned", env.step, action)
        for error, function in ((TypeError, forgotten), (TypeError, lambda record: 1.0), (TypeError, lambda record: record.reward[:2]),
                                (TypeError, lambda record: record.reward * 1j), (ValueError, lambda record: record.reward * numpy.nan)):
            many = striker.VectorKickEnv(3, reward_function=function)
            many.reset(seed=1)
            self.refused(error, "^reward_function returned", many.step, [0, 0, 0])
        match = striker.MatchEnv(reward_function=lambda record: {"goalkeeper": 1.0})
        match.reset(seed=1)
        self.refused(KeyError, "none for defender_1", match.step, dict.fromkeys(match.agents, (0.0, 0.0)))

    def test_a_match_is_over_whatever_its_last_reward_was(self):
        env = striker.MatchEnv(max_s=0.05, reward_function=lambda record: None)
        env.reset(seed=1)
        actions = dict.fromkeys(env.agents, (0.0, 0.0))
        self.refused(TypeError, "^reward_function", env.step, actions)
        self.refused(RuntimeError, r"call reset\(\)", env.step, actions)

    def test_more_threads_than_the_system_gives(self):
        process = multiprocessing.get_context("fork").Process(target=make_with_little_room)
        process.start()
        process.join()
        self.assertEqual(process.exitcode, 0)

    def test_what_was_closed_or_never_begun(self):
        env = striker.KickEnv(render_mode="rgb_array")
        self.refused(RuntimeError, r"call reset\(\)", env.render)
        env.reset(seed=1)
        env.render()
        for _ in range(2):
            env.close()
        env.step(0)
        env.render()
        many = striker.VectorKickEnv(2)
        many.close()
        self.refused(RuntimeError, r"call reset\(\)", many.step, [0, 0])

    def test_the_native_classes_on_their_own(self):
        tasks = striker.options.tasks_of()
        native = _native.Match("idle", True, 300, "official", "servo", 0.0, 10.0)
        for call in (native.robots, native.situation, native.simulated_s, lambda: native.step(numpy.zeros(10))):
            self.refused(RuntimeError, r"call reset\(\)", call)
        for worlds, threads in ((0, 1), (-1, 1), (1, -1)):
            _native.KickWorlds(tasks, worlds, threads, False)
        arrays = numpy.zeros((2, 6), numpy.float32), numpy.zeros(2), numpy.zeros(2, bool), numpy.zeros(2, bool)
        same = _native.KickWorlds(tasks, 2, 1, True)
        self.refused(ValueError, "final observations", same.step, numpy.zeros(2, int), *arrays, None, None)
        self.refused(ValueError, "elements", same.step, numpy.zeros(3, int), *arrays, None, arrays[0])
        arrays[0].flags.writeable = False
        self.refused(ValueError, "writeable", same.reset, [1], 0, arrays[0])

    def test_many_environments_in_many_threads(self):
        expected, found = steps_of_a_new_one(3), {}

        def play(number):
            env = striker.VectorKickEnv(50, threads=2)
            observations = env.reset(seed=number % 2)[0]
            for _ in range(60):
                observations, *_ = env.step(numpy.ones(50, int))
            found[number] = (observations.tolist(), steps_of_a_new_one(3))

        threads = [threading.Thread(target=play, args=(number,)) for number in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual({number: steps for number, (_, steps) in found.items()}, dict.fromkeys(range(8), expected))
        self.assertEqual(len({str(found[number][0]) for number in range(8)}), 2)

    def test_one_environment_in_two_threads(self):
        env, refusals, unexpected = striker.VectorKickEnv(2000), [], []
        env.reset(seed=1)

        def play():
            for _ in range(100):
                try:
                    env.step(numpy.ones(2000, int))
                except RuntimeError as error:
                    refusals.append(str(error))
                except BaseException as error:  # noqa: BLE001
                    unexpected.append(error)

        threads = [threading.Thread(target=play) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(unexpected, [])
        self.assertEqual({text for text in refusals} - {"another thread is in this environment: make one for each"}, set())
        env.step(numpy.ones(2000, int))

    def test_forked_and_spawned(self):
        expected = steps_of_a_new_one(5)
        for method in ("fork", "spawn", "forkserver"):
            with multiprocessing.get_context(method).Pool(2) as pool:
                self.assertEqual(pool.map(steps_of_a_new_one, [5, 5]), [expected] * 2)

    def test_observations_that_are_none(self):
        striker.export(some_network(), self.path("m.safetensors"))
        network = striker.Network(self.path("m.safetensors"))
        for observation in (None, "x", 5, numpy.zeros(5), numpy.zeros((6, 1)), numpy.zeros((2, 3, 1)), numpy.zeros(6, complex),
                            numpy.full(6, numpy.nan), numpy.full(6, 1e300), numpy.zeros(6, object)):
            for ask in (network, network.values):
                self.refused(ValueError, "^observation: ", ask, observation)
        self.assertEqual(network(numpy.zeros((0, 6))).tolist(), [])
        for path in ("a\0b",):
            self.refused(ValueError, "no file has such a name", striker.Network, path)
        for path in ("/dev/zero", "/", "/nowhere", self.path("none")):
            self.refused(RuntimeError, path, striker.Network, path)

    def test_a_path_of_any_bytes_is_in_the_message(self):
        for path in (b"/nowhere/caf\xe9.safetensors", "/nowhere/caf\udce9.onnx"):
            self.refused(RuntimeError, r"^/nowhere/caf\\xe9", striker.Network, path)
        self.refused(RuntimeError, r"^/nowhere/caf\\xe9", striker.KickEnv, config="/nowhere/caf\udce9.toml")

    def test_an_export_that_cannot_be_leaves_everything_as_it_was(self):
        file, network = self.path("m.safetensors"), some_network()
        for given in (None, 5, [], "x"):
            self.refused(TypeError, "^state_dict ", striker.export, given, file)
        for array in (None, "x", numpy.zeros(32, complex), numpy.zeros(32, object)):
            self.refused(TypeError, "^tensor '2.bias'", striker.export, {**network, "2.bias": array}, file)
        self.refused(RuntimeError, "2.bias holds NaN or inf", striker.export, {**network, "2.bias": numpy.full(32, 1e300)}, file)
        self.refused(TypeError, "^env ", striker.export, network, file, env=5)
        self.refused(RuntimeError, "10", striker.export, network, file, env=striker.KickEnv(inputs="acs"))
        self.assertEqual(os.listdir(self.directory), [])
        os.mkfifo(self.path("pipe"))  # as a device is
        for path in (self.path("pipe"), self.directory):
            self.refused(ValueError, "is none", striker.export, network, path)
        self.assertEqual(os.listdir(self.directory), ["pipe"])
        os.symlink("real.safetensors", file)
        striker.export(network, file)
        self.assertTrue(os.path.islink(file))
        self.assertEqual(striker.Network(file).inputs, 6)


if __name__ == "__main__":
    unittest.main(verbosity=2)
