// The replay memory: a ring that forgets the oldest, and what folds n steps into one transition for it.
#pragma once

#include <cstddef>
#include <vector>

#include "state.hpp"

namespace striker::training {

// One step, or n steps folded into one: y = reward + discount * (the value of `next`).
struct Transition {
  Features state;
  int action = 0;
  float reward = 0.0F;
  Features next;
  float discount = 0.0F;  // gamma^n; 0 where the episode ended
};

class Replay {
 public:
  explicit Replay(std::size_t capacity) : ring_(capacity) {}

  void push(const Transition& transition) {
    ring_[pushed_ % ring_.size()] = transition;
    ++pushed_;
  }
  [[nodiscard]] std::size_t size() const { return pushed_ < ring_.size() ? pushed_ : ring_.size(); }
  [[nodiscard]] const Transition& operator[](std::size_t i) const { return ring_[i]; }

 private:
  std::vector<Transition> ring_;
  std::size_t pushed_ = 0;
};

// Folds n steps into one transition: r_0 + gamma r_1 + ... + gamma^n max Q(s_n). n = 1 is the paper's.
class StepFolder {
 public:
  StepFolder(int n, double gamma) : n_(static_cast<std::size_t>(n)), gamma_(static_cast<float>(gamma)) {
    open_.reserve(n_);
  }

  void take(const Features& state, int action, double reward, const Features& next, bool end,
            Replay& replay) {
    open_.push_back({.state = state, .action = action, .reward = 0.0F, .next = next, .discount = 1.0F});
    for (Transition& transition : open_) {
      transition.reward += transition.discount * static_cast<float>(reward);
      transition.discount = end ? 0.0F : transition.discount * gamma_;
      transition.next = next;
    }
    while (open_.size() == n_ || (end && !open_.empty())) {
      replay.push(open_.front());
      open_.erase(open_.begin());
    }
  }

 private:
  std::size_t n_;
  float gamma_;
  std::vector<Transition> open_;  // the oldest first
};

}  // namespace striker::training
