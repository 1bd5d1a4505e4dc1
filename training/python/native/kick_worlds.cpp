// SPDX-License-Identifier: Apache-2.0
#include "training/python/native/kick_worlds.hpp"

#include <algorithm>
#include <numeric>

namespace striker::training {

KickWorlds::KickWorlds(const std::vector<TaskConfig>& tasks, int worlds, int threads, Autoreset autoreset)
    : outcomes_(static_cast<std::size_t>(worlds)),
      autoreset_(autoreset),
      crew_(std::min(threads, worlds)),
      ended_(static_cast<std::size_t>(crew_.size())) {
  players_.reserve(static_cast<std::size_t>(worlds));
  for (int world = 0; world < worlds; ++world) {
    players_.emplace_back(tasks);
  }
}

void KickWorlds::reset(std::uint64_t seed, std::uint64_t first, float* observations) {
  stride_ = players_.size();
  for (std::size_t world = 0; world < players_.size(); ++world) {
    players_[world].reset(seed, first + world);
    write_observation(world, observations);
  }
}

void KickWorlds::reset(const std::vector<std::uint64_t>& seeds, std::uint64_t first, float* observations) {
  stride_ = 1;
  for (std::size_t world = 0; world < players_.size(); ++world) {
    players_[world].reset(seeds[world], first);
    write_observation(world, observations);
  }
}

void KickWorlds::go_on(float* observations) {
  for (std::size_t world = 0; world < players_.size(); ++world) {
    players_[world].reset(players_[world].seed(), players_[world].episode() + stride_);
    write_observation(world, observations);
  }
}

int KickWorlds::step(const std::vector<int>& actions, const StepArrays& out) {
  const std::size_t parts = ended_.size();
  crew_.run([&](int part) {
    const auto at = static_cast<std::size_t>(part);
    int ended = 0;
    for (std::size_t world = at * players_.size() / parts; world < (at + 1) * players_.size() / parts;
         ++world) {
      ended += step_world(world, actions[world], out) ? 1 : 0;
    }
    ended_[at] = ended;
  });
  return std::accumulate(ended_.begin(), ended_.end(), 0);
}

bool KickWorlds::step_world(std::size_t world, int action, const StepArrays& out) {
  KickPlayer& player = players_[world];
  StepResult result;
  if (player.is_playing()) {
    result = player.step(action);
  } else {
    player.reset(player.seed(), player.episode() + stride_);
  }
  out.rewards[world] = result.reward;
  out.terminated[world] = result.end && !result.truncated;
  out.truncated[world] = result.truncated;
  if (out.records != nullptr) {
    std::ranges::copy(player.record(), out.records + world * record_fields.size());
  }
  if (result.end) {
    outcomes_[world] = player.now().outcome();
  }
  if (result.end && autoreset_ == Autoreset::same_step) {
    write_observation(world, out.final_observations);
    player.reset(player.seed(), player.episode() + stride_);
  }
  write_observation(world, out.observations);
  return result.end;
}

void KickWorlds::write_observation(std::size_t world, float* observations) const {
  if (observations != nullptr) {
    const Features& features = players_[world].now().features();
    std::copy(features.data(), features.data() + features.size(),
              observations + world * static_cast<std::size_t>(features.size()));
  }
}

void KickWorlds::restore(int world, std::uint64_t seed, std::uint64_t episode,
                         const std::vector<std::uint8_t>& actions) {
  KickPlayer& player = players_[static_cast<std::size_t>(world)];
  player.reset(seed, episode);
  for (const std::uint8_t action : actions) {
    player.step(action);
  }
}

}  // namespace striker::training
