// SPDX-License-Identifier: Apache-2.0
// The replay buffer: a ring of transitions that forgets the oldest, and what folds n steps into one
// transition for it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "training/learner/column_ring.hpp"
#include "training/task/state.hpp"

namespace striker::training {

// One step, or n steps folded into one: the target is reward + discount * (the value of `next`).
struct Transition {
  Features state;
  int action = 0;
  float reward = 0.0F;
  Features next;
  float discount = 0.0F;  // gamma^n; 0 where the episode ended, but by its time limit
};

// A column: state, next, reward, discount, action.
class ReplayBuffer : public ColumnRing {
 public:
  ReplayBuffer(Eigen::Index inputs, Eigen::Index capacity)
      : ColumnRing(2 * inputs + 3, capacity), inputs_(inputs) {}

  // Returns the transition's place.
  Eigen::Index push(const Transition& transition) {
    const Eigen::Index place = claim();
    column(place) << transition.state, transition.next, transition.reward, transition.discount,
        static_cast<float>(transition.action);
    return place;
  }

  [[nodiscard]] auto state(Eigen::Index place) const { return columns().col(place).head(inputs_); }
  [[nodiscard]] auto next(Eigen::Index place) const { return columns().col(place).segment(inputs_, inputs_); }
  [[nodiscard]] float reward(Eigen::Index place) const { return columns()(2 * inputs_, place); }
  [[nodiscard]] float discount(Eigen::Index place) const { return columns()(2 * inputs_ + 1, place); }
  [[nodiscard]] int action(Eigen::Index place) const {
    return static_cast<int>(columns()(2 * inputs_ + 2, place));
  }

 private:
  Eigen::Index inputs_;
};

// Folds n steps into one transition: r_0 + gamma r_1 + ... + gamma^n max Q(s_n). n = 1 is the paper's.
class NStep {
 public:
  NStep(int n, double gamma, Eigen::Index inputs) : gamma_(static_cast<float>(gamma)) {
    open_.resize(static_cast<std::size_t>(n), {.state = Features(inputs), .next = Features(inputs)});
  }

  // Hands every transition that is complete to `push`; at an episode's end that is all of them. `truncated`: it ended
  // in a state that still has a value.
  template <class Push>
  void take(const Features& state, int action, double reward, const Features& next, bool end, Push push,
            bool truncated = false) {
    Transition& opened = open_[(first_ + count_) % open_.size()];
    opened.state = state;
    opened.action = action;
    opened.reward = 0.0F;
    opened.discount = 1.0F;
    ++count_;
    for (std::size_t i = 0; i < count_; ++i) {
      Transition& transition = open_[(first_ + i) % open_.size()];
      transition.reward += transition.discount * static_cast<float>(reward);
      transition.discount = end && !truncated ? 0.0F : transition.discount * gamma_;
    }
    while (count_ == open_.size() || (end && count_ > 0)) {
      hand_over(next, push);
    }
  }

  // Hands over all that is open, ended at this state.
  template <class Push>
  void cut(const Features& state, Push push) {
    while (count_ > 0) {
      hand_over(state, push);
    }
  }

 private:
  template <class Push>
  void hand_over(const Features& next, Push push) {
    open_[first_].next = next;
    push(open_[first_]);
    first_ = (first_ + 1) % open_.size();
    --count_;
  }

  float gamma_;
  std::vector<Transition> open_;  // a ring, the oldest at first_
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace striker::training
