// SPDX-License-Identifier: Apache-2.0
// A match as its records see it: what holds all along, then one frame every 50 ms of simulated time, pauses included,
// then how it ended. All places are in the field frame (referee_frame.hpp), all units SI but where a name says so.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware/core/state.hpp"
#include "sil/match/referee/match_rules.hpp"
#include "sil/match/referee/referee_frame.hpp"
#include "sil/match/referee/ruling.hpp"
#include "sil/match/team/order.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

struct MatchHeader {
  std::array<std::string, 2> teams;  // by name, red's and blue's
  std::uint64_t seed = 1;
  MatchRules rules;
  std::string rule_set;  // "official" or "published"
  std::string plant;     // "servo" or "drive"
  double slip = 0.0;     // share, of each wheel's speed
  double jitter_m = 0.0;
  double jitter_rad = 0.0;
  std::string faults;  // a plan of what goes wrong (sil/fault), as its TOML text; empty: nothing
  // What each team plays with, as the 8 hexadecimal digits of a policy; empty: nothing but itself.
  std::array<std::string, 2> identities = {};
};

inline constexpr double standing_height_m = (robot_bottom_m + robot_top_m) / 2.0;

// Of one robot and its controller, at the frame's end.
struct RobotRecord {
  Vec2 velocity_m_s;
  double turn_rate_rad_s = 0.0;
  std::array<double, 2> rim_speeds_m_s = {};  // left, right, measured
  std::array<double, 2> set_points_m_s = {};  // of the controller's last command
  double up = 1.0;                            // the vertical share of the robot's up vector
  double height_m = standing_height_m;        // of the body's centre above the floor
  core::State state = core::State::standby;   // by its last status
  core::Fault fault = core::Fault::none;
  int status_age_ms = 0;            // since its last status came; since the match began, if none came
  std::optional<int> order_age_ms;  // since its last order came; none: it never had one
  int lost_frames = 0;              // on its bus, in this frame: lost, late or altered on the way
  int saturated_ticks = 0;          // of the frame's: a wheel was told its torque limit
};

// Valid during the call that shows it.
struct MatchFrame {
  std::int64_t number = 0;  // 0 is the opening; number * 50 ms is simulated time
  const RefereeFrame& seen;
  const Ruling& ruling;  // by this frame
  std::array<double, 3> ball_velocity_m_s = {};
  std::span<const RobotRecord, robots_in_match> robots;
  // What the teams were shown after this frame's placements, and answered: red's and blue's, each in its own frame. None
  // while they were not asked.
  std::array<std::optional<TeamOrders>, 2> orders;
};

struct MatchEnd {
  bool complete = false;  // false: interrupted
  std::uint64_t state_hash = 0;
};

// Every record of a match is one: it is shown the header, each frame, and the end. A record that fails throws.
class MatchObserver {
 public:
  virtual ~MatchObserver() = default;
  virtual void begin(const MatchHeader& /*header*/) {}
  virtual void frame(const MatchFrame& /*frame*/) {}
  virtual void end(const MatchEnd& /*end*/) {}
};

}  // namespace striker::sil
