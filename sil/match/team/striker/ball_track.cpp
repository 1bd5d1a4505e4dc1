// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/striker/ball_track.hpp"

#include <cmath>

#include "sil/match/referee/match_rules.hpp"
#include "sil/world/field_specs.hpp"
#include "sil/world/physics_constants.hpp"

namespace striker::sil {

namespace {

constexpr double frame_s = frame_ms / 1000.0;
constexpr double kept_at_a_wall = 0.75;  // of the speed into it (AI World Cup test_world 37312a93)
constexpr double wall_x_m = field_half_length_m - ball_radius_m;
constexpr double wall_y_m = field_half_width_m - ball_radius_m;

// What would be beyond a wall is as far, but for the speed that the wall takes, before it.
double off_wall(double place_m, double wall_m) {
  const double beyond_m = std::abs(place_m) - wall_m;
  return beyond_m > 0.0 ? std::copysign(wall_m - kept_at_a_wall * beyond_m, place_m) : place_m;
}

}  // namespace

void BallTrack::see(const TeamView& view) {
  const bool is_known = ball_ && view.reset_reason == ResetReason::none;
  velocity_m_s_ =
      is_known ? Vec2{(view.ball_m.x - ball_->x) / frame_s, (view.ball_m.y - ball_->y) / frame_s} : Vec2{};
  ball_ = view.ball_m;
}

Vec2 BallTrack::in(double seconds) const {
  const double rolled_s = (1.0 - std::exp(-damping_per_s * seconds)) / damping_per_s;
  Vec2 place = {now().x + velocity_m_s_.x * rolled_s, now().y + velocity_m_s_.y * rolled_s};
  place.y = off_wall(place.y, wall_y_m);
  if (std::abs(place.y) > goal_half_width_m) {
    place.x = off_wall(place.x, wall_x_m);
  }
  return place;
}

}  // namespace striker::sil
