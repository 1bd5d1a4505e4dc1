// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/statistics/touches.hpp"

#include <cmath>
#include <cstddef>

#include "sil/match/record/statistics/sides.hpp"
#include "sil/match/referee/match_rules.hpp"

namespace striker::sil {
namespace {

constexpr int possession_ms = 3'000;
constexpr int longest_pass_ms = 3'000;
constexpr double shortest_pass_m = 0.3;

}  // namespace

void Touches::add(const RefereeFrame& seen, MatchFigures& figures) {
  const Vec2 ball = seen.ball.position_m;
  since_ms_ += frame_ms;
  way_m_ += std::hypot(ball.x - ball_.x, ball.y - ball_.y);
  ball_ = ball;
  if (seen.touching.any()) {
    const std::optional<Team> team = only_team_of(seen.touching);
    const bool is_another = (seen.touching & last_touch_).none();
    if (team && team == holder_ && is_another && since_ms_ <= longest_pass_ms && way_m_ > shortest_pass_m) {
      ++figures.teams[index_of(*team)].passes;
    }
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      figures.robots[robot].touches += seen.touching[robot] && !touching_[robot] ? 1 : 0;
    }
    last_touch_ = seen.touching;
    holder_ = team;
    since_ms_ = 0;
    way_m_ = 0.0;
  } else if (since_ms_ >= possession_ms) {
    holder_.reset();
  }
  touching_ = seen.touching;
  if (holder_) {
    figures.teams[index_of(*holder_)].possession_ms += frame_ms;
  }
}

}  // namespace striker::sil
