#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A deep Q network as CleanRL writes one, in one file over Gymnasium's vector environments, with CleanRL's replay buffer; to a
model that striker-evaluate, striker-export and striker-sil kick --policy take. Where gymnasium, PyTorch or CleanRL is not
installed it says so; train_dqn.py needs PyTorch alone.

    PYTHONPATH=build/python training/python/examples/train_cleanrl.py -o cleanrl.safetensors
"""

import argparse
import sys

import numpy
import striker

try:
    import gymnasium
    import torch
    from cleanrl_utils.buffers import ReplayBuffer
except ImportError as error:
    sys.exit(f"train_cleanrl.py: {error}; install gymnasium, PyTorch and CleanRL, or use train_dqn.py")


class QNetwork(torch.nn.Module):
    def __init__(self, envs):
        super().__init__()
        # Three hidden layers: one to three are served.
        self.network = torch.nn.Sequential(
            torch.nn.Linear(envs.single_observation_space.shape[0], 64), torch.nn.ReLU(),
            torch.nn.Linear(64, 64), torch.nn.ReLU(),
            torch.nn.Linear(64, 32), torch.nn.ReLU(),
            torch.nn.Linear(32, envs.single_action_space.n))

    def forward(self, x):
        return self.network(x)


def linear_schedule(start, end, duration, t):
    return max((end - start) / duration * t + start, end)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", required=True, help="the model to write, .safetensors")
    parser.add_argument("--steps", type=int, default=400_000, help="decisions to learn from, in all")
    parser.add_argument("--worlds", type=int, default=32)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    torch.set_num_threads(1)
    torch.manual_seed(arguments.seed)
    numpy.random.seed(arguments.seed)

    envs = gymnasium.make_vec("Striker/Kick-v0", num_envs=arguments.worlds, vectorization_mode="vector_entry_point",
                              autoreset_mode="same_step")
    q_network, target_network = QNetwork(envs), QNetwork(envs)
    target_network.load_state_dict(q_network.state_dict())
    optimizer = torch.optim.Adam(q_network.parameters(), lr=1e-3)
    rb = ReplayBuffer(200_000, envs.single_observation_space, envs.single_action_space, "cpu", n_envs=arguments.worlds,
                      handle_timeout_termination=False)

    obs, _ = envs.reset(seed=arguments.seed, options={"episode": striker.FIRST_TRAINING_EPISODE})
    rounds = arguments.steps // arguments.worlds
    for step in range(rounds):
        random = numpy.random.random(arguments.worlds) < linear_schedule(1, 0.05, 0.25 * rounds, step)
        with torch.no_grad():
            greedy = q_network(torch.from_numpy(obs)).argmax(dim=1).numpy()
        actions = numpy.where(random, numpy.random.randint(envs.single_action_space.n, size=arguments.worlds), greedy)
        next_obs, rewards, terminations, truncations, infos = envs.step(actions)
        ends = terminations | truncations  # the task pays nothing after decision 40: both are one to the learner
        real_next_obs = next_obs.copy()
        if ends.any():
            real_next_obs[ends] = infos["final_obs"][ends]
        rb.add(obs, real_next_obs, actions, rewards, ends, infos)
        obs = next_obs
        if step * arguments.worlds < 1000:
            continue
        for _ in range(2):
            data = rb.sample(256)
            with torch.no_grad():
                best = target_network(data.next_observations).max(dim=1).values
                td_target = data.rewards.flatten() + 0.95 * best * (1 - data.dones.flatten())
            old_val = q_network(data.observations).gather(1, data.actions).squeeze()
            loss = torch.nn.functional.mse_loss(td_target, old_val)
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
        if step % 250 == 0:
            target_network.load_state_dict(q_network.state_dict())
    # Its names begin with network.
    striker.export(q_network.state_dict(), arguments.output, env=envs)
    print(f"{arguments.output}: learnt from {rounds * arguments.worlds} decisions")


if __name__ == "__main__":
    main()
