// SPDX-License-Identifier: Apache-2.0
// The rival: the same gradient step as users of libtorch write it. One thread, as this trainer.
#include <benchmark/benchmark.h>
#include <torch/torch.h>

namespace {

constexpr int batch = 64;
constexpr int held = 200'000;

torch::nn::Sequential network() {
  return torch::nn::Sequential(torch::nn::Linear(6, 64), torch::nn::ReLU(), torch::nn::Linear(64, 64),
                               torch::nn::ReLU(), torch::nn::Linear(64, 3));
}

void torch_gradient_step(benchmark::State& state) {
  torch::set_num_threads(1);
  torch::manual_seed(1);
  torch::nn::Sequential online = network();
  torch::nn::Sequential target = network();
  torch::optim::Adam adam(online->parameters(), torch::optim::AdamOptions(1e-3));
  const auto states = torch::rand({held, 6}) * 2 - 1;
  const auto next = torch::rand({held, 6}) * 2 - 1;
  const auto rewards = torch::rand({held}) * 2 - 1;
  const auto discounts = torch::full({held}, 0.95F);
  const auto actions = torch::randint(3, {held, 1});
  int steps = 0;
  for (auto unused : state) {
    const auto places = torch::randint(held, {batch});
    torch::Tensor wanted;
    {
      const torch::NoGradGuard no_gradient;
      const auto best = std::get<0>(target->forward(next.index_select(0, places)).max(1));
      wanted = rewards.index_select(0, places) + discounts.index_select(0, places) * best;
    }
    const auto q = online->forward(states.index_select(0, places));
    const auto taken = q.gather(1, actions.index_select(0, places)).squeeze(1);
    const auto loss = torch::mse_loss(taken, wanted);
    adam.zero_grad();
    loss.backward();
    adam.step();
    if (++steps % 1000 == 0) {
      const torch::NoGradGuard no_gradient;
      for (std::size_t i = 0; i < online->parameters().size(); ++i) {
        target->parameters()[i].copy_(online->parameters()[i]);
      }
    }
  }
}

BENCHMARK(torch_gradient_step);

}  // namespace
