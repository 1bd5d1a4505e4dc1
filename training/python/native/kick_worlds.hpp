// SPDX-License-Identifier: Apache-2.0
// Many worlds of the kick, stepped together into arrays that the caller owns.
//
// World i of a reset with one seed plays its episodes i, i + n, i + 2n, ...; with a seed a world, each its own episodes
// 0, 1, 2, ... . A world whose episode ended begins its next one: in the step that ended it (same_step), or in the step
// after, which takes no action and pays nothing (next_step, Gymnasium's own).
//
// Cost: 0.2 us a world and step on the plane, divided by the threads. No result depends on their number.
#pragma once

#include <cstdint>
#include <vector>

#include "training/python/native/crew.hpp"
#include "training/python/native/kick_player.hpp"

namespace striker::training {

enum class Autoreset { next_step, same_step };

// Of every world, one after another; none is null but `records` and `final_observations`, which may be.
struct StepArrays {
  float* observations = nullptr;  // `inputs` a world
  double* rewards = nullptr;
  bool* terminated = nullptr;
  bool* truncated = nullptr;
  double* records = nullptr;            // record_fields.size() a world
  float* final_observations = nullptr;  // of worlds that ended: what their last decision saw
};

class KickWorlds {
 public:
  KickWorlds(const std::vector<TaskConfig>& tasks, int worlds, int threads, Autoreset autoreset);

  [[nodiscard]] int size() const { return static_cast<int>(players_.size()); }
  [[nodiscard]] int inputs() const { return static_cast<int>(players_.front().now().features().size()); }
  [[nodiscard]] int actions() const {
    return static_cast<int>(players_.front().now().config().actions.size());
  }

  // Episodes first, first + 1, ... of one seed, and then so many further.
  void reset(std::uint64_t seed, std::uint64_t first, float* observations);
  // One seed a world, its episode `first` and those after it.
  void reset(const std::vector<std::uint64_t>& seeds, std::uint64_t first, float* observations);
  // Every world its next episode, after a reset.
  void go_on(float* observations);
  // `actions` holds one of the task's a world. How many worlds ended their episode.
  int step(const std::vector<int>& actions, const StepArrays& out);

  // Of the episode that ended last.
  [[nodiscard]] const sil::KickOutcome& outcome(int world) const {
    return outcomes_[static_cast<std::size_t>(world)];
  }
  [[nodiscard]] const KickPlayer& player(int world) const {
    return players_[static_cast<std::size_t>(world)];
  }
  // To the state of a copy (KickPlayer): its episode, and the actions played in it.
  void restore(int world, std::uint64_t seed, std::uint64_t episode,
               const std::vector<std::uint8_t>& actions);
  // How far apart a world's episodes are.
  void set_stride(std::uint64_t stride) { stride_ = stride; }
  [[nodiscard]] std::uint64_t stride() const { return stride_; }

 private:
  bool step_world(std::size_t world, int action, const StepArrays& out);
  void write_observation(std::size_t world, float* observations) const;

  std::vector<KickPlayer> players_;
  std::vector<sil::KickOutcome> outcomes_;
  std::uint64_t stride_ = 1;
  Autoreset autoreset_;
  Crew crew_;
  std::vector<int> ended_;  // a thread
};

}  // namespace striker::training
