// SPDX-License-Identifier: Apache-2.0
// Many plays at once, so that the network is asked about many situations at a time: a matrix product costs a tenth of
// as many products by a vector.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "training/learner/network.hpp"
#include "training/line/line_episode.hpp"

namespace striker::training {

// A robot in an episode. What it points to outlives it.
struct LinePlay {
  const LineKick* kick = nullptr;
  const LineEpisode* episode = nullptr;
  LineRobot robot;
};

// One thread uses one.
class GreedyPlays {
 public:
  explicit GreedyPlays(const Shape& shape)
      : features_(shape.inputs, most_at_once), pass_(shape, most_at_once) {}

  // Calls each(play, features, q) for those of `plays` that `active` numbers, in its order, each with what the network
  // makes of it; drops those from `active` for which it returns false.
  template <class Each>
  void ask(const Parameters& network, std::span<LinePlay> plays, std::vector<std::uint32_t>& active,
           Each each);

  // Plays all to their ends by the network.
  void finish(const Parameters& network, std::span<LinePlay> plays);

 private:
  static constexpr int most_at_once = 1024;

  Eigen::MatrixXf features_;
  Pass pass_;
};

template <class Each>
void GreedyPlays::ask(const Parameters& network, std::span<LinePlay> plays,
                      std::vector<std::uint32_t>& active, Each each) {
  std::size_t kept = 0;
  for (std::size_t first = 0; first < active.size(); first += most_at_once) {
    const std::size_t count = std::min<std::size_t>(most_at_once, active.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const LinePlay& play = plays[active[first + i]];
      play.kick->look(*play.episode, play.robot, features_.col(static_cast<Eigen::Index>(i)));
    }
    forward(network, features_.leftCols(static_cast<Eigen::Index>(count)), pass_);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t number = active[first + i];
      const auto column = static_cast<Eigen::Index>(i);
      if (each(number, features_.col(column), pass_.q.col(column))) {
        active[kept++] = number;
      }
    }
  }
  active.resize(kept);
}

}  // namespace striker::training
