#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Vectorised rollouts, and what a step costs from Python: steps a second of processor time, the median of five; what a
second thread brings, by the clock on the wall, the best of nine of each in turns; and CartPole, where gymnasium is installed.

    PYTHONPATH=build/python training/python/examples/speed.py
"""

import argparse
import statistics
import time

import numpy
import striker


def rate(play, steps):
    """Steps a second of this process, the median of five repetitions."""
    rates = []
    for _ in range(5):
        begin = time.process_time()
        play(steps)
        rates.append(steps / (time.process_time() - begin))
    return statistics.median(rates)


def single(env, actions):
    env.reset(seed=1)

    def play(steps):
        for number in range(steps):
            _, _, terminated, truncated, _ = env.step(actions[number % len(actions)])
            if terminated or truncated:
                env.reset()
    return play


def many(env, actions):
    env.reset(seed=1)

    def play(steps):
        for number in range(steps // env.num_envs):
            env.step(actions[number % len(actions)])
    return play


def match(env):
    def play(steps):
        for _ in range(steps):
            if not env.agents:
                env.reset(seed=1)
            env.step({agent: (1.0, 0.5) for agent in env.agents})
    return play


def two_threads(share):
    """How many times as fast two threads are: of an idle machine with two cores, that is."""
    worlds, steps = 1024, max(1, int(600 * share))
    actions = numpy.random.default_rng(1).integers(3, size=(64, worlds))
    envs = [striker.VectorKickEnv(worlds, threads=threads) for threads in (1, 2)]
    plays, best_s = [many(env, actions) for env in envs], [float("inf")] * 2
    for _ in range(9):
        for number, play in enumerate(plays):
            begin = time.perf_counter()
            play(worlds * steps)
            best_s[number] = min(best_s[number], time.perf_counter() - begin)
    return best_s[0] / best_s[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--share", type=float, default=1.0, help="of the steps that are measured otherwise")
    share = parser.parse_args().share
    random = numpy.random.default_rng(1)
    alone = rate(single(striker.KickEnv(), random.integers(3, size=1000).tolist()), int(300_000 * share))
    print(f"KickEnv                      {alone:11,.0f} steps/s")
    for worlds in (64, 1024):
        actions = random.integers(3, size=(64, worlds))
        together = rate(many(striker.VectorKickEnv(worlds), actions), max(worlds, int(3_000_000 * share)))
        print(f"VectorKickEnv, {worlds:4} worlds   {together:11,.0f} steps/s")
    print(f"VectorKickEnv, two threads   {two_threads(share):11.2f} times one")
    frames = rate(match(striker.MatchEnv()), max(1, int(400 * share)))
    print(f"MatchEnv                     {frames:11,.0f} frames/s, {frames * 0.05:.0f} times real time")
    try:
        import gymnasium
    except ImportError:
        return
    steps = rate(single(gymnasium.make("CartPole-v1"), random.integers(2, size=1000).tolist()), int(100_000 * share))
    print(f"CartPole-v1 of gymnasium     {steps:11,.0f} steps/s")


if __name__ == "__main__":
    main()
