// SPDX-License-Identifier: Apache-2.0
// What a viewer is shown of a run: a plain value, so that the loop does no more than copy it. Frames lie here as they were on
// the bus; whoever shows them unpacks them (state_json.hpp), in a thread of his own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/can/messages.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "sil/match/referee/ruling.hpp"
#include "sil/view/command.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

// The message table's messages in its order, then one place for all others.
inline constexpr std::size_t message_kinds = std::tuple_size_v<can::Messages>;

struct SeenMessage {
  std::uint32_t count = 0;  // since the run began
  can::Frame last = {};
};

// As they were on the bus: WheelCommand and WheelState.
struct WheelSample {
  std::uint32_t tick = 0;
  can::Frame command = {};
  can::Frame state = {};
};

inline constexpr std::uint32_t ticks_a_wheel_sample = 5;
inline constexpr std::size_t kept_wheel_samples = 20;  // so 100 ms; a state is shown every 33 ms of wall time

struct LiveRobot {
  Pose pose = {};
  Vec2 velocity_m_s = {};
  std::array<SeenMessage, message_kinds + 1> messages = {};
  std::array<WheelSample, kept_wheel_samples> wheels = {};  // a ring
  std::uint32_t wheel_samples = 0;                          // that were ever put into it
  // What the built-in network read in its last decision, where the controller is in this process.
  std::optional<loop::BuiltInPilot::Inputs> inputs = {};
};

struct LiveMatch {
  std::array<int, 2> score = {};
  int half = 1;
  int clock_ms = 0;
  GameState state = GameState::pause;
  std::optional<Team> owner = {};
  RobotSet touching = {};
  RobotSet sent_out = {};
};

// A line for the viewer, cut where it is too long; another number is another line.
struct LiveNote {
  std::uint32_t number = 0;
  std::array<char, 120> text = {};
};

struct LiveState {
  std::uint32_t run = 0;  // counts restarts
  std::uint64_t seed = 0;
  std::uint32_t tick = 0;
  std::uint64_t episode = 0;
  bool deciding = false;
  std::optional<Pose> target = {};     // of a kick: it lies ahead of this pose
  std::optional<Vec2> contact_m = {};  // where the ball was first touched in this episode
  BallState ball = {};
  std::size_t robot_count = 0;
  std::array<LiveRobot, most_viewed_robots> robots = {};
  std::optional<LiveMatch> match = {};
  bool paused = false;
  double speed = 1.0;                // times real time; 0: as fast as it goes
  std::int64_t lateness_max_us = 0;  // of ticks against this speed, since the state before
  LiveNote note = {};
};

}  // namespace striker::sil
