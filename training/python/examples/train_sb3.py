#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Stable-Baselines3's DQN on the kick, to a model that striker-evaluate, striker-export and striker-sil kick --policy take.
Where stable_baselines3 is not installed it says so; train_dqn.py needs PyTorch alone.

    PYTHONPATH=build/python training/python/examples/train_sb3.py -o sb3.safetensors
"""

import argparse
import sys

import striker

try:
    from stable_baselines3 import DQN
    from stable_baselines3.common.evaluation import evaluate_policy
except ImportError as error:
    sys.exit(f"train_sb3.py: {error}; install stable-baselines3, or use train_dqn.py")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", required=True, help="the model to write, .safetensors")
    parser.add_argument("--steps", type=int, default=300_000, help="decisions to learn from, in all")
    parser.add_argument("--episodes", type=int, default=200, help="held-out episodes to judge it by")
    arguments = parser.parse_args()

    env = striker.KickEnv()
    learner = DQN("MlpPolicy", env, learning_rate=1e-3, gamma=0.95, buffer_size=200_000, learning_starts=1000, train_freq=8,
                  gradient_steps=1, batch_size=256, target_update_interval=8000, exploration_fraction=0.25,
                  policy_kwargs={"net_arch": [64, 64]}, seed=1, device="cpu")
    learner.learn(arguments.steps)
    # Its names begin with q_net and q_net_target: the second is left out.
    striker.export(learner.policy.state_dict(), arguments.output, env=env)
    judge = striker.KickEnv()
    judge.reset(seed=1000)
    mean, _ = evaluate_policy(learner, judge, n_eval_episodes=arguments.episodes, warn=False)
    print(f"{arguments.output}: mean reward {mean:.3f} over {arguments.episodes} held-out episodes of the fast world")


if __name__ == "__main__":
    main()
