// SPDX-License-Identifier: Apache-2.0
// Who leads an episode to where a network's own play would not go: it begins with the actions of the best sequence that the
// exact search finds, up to a random decision before the contact. What is met on the way is labelled with own play, as
// everything is; so the network learns the end of a play that it could not begin, and then what comes before it (Florensa et
// al. 2017, who begin near the goal).
//
//   Guide guide(task);
//   const Guidance led = guide.lead(seed, number, random);
//   // plays led.actions[0] to led.actions[led.decisions - 1], then goes on alone
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sil/world/random.hpp"
#include "training/search/ceiling.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// How an episode begins; on its own where no contact is possible.
struct Guidance {
  ActionSequence actions{};
  int decisions = 0;  // so many of them
};

// One thread uses one.
class Guide {
 public:
  // The task fits.
  explicit Guide(const TaskConfig& task);

  // Why nothing can be searched in a task: "KEY: what it must be"; empty if it can be.
  [[nodiscard]] static std::string unfit(const TaskConfig& task);

  // In the nominal episode. A search takes some milliseconds.
  [[nodiscard]] Guidance lead(std::uint64_t seed, std::uint64_t number, sil::Random& random);

 private:
  sil::PoseMode pose_;
  sil::KickRules rules_;
  std::shared_ptr<const Reachable> reachable_;  // the search points to it, wherever the guide is moved
  CeilingSearch search_;
};

}  // namespace striker::training
