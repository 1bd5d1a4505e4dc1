// SPDX-License-Identifier: Apache-2.0
// When the learned kick pays: the robot stands with its front to the opponent's goal, and the ball will come past
// near enough, soon, and fast enough to be met as the kick was learned (sil/task/kick_task.hpp: a ball of 1 to 3 m/s that
// passes within 0.5 m, from 2 m away; the robot drives along its heading alone). Of forwards only: the learned motion drives at a
// forward's top speed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sil/match/team/order.hpp"
#include "sil/match/team/striker/situation.hpp"

namespace striker::sil {

// Whether to begin a kick now, as this robot stands.
[[nodiscard]] bool has_kick_chance(const Situation& now, std::size_t id);

// At most one kick at a time: begun at a chance, and over with the ball's touch, when the ball is gone, or after its 2 s.
class Kicks {
 public:
  // Who kicks in this frame, or nobody.
  [[nodiscard]] std::size_t kicker(const Situation& now);
  [[nodiscard]] MotionOrder order(const Situation& now) const;

 private:
  [[nodiscard]] bool goes_on(const Situation& now) const;

  std::size_t kicker_ = nobody;
  int frames_ = 0;
  int touched_frames_ = 0;
  std::uint8_t number_ = 0;  // of the last kick, whoever's
};

}  // namespace striker::sil
