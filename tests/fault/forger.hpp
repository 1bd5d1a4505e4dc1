// SPDX-License-Identifier: Apache-2.0
// Forged traffic of a sound run, which a test spoils.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sil/fault/watch/invariants.hpp"
#include "tests/fault/fault_rig.hpp"

namespace striker::sil {

inline constexpr std::int32_t active_state = static_cast<std::int32_t>(core::State::active);
inline constexpr std::int32_t standby_state = static_cast<std::int32_t>(core::State::standby);
inline constexpr std::int32_t fault_state = static_cast<std::int32_t>(core::State::fault);

inline std::int32_t code(core::Fault fault) {
  return static_cast<std::int32_t>(fault);
}

class ForgedDrives final : public WheelDrives {
 public:
  bool is_cut = false;
  WheelOrders held;

  void take(const can::Frame&, std::uint32_t) override {}
  [[nodiscard]] bool cut(std::uint32_t) const override { return is_cut; }
  [[nodiscard]] const WheelOrders& orders() const override { return held; }
  void report(const RimSpeeds&, std::uint32_t, std::vector<can::Frame>&) override {}
};

class ForgedPlant final : public Plant {
 public:
  RimSpeeds rims;

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return 1; }
  void reset() override {}
  void actuate(World&, const WheelOrders&, bool) override {}
  void sense(const World&) override {}
  [[nodiscard]] RimSpeeds measured() const override { return rims; }
};

// A sound run, tick by tick, which a test spoils: armed and driving from tick 10 on.
class Forger {
 public:
  std::int32_t torque_mNm = 100;
  std::int32_t state = active_state;
  core::Fault fault = core::Fault::none;
  std::optional<core::Fault> told_before;  // by another Status, earlier in the tick
  bool wheels_arrive = true;
  bool vision_arrives = true;
  bool commands_arrive = true;
  bool sync_stands = false;
  std::vector<can::Frame> from_operator;  // in the next tick
  std::vector<can::Frame> forged;         // reach the controller, but nobody sent them honestly
  std::function<void(can::Frame&)> spoil = [](can::Frame&) {};  // what the controller sends
  ForgedDrives drives;
  ForgedPlant plant;

  void run(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      tick();
    }
  }

  // Only this invariant was violated.
  void expect(Invariant invariant) const {
    ASSERT_EQ(invariants_.violations().size(), 1U);
    EXPECT_EQ(name_of(invariants_.violations().front().invariant), name_of(invariant));
  }
  [[nodiscard]] const Invariants& invariants() const { return invariants_; }
  [[nodiscard]] std::uint32_t now() const { return tick_; }

  can::Frame order(can::Mode mode) {
    return can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode)}, mode_);
  }
  can::Frame stop() { return can::send(can::EmergencyStop{}, stop_); }

 private:
  void tick() {
    if (tick_ == 5) {
      from_operator.push_back(order(can::Mode::arm));
    }
    std::vector<can::Frame> honest = std::exchange(from_operator, {});
    if (tick_ % 50 == 0) {
      honest.push_back(can::send(can::VisionPose{.x_quarter_mm = static_cast<std::int32_t>(tick_)}, pose_));
      honest.push_back(can::send(can::VisionBall{.x_quarter_mm = static_cast<std::int32_t>(tick_)}, ball_));
    }
    honest.push_back(can::send(can::WheelState{.left_mm_s = static_cast<std::int32_t>(tick_)}, wheels_));
    honest.push_back(can::send(can::Sync{.tick = sync_stands ? 1 : static_cast<std::int32_t>(tick_)}, sync_));
    at_seat_.send(tick_, honest);
    std::vector<can::Frame> arriving;
    for (const can::Frame& frame : honest) {
      const bool vision = can::is<can::VisionPose>(frame) || can::is<can::VisionBall>(frame);
      if ((wheels_arrive || !can::is<can::WheelState>(frame)) && (vision_arrives || !vision)) {
        arriving.push_back(frame);
      }
    }
    arriving.insert(arriving.end(), forged.begin(), forged.end());
    at_controller_.send(tick_, arriving);
    say();
    invariants_.end_tick(
        {.tick = tick_++, .episode = 0, .deciding = true, .contact = false, .robots = {}, .ball = {}});
  }

  void say() {
    const bool armed = tick_ >= 10;
    const std::int32_t torque = armed ? torque_mNm : 0;
    controller_.answers.clear();
    if (told_before) {
      controller_.answers.push_back(
          can::send(can::Status{.state = fault_state, .fault = code(*told_before)}, status_));
    }
    const std::vector<can::Frame> last = {
        can::send(can::Status{.state = armed ? state : standby_state, .fault = code(fault)}, status_),
        can::send(can::WheelCommand{.left_torque_mNm = torque, .right_torque_mNm = -torque}, command_)};
    controller_.answers.insert(controller_.answers.end(), last.begin(), last.end());
    for (can::Frame& frame : controller_.answers) {
      spoil(frame);
    }
    std::vector<can::Frame> ignored;
    at_controller_.collect(tick_, ignored);
    bus_.answers = commands_arrive ? controller_.answers : std::vector<can::Frame>();
    at_seat_.collect(tick_, ignored);
    if (commands_arrive) {
      drives.held = {WheelOrder{torque * 1e-3, 0.0}, WheelOrder{-torque * 1e-3, 0.0}};
    }
  }

  std::uint32_t tick_ = 0;
  ShowLink controller_;
  ShowLink bus_;
  LinkTap at_controller_{controller_};
  LinkTap at_seat_{bus_};
  can::SendCounter mode_, stop_, pose_, ball_, wheels_, sync_, status_, command_;
  Invariants invariants_{
      {.at_seat = at_seat_, .at_controller = at_controller_, .drives = drives, .plant = plant},
      core::profile_of(core::forward)};
};

}  // namespace striker::sil
