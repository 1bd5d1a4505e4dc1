// SPDX-License-Identifier: Apache-2.0
// Every invariant sees its violation in forged traffic, and nothing in sound traffic.
#include "sil/fault/watch/invariants.hpp"

#include <functional>

#include "tests/fault/fault_rig.hpp"

namespace striker::sil {
namespace {

constexpr std::int32_t active = static_cast<std::int32_t>(core::State::active);
constexpr std::int32_t standby = static_cast<std::int32_t>(core::State::standby);
constexpr std::int32_t fault_state = static_cast<std::int32_t>(core::State::fault);

std::int32_t code(core::Fault fault) {
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
  std::int32_t state = active;
  core::Fault fault = core::Fault::none;
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
    controller_.answers = {
        can::send(can::Status{.state = armed ? state : standby, .fault = code(fault)}, status_),
        can::send(can::WheelCommand{.left_torque_mNm = torque, .right_torque_mNm = -torque}, command_)};
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

TEST(Invariants, ASoundRunBreaksNone) {
  Forger run;
  run.run(500);
  EXPECT_TRUE(run.invariants().violations().empty());
  EXPECT_EQ(run.invariants().ticks_violated(), 0U);
}

TEST(Invariants, TorqueInStandbyIsSeenInItsTick) {
  Forger run;
  run.run(100);
  run.state = standby;
  run.run(3);
  run.expect(Invariant::unarmed_torque);
  EXPECT_EQ(run.invariants().violations().front().tick, 100U);
  EXPECT_EQ(run.invariants().ticks_violated(), 3U);
}

TEST(Invariants, TorqueMayLastForTwoCommandsOfAFault) {
  Forger run;
  run.run(100);
  run.state = fault_state;
  run.fault = core::Fault::vision_lost;
  run.run(2);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.run(1);
  run.expect(Invariant::fault_torque);
}

TEST(Invariants, TorqueAndSetPointHaveTheRobotsLimits) {
  Forger run;
  run.torque_mNm = core::profile_of(core::forward).torque_limit_mNm;
  run.run(50);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.torque_mNm += 1;
  run.run(1);
  run.expect(Invariant::limits);
  Forger fast;
  fast.run(50);
  can::SendCounter counter;
  fast.spoil = [&](can::Frame& frame) {
    if (can::is<can::WheelCommand>(frame)) {
      frame = can::send(can::WheelCommand{.left_set_point_2mm_s = 1276}, counter);
    }
  };
  fast.run(1);
  fast.expect(Invariant::limits);
}

TEST(Invariants, AStopIsObeyedWithinTwoTicksUntilItIsCleared) {
  Forger run;
  run.run(100);
  run.forged = {run.stop()};
  run.run(1);
  run.forged.clear();
  run.run(2);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.run(1);
  run.expect(Invariant::stop_ignored);
}

TEST(Invariants, WheelStatesAgeWhateverComesInTheirPlace) {
  Forger run;
  run.run(100);
  run.wheels_arrive = false;
  can::SendCounter counter;
  run.forged = {can::send(can::WheelState{.left_mm_s = 99}, counter)};
  run.run(25);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.run(1);
  run.expect(Invariant::stale_wheels);
}

TEST(Invariants, PicturesAge) {
  Forger run;
  run.run(101);
  run.vision_arrives = false;
  run.run(200);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.run(1);
  run.expect(Invariant::stale_vision);
}

TEST(Invariants, TimeThatStandsStillAges) {
  Forger run;
  run.run(100);
  run.sync_stands = true;
  run.run(26);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.run(1);
  run.expect(Invariant::stale_sync);
}

TEST(Invariants, TheDrivesHoldNoOldCommand) {
  Forger run;
  run.run(100);
  run.commands_arrive = false;
  run.run(10);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.run(1);
  run.expect(Invariant::stale_command);
  Forger cut;
  cut.run(100);
  cut.commands_arrive = false;
  cut.drives.is_cut = true;
  cut.run(50);
  EXPECT_TRUE(cut.invariants().violations().empty());
}

// Stopped with a fault, at tick 100.
void stop_with(Forger& run, core::Fault fault) {
  run.run(100);
  run.torque_mNm = 0;
  run.state = fault_state;
  run.fault = fault;
  run.run(10);
}

TEST(Invariants, TheFirstFaultStays) {
  Forger run;
  stop_with(run, core::Fault::vision_lost);
  run.fault = core::Fault::bus_off;
  run.run(1);
  run.expect(Invariant::fault_changed);
  Forger lost;
  stop_with(lost, core::Fault::emergency_stop);
  lost.state = standby;
  lost.fault = core::Fault::none;
  lost.run(1);
  lost.expect(Invariant::fault_changed);
}

TEST(Invariants, AnHonestClearMayTakeTheFaultAndAnArmBringsTorqueBack) {
  Forger run;
  stop_with(run, core::Fault::vision_lost);
  run.from_operator = {run.order(can::Mode::clear)};
  run.run(1);
  run.state = standby;
  run.fault = core::Fault::none;
  run.run(5);
  run.from_operator = {run.order(can::Mode::arm)};
  run.run(1);
  run.state = active;
  run.torque_mNm = 100;
  run.run(5);
  EXPECT_TRUE(run.invariants().violations().empty());
}

TEST(Invariants, AForgedArmIsNoConsent) {
  Forger run;
  run.run(100);
  run.torque_mNm = 0;
  run.state = standby;
  run.run(5);
  run.forged = {run.order(can::Mode::arm)};
  run.state = active;
  run.run(1);
  run.expect(Invariant::unasked_arming);
}

TEST(Invariants, ADisarmTakesTheConsent) {
  Forger run;
  run.run(3);
  run.from_operator = {run.order(can::Mode::disarm)};
  run.run(3);
  run.from_operator = {run.order(can::Mode::disarm)};
  run.run(20);
  run.expect(Invariant::unasked_arming);
}

TEST(Invariants, AFrameThatItsOwnTableRefusesIsSeen) {
  Forger run;
  run.run(50);
  run.spoil = [](can::Frame& frame) {
    if (can::is<can::Status>(frame)) {
      frame.data[2] = 0xFF;
    }
  };
  run.run(1);
  run.expect(Invariant::unknown_value);
}

TEST(Invariants, ARimFarBeyondItsSpeedIsSeen) {
  Forger run;
  run.plant.rims = {5.0, -5.0};
  run.run(50);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.plant.rims.right_m_s = -5.2;
  run.run(1);
  run.expect(Invariant::runaway);
}

TEST(Invariants, OnlyARecordingIsOutOfReach) {
  TimedFault replay = fault_of(FaultKind::replay, 0, 1);
  replay.fault.message = identifier<can::WheelState>;
  replay.fault.count = 11;
  EXPECT_TRUE(out_of_reach_of({replay}).empty());
  replay.fault.count = 12;
  EXPECT_EQ(out_of_reach_of({replay}), std::vector{Invariant::stale_wheels});
}

}  // namespace
}  // namespace striker::sil
