// SPDX-License-Identifier: Apache-2.0
// What training costs: decisions of both worlds, and a gradient step of this trainer; beside it libtorch's,
// if it is there (torch_step.cpp). tools/bench-training runs it with the repetitions interleaved and prints
// the ratios.
#include <benchmark/benchmark.h>

#include "training/learner/dqn.hpp"
#include "training/run/training_run.hpp"

namespace striker::training {
namespace {

// Random play up to the contact, as a learner meets it, observation included.
void decisions(benchmark::State& state, Physics physics) {
  KickEnvironment env({.physics = physics});
  sil::Random random(1, 0, 0);
  std::uint64_t episode = 0;
  bool end = true;
  for (auto unused : state) {
    if (end) {
      env.reset(1, episode++);
    }
    end = env.step(static_cast<int>(random.below(3))).end;
    benchmark::DoNotOptimize(env.features().data());
  }
}

void fast_world(benchmark::State& state) {
  decisions(state, Physics::planar);
}
void full_world(benchmark::State& state) {
  decisions(state, Physics::full);
}

// The paper's step: 6-64-64-3, batch 64, Adam, target network, samples drawn from a full replay buffer.
void gradient_step(benchmark::State& state) {
  const Config config = parse_config("", "paper.toml");
  Learner learner(setup_of(config), 1);
  sil::Random random(1, 0, 0);
  Features from(config.shape.inputs);
  Features to(config.shape.inputs);
  for (int i = 0; i < config.learner.replay_size; ++i) {
    for (Eigen::Index k = 0; k < from.size(); ++k) {
      from[k] = static_cast<float>(random.uniform(-1.0, 1.0));
      to[k] = static_cast<float>(random.uniform(-1.0, 1.0));
    }
    learner.remember(from, static_cast<int>(random.below(3)), random.uniform(-1.0, 1.0), to, i % 30 == 0);
  }
  EpisodeRow row{.learning_rate = 1e-3};
  for (auto unused : state) {
    learner.learn(row);
  }
}

BENCHMARK(fast_world);
BENCHMARK(full_world);
BENCHMARK(gradient_step);

}  // namespace
}  // namespace striker::training

BENCHMARK_MAIN();
