// The learner: a deep Q network (Mnih et al. 2015) as in the paper, with the options of the configuration.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "config.hpp"
#include "network.hpp"

namespace striker::training {

// The moving average that the paper draws, in episodes.
inline constexpr int moving_average_span = 250;

// A row of the learning curve.
struct EpisodeRow {
  int episode = 0;
  int steps = 0;  // decisions until the contact, or 40
  double reward = 0.0;
  double moving_average = 0.0;  // of the reward, over the last 250 episodes or all so far
  bool contact = false;
  double epsilon = 0.0;
  double loss = 0.0;  // the mean over the episode's gradient steps, 0 if there were none
};

struct Training {
  Parameters parameters;
  std::vector<EpisodeRow> rows;
  std::int64_t decisions = 0;
  std::int64_t gradient_steps = 0;
};

// Called after each episode; false ends the training there.
using Progress = std::function<bool(const EpisodeRow&)>;

// A pure function of the configuration and the seed, on one type of machine.
[[nodiscard]] Training train(const Config& config, std::uint64_t seed, const Progress& progress);

// The weights that a training begins with: uniform, He et al. 2015; biases 0.
[[nodiscard]] Parameters initial_parameters(std::uint64_t seed);

// The mean reward of greedy play on `episodes` episodes that neither training nor evaluation meets.
[[nodiscard]] double validate(const Config& config, const Parameters& parameters, std::uint64_t seed);

}  // namespace striker::training
