#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A reward of one's own: near the ball is good, and a contact with the front face better. What a record holds is in
help(striker.KickRecord).

    PYTHONPATH=build/python training/python/examples/custom_reward.py
"""

import math

import numpy
import striker


def near_the_ball(record):
    """Of one world: floats."""
    distance_m = math.hypot(record.ball_x_m, record.ball_y_m)
    return -0.01 * distance_m + 5.0 * (record.just_contact and record.front_face)


def near_the_ball_of_many(record):
    """Of many: arrays. A step that began an episode has decision 0 and is paid nothing."""
    distance_m = numpy.hypot(record.ball_x_m, record.ball_y_m)
    paid = -0.01 * distance_m + 5.0 * record.just_contact * record.front_face
    return numpy.where(record.decision > 0, paid, 0.0)


def main():
    env = striker.KickEnv(reward_function=near_the_ball)
    env.reset(seed=1)
    total, ended = 0.0, False
    while not ended:
        _, reward, terminated, truncated, info = env.step(0)
        total, ended = total + reward, terminated or truncated
    print(f"one world: {total:.3f}; the task itself would have paid {info['episode_reward']:.3f}")

    many = striker.VectorKickEnv(100, reward_function=near_the_ball_of_many)
    many.reset(seed=1)
    paid = sum(many.step(numpy.zeros(100, int))[1].mean() for _ in range(41))
    print(f"100 worlds: {paid:.3f} on the average over 41 steps")


if __name__ == "__main__":
    main()
