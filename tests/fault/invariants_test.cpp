// SPDX-License-Identifier: Apache-2.0
// Every invariant sees its violation in forged traffic, and nothing in sound traffic.
#include "tests/fault/forger.hpp"

namespace striker::sil {
namespace {

TEST(Invariants, ASoundRunBreaksNone) {
  Forger run;
  run.run(500);
  EXPECT_TRUE(run.invariants().violations().empty());
  EXPECT_EQ(run.invariants().ticks_violated(), 0U);
}

TEST(Invariants, TorqueInStandbyIsSeenInItsTick) {
  Forger run;
  run.run(100);
  run.state = standby_state;
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

TEST(Invariants, AStopIsObeyedWithinTwoTicks) {
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
  lost.state = standby_state;
  lost.fault = core::Fault::none;
  lost.run(1);
  lost.expect(Invariant::fault_changed);
}

// A fault told in the same tick before SYNC(0) was handled, as after a stall, with or without it among the inputs.
void tell_and_forget(Forger& run, core::Fault fault, bool began_anew) {
  stop_with(run, core::Fault::none);
  run.told_before = fault;
  run.state = standby_state;
  can::SendCounter counter;
  run.forged = began_anew ? std::vector{can::send(can::Sync{.tick = 0}, counter)} : std::vector<can::Frame>();
  run.run(1);
}

TEST(Invariants, AFaultToldBeforeTimeBeganAnewMayGoWithIt) {
  Forger run;
  tell_and_forget(run, core::Fault::frames_lost, true);
  EXPECT_TRUE(run.invariants().violations().empty());
  Forger same_time;
  tell_and_forget(same_time, core::Fault::frames_lost, false);
  same_time.expect(Invariant::fault_changed);
  Forger stop;
  tell_and_forget(stop, core::Fault::emergency_stop, true);
  stop.expect(Invariant::fault_changed);
}

TEST(Invariants, AnHonestClearMayTakeTheFaultAndAnArmBringsTorqueBack) {
  Forger run;
  stop_with(run, core::Fault::vision_lost);
  run.from_operator = {run.order(can::Mode::clear)};
  run.run(1);
  run.state = standby_state;
  run.fault = core::Fault::none;
  run.run(5);
  run.from_operator = {run.order(can::Mode::arm)};
  run.run(1);
  run.state = active_state;
  run.torque_mNm = 100;
  run.run(5);
  EXPECT_TRUE(run.invariants().violations().empty());
}

TEST(Invariants, AForgedArmIsNoConsent) {
  Forger run;
  run.run(100);
  run.torque_mNm = 0;
  run.state = standby_state;
  run.run(5);
  run.forged = {run.order(can::Mode::arm)};
  run.state = active_state;
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
  run.plant.rims = {6.3, -6.3};
  run.run(50);
  EXPECT_TRUE(run.invariants().violations().empty());
  run.plant.rims.right_m_s = -6.4;
  run.run(1);
  run.expect(Invariant::runaway);
}

TEST(Invariants, ARecordingAndADelayOnTheWayAreOutOfReach) {
  TimedFault replay = fault_of(FaultKind::replay, 0, 1);
  replay.fault.message = identifier<can::WheelState>;
  replay.fault.count = 11;
  EXPECT_TRUE(out_of_reach_of({replay}).invariants.empty());
  replay.fault.count = 12;
  EXPECT_EQ(out_of_reach_of({replay}).invariants, std::vector{Invariant::stale_wheels});
  EXPECT_EQ(out_of_reach_of({replay, fault_of(FaultKind::delay, 0, 1)}).lateness_ticks, 5U);
}

}  // namespace
}  // namespace striker::sil
