// SPDX-License-Identifier: Apache-2.0
// A controller's node whose team orders something every 50 ticks, or is silent; and what the robot then does.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <variant>

#include "firmware/can/messages/team.hpp"
#include "tests/loop/bench/node_rig.hpp"

namespace striker::loop {

using SentOrder = std::variant<can::WheelOrder, can::MotionOrder>;

class TeamRig : public NodeRig {
 public:
  std::optional<SentOrder> order;  // that goes out whenever it is time
  std::uint32_t phase_ticks = 0;   // of the orders' 50
  can::Status status;              // the last one
  std::uint32_t decisions = 0;     // Decision frames

  can::Frame next_frame() {
    return std::visit([&](const auto& said) { return can::send(said, team_); }, *order);
  }
  // Outside the period.
  void say(const SentOrder& said) {
    order = said;
    extra.push_back(next_frame());
  }

  void live() {
    if (order && now() % 50 == phase_ticks) {
      extra.push_back(next_frame());
    }
    if (now() % 1000 == 7) {
      mode(can::Mode::renew);
    }
    tick();
    for (const can::Frame& frame : frames()) {
      decisions += can::is<can::Decision>(frame) ? 1 : 0;
      if (can::is<can::Status>(frame)) {
        ASSERT_EQ(can::receive(frame, status), can::Verdict::accepted);
      }
    }
  }
  void live(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      live();
    }
  }
  void live_until(std::uint32_t tick_number) {
    while (now() != tick_number) {
      live();
    }
  }
  // Returns after the tick in which an order comes.
  void live_to_an_order() {
    do {
      live();
    } while ((now() - 1) % 50 != phase_ticks);
  }

  void arm_under_orders() {
    live(160);
    arm_now();
    live_to_an_order();
  }
  void arm_now() {
    mode(can::Mode::arm);
    live();
    ASSERT_EQ(state(), core::State::active);
  }

  [[nodiscard]] core::WheelSpeeds set_point() const {
    return {2 * command.left_set_point_2mm_s, 2 * command.right_set_point_2mm_s};
  }
  [[nodiscard]] bool is_told_to_move() const { return set_point() != core::WheelSpeeds{}; }
  [[nodiscard]] core::OrderState orders() const { return static_cast<core::OrderState>(status.orders); }
  [[nodiscard]] can::SendCounter& team() { return team_; }

 private:
  can::SendCounter team_;
};

inline constexpr can::WheelOrder ahead = {.left_mm_s = 300, .right_mm_s = 200};
inline constexpr core::WheelSpeeds as_ordered = {300, 200};

// Armed, and driving as ordered.
inline TeamRig driving() {
  TeamRig rig;
  rig.order = ahead;
  rig.arm_under_orders();
  EXPECT_EQ(rig.set_point(), as_ordered) << "the rig has to drive";
  return rig;
}

// The last tick from now that was told to move, of so many.
template <class Attack>
std::uint32_t moved_until(TeamRig& rig, std::uint32_t ticks, Attack attack) {
  std::uint32_t moved = 0;
  for (std::uint32_t tick = 1; tick <= ticks; ++tick) {
    attack(tick);
    rig.live();
    moved = rig.is_told_to_move() ? tick : moved;
  }
  return moved;
}

}  // namespace striker::loop
