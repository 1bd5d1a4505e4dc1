// SPDX-License-Identifier: Apache-2.0
// Where the ball will be: its velocity from two frames, its way with damping and off the walls. What players do to it is not
// foreseen.
#pragma once

#include <optional>

#include "sil/match/team/team_view.hpp"

namespace striker::sil {

class BallTrack {
 public:
  // Once a frame. After a stop the ball is taken to be at rest.
  void see(const TeamView& view);

  [[nodiscard]] Vec2 now() const { return ball_.value_or(Vec2{}); }
  [[nodiscard]] Vec2 velocity_m_s() const { return velocity_m_s_; }
  [[nodiscard]] Vec2 in(double seconds) const;

 private:
  std::optional<Vec2> ball_;
  Vec2 velocity_m_s_;
};

}  // namespace striker::sil
