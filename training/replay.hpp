// The replay memory: a ring that forgets the oldest.
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

}  // namespace striker::training
