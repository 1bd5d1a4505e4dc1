#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A plain deep Q network in PyTorch, over many worlds at once: the paper's learner in a page. Writes a model that
striker-evaluate, striker-export and striker-sil kick --policy take.

    PYTHONPATH=build/python training/python/examples/train_dqn.py -o dqn.safetensors
"""

import argparse

import numpy
import striker
import torch

WORLDS = 32
BATCH = 256
GAMMA = 0.95


class Replay:
    """The last transitions, in arrays."""

    def __init__(self, size, inputs):
        self.states, self.next_states = (torch.zeros(size, inputs) for _ in range(2))
        self.actions, self.rewards, self.goes_on = torch.zeros(size, dtype=torch.long), torch.zeros(size), torch.zeros(size)
        self.size, self.count = size, 0

    def add(self, states, actions, rewards, next_states, ends):
        at = torch.arange(self.count, self.count + len(states)) % self.size
        for store, values in ((self.states, states), (self.actions, actions), (self.rewards, rewards),
                              (self.next_states, next_states), (self.goes_on, ~ends)):
            store[at] = torch.as_tensor(values).to(store.dtype)
        self.count += len(states)

    def sample(self, generator):
        at = torch.randint(min(self.count, self.size), (BATCH,), generator=generator)
        return self.states[at], self.actions[at], self.rewards[at], self.next_states[at], self.goes_on[at]


def network(inputs, actions):
    return torch.nn.Sequential(torch.nn.Linear(inputs, 64), torch.nn.ReLU(), torch.nn.Linear(64, 64), torch.nn.ReLU(),
                               torch.nn.Linear(64, actions))


def learn(online, target, optimiser, transitions):
    states, actions, rewards, next_states, goes_on = transitions
    with torch.no_grad():
        wanted = rewards + GAMMA * goes_on * target(next_states).max(1).values
    values = online(states).gather(1, actions[:, None])[:, 0]
    loss = torch.nn.functional.mse_loss(values, wanted)
    optimiser.zero_grad()
    loss.backward()
    optimiser.step()


def greedy_mean(env, online, episodes, seed):
    """Over the first episodes of a seed, as striker-evaluate --world fast counts them."""
    rewards, numbers = {}, numpy.arange(env.num_envs)
    observations, _ = env.reset(seed=seed)
    while min(numbers) < episodes:
        with torch.no_grad():
            actions = online(torch.from_numpy(observations)).argmax(1).numpy()
        observations, _, terminated, truncated, infos = env.step(actions)
        for world in numpy.flatnonzero(terminated | truncated):
            rewards[numbers[world]] = infos["episode_reward"][world]
            numbers[world] += env.num_envs
    return sum(rewards[number] for number in range(episodes)) / episodes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", required=True, help="the model to write, .safetensors")
    parser.add_argument("--steps", type=int, default=400_000, help="decisions to learn from, in all")
    parser.add_argument("--episodes", type=int, default=1000, help="held-out episodes to judge it by")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()

    torch.set_num_threads(1)
    torch.manual_seed(arguments.seed)
    generator, random = torch.Generator().manual_seed(arguments.seed), numpy.random.default_rng(arguments.seed)
    # Same-step resets: what follows an action is never another episode's begin, but for the ends, which are told apart.
    env = striker.VectorKickEnv(WORLDS, autoreset_mode="same_step")
    inputs, actions = env.single_observation_space.shape[0], env.single_action_space.n
    online, target = network(inputs, actions), network(inputs, actions)
    target.load_state_dict(online.state_dict())
    optimiser = torch.optim.Adam(online.parameters(), lr=1e-3)
    replay = Replay(200_000, inputs)
    observations, _ = env.reset(seed=arguments.seed, options={"episode": striker.FIRST_TRAINING_EPISODE})
    rounds = arguments.steps // WORLDS
    for number in range(rounds):
        with torch.no_grad():
            chosen = online(torch.from_numpy(observations)).argmax(1).numpy()
        epsilon = max(0.05, 1.0 - 4.0 * number / rounds)
        chosen = numpy.where(random.random(WORLDS) < epsilon, random.integers(actions, size=WORLDS), chosen)
        following, rewards, terminated, truncated, _ = env.step(chosen)
        # Nothing is worth anything after decision 40, as the task pays: both ends are one to the learner.
        replay.add(observations, chosen, rewards, following, terminated | truncated)
        observations = following
        if replay.count >= 1000:
            for _ in range(2):
                learn(online, target, optimiser, replay.sample(generator))
        if number % 250 == 0:
            target.load_state_dict(online.state_dict())
    striker.export(online.state_dict(), arguments.output, env=env)
    mean = greedy_mean(striker.VectorKickEnv(100), online, arguments.episodes, seed=1000)
    print(f"{arguments.output}: mean reward {mean:.3f} over {arguments.episodes} held-out episodes of the fast world")


if __name__ == "__main__":
    main()
