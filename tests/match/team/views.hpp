// SPDX-License-Identifier: Apache-2.0
// Views as a match shows them, and as no match does.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "sil/match/referee/formations.hpp"
#include "sil/match/team/strategy.hpp"
#include "sil/world/field_specs.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {

// All at home, the ball in the centre, open play.
inline TeamView home_view() {
  TeamView view;
  view.state = GameState::open_play;
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    view.own[id].pose = home_spot(id);
    view.opponents[id].pose = turned(home_spot(id));
  }
  return view;
}

inline TeamView mirrored(TeamView view) {
  const auto mirror = [](Pose& pose) {
    pose.y_m = -pose.y_m;
    pose.heading_rad = -pose.heading_rad;
  };
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    mirror(view.own[id].pose);
    mirror(view.opponents[id].pose);
  }
  view.ball_m.y = -view.ball_m.y;
  return view;
}

// A match in which everybody drifts about, and now and then is somewhere else; a stop every few seconds.
class RandomViews {
 public:
  explicit RandomViews(std::uint64_t seed) : random_(seed, 0, 0) {
    view_ = home_view();
    begin(true);
  }

  const TeamView& next() {
    view_.clock_ms += 50;
    const bool stop = random_.below(60) == 0;
    view_.reset_reason = stop ? static_cast<ResetReason>(5 + random_.below(4)) : ResetReason::none;
    if (stop) {
      begin(false);
    } else if (random_.below(20) == 0) {
      view_.state = GameState::open_play;
      view_.has_ball = false;
    }
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      move(view_.own[id]);
      move(view_.opponents[id]);
    }
    velocity_.x = 0.99 * velocity_.x + random_.uniform(-0.02, 0.02);
    velocity_.y = 0.99 * velocity_.y + random_.uniform(-0.02, 0.02);
    view_.ball_m.x = std::remainder(view_.ball_m.x + velocity_.x, 2.0 * field_half_length_m);
    view_.ball_m.y = std::remainder(view_.ball_m.y + velocity_.y, 2.0 * field_half_width_m);
    if (random_.below(30) == 0) {  // beside a robot
      const Pose& robot = view_.own[random_.below(robots_a_team)].pose;
      view_.ball_m = {robot.x_m + random_.uniform(-0.3, 0.3), robot.y_m + random_.uniform(-0.3, 0.3)};
    }
    return view_;
  }

  // The same with numbers that are none, or far too large, here and there.
  TeamView next_broken() {
    TeamView view = next();
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      for (Pose* pose : {&view.own[id].pose, &view.opponents[id].pose}) {
        for (double* value : {&pose->x_m, &pose->y_m, &pose->heading_rad}) {
          break_maybe(*value);
        }
      }
    }
    for (double* value : {&view.ball_m.x, &view.ball_m.y, &view.ball_height_m}) {
      break_maybe(*value);
    }
    return view;
  }

 private:
  void begin(bool anyhow) {
    constexpr GameState states[] = {GameState::kickoff, GameState::goal_kick, GameState::corner,
                                    GameState::penalty, GameState::open_play};
    view_.state = anyhow ? GameState::open_play : states[random_.below(5)];
    view_.has_ball = view_.state != GameState::open_play && random_.below(2) == 0;
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      view_.own[id].pose = anywhere();
      view_.opponents[id].pose = anywhere();
    }
    const Pose ball = anywhere();
    view_.ball_m = {ball.x_m, ball.y_m};
    velocity_ = {random_.uniform(-0.1, 0.1), random_.uniform(-0.1, 0.1)};
  }

  Pose anywhere() {
    const double x_m = random_.uniform(-4.2, 4.2);
    const double y_m = random_.uniform(-field_half_width_m, field_half_width_m);
    return {x_m, y_m, random_.uniform(-std::numbers::pi, std::numbers::pi)};
  }

  void move(RobotView& robot) {
    if (random_.below(100) == 0) {
      robot.pose = anywhere();
    }
    robot.pose.x_m += random_.uniform(-0.1, 0.1);
    robot.pose.y_m += random_.uniform(-0.1, 0.1);
    robot.pose.heading_rad =
        std::remainder(robot.pose.heading_rad + random_.uniform(-0.5, 0.5), 2.0 * std::numbers::pi);
    robot.active = random_.below(8) != 0;
    robot.touching = random_.below(8) == 0;
  }

  void break_maybe(double& value) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double odd[] = {
        std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, 1e308, -1e308, 1e-308};
    if (random_.below(40) == 0) {
      value = odd[random_.below(6)];
    }
  }

  Random random_;
  TeamView view_;
  Vec2 velocity_;
};

}  // namespace striker::sil
