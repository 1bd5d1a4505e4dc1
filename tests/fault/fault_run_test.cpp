// SPDX-License-Identifier: Apache-2.0
// Cases against the whole controller, in process.
#include "sil/scenario/fault_run.hpp"

#include <gtest/gtest.h>

#include "sil/fault/faulty_seat.hpp"
#include "sil/fault/plan/random_faults.hpp"
#include "sil/robot/striker_drives.hpp"
#include "tests/scenario/kick_rig.hpp"

namespace striker::sil {
namespace {

// The bus of one episode through a FaultySeat.
std::vector<StampedFrame> traffic(const std::vector<TimedFault>& faults, std::uint64_t seed) {
  InProcessLink controller;
  const auto plant = make_plant(PlantKind::drive, 0, robot_spec(Role::forward));
  StrikerDrives drives;
  ExactCamera camera(0);
  FaultySeat seat({.robot = 0,
                   .plant = *plant,
                   .drives = drives,
                   .camera = camera,
                   .link = controller,
                   .controller = &controller},
                  faults, seed);
  BusRecord record;
  const std::vector<Observer*> observers = {&seat.clock(), &record};
  KickScenario({.episodes = 1}, seat.seat(), observers).run([] { return false; });
  return record.frames;
}

TEST(FaultySeat, WithoutFaultsItIsTheSeatByteForByte) {
  InProcessLink controller;
  KickRig rig(controller);
  BusRecord record;
  rig.play({.episodes = 1}, {&record});
  expect_same(traffic({}, 1), record.frames);
}

TEST(FaultySeat, TheSamePlanAndSeedAreTheSameBytes) {
  for (std::uint64_t number = 0; number < 4; ++number) {
    const auto faults = timed(random_case(11, number).faults, kick_boot_ticks + kick_first_decision_tick);
    expect_same(traffic(faults, 5), traffic(faults, 5));
  }
}

TEST(FaultySeat, AnotherSeedIsAnotherBabble) {
  const auto faults = timed({usual(FaultKind::babble, 0, 10)}, 50);
  const auto one = traffic(faults, 1);
  const auto two = traffic(faults, 2);
  EXPECT_FALSE(std::equal(one.begin(), one.end(), two.begin(), two.end(),
                          [](const StampedFrame& a, const StampedFrame& b) { return a.frame == b.frame; }));
}

TEST(FaultySeat, WhatIsForAnotherBusIsRefused) {
  InProcessLink controller;
  const auto plant = make_plant(PlantKind::drive, 0, robot_spec(Role::forward));
  StrikerDrives drives;
  ExactCamera camera(0);
  const SoundParts parts{.robot = 0,
                         .plant = *plant,
                         .drives = drives,
                         .camera = camera,
                         .link = controller,
                         .controller = nullptr};
  EXPECT_THROW(FaultySeat(parts, timed({usual(FaultKind::bus_off, 0, 10)}, 100), 1), std::runtime_error);
  EXPECT_THROW(traffic(timed({usual(FaultKind::fd_frames, 0, 10)}, 100), 1), std::runtime_error);
  EXPECT_NO_THROW(FaultySeat(parts, timed({usual(FaultKind::loss, 0, 10)}, 100), 1));
}

FaultResult play(const Fault& fault) {
  return play_fault({.name = "test", .setup = {}, .faults = {fault}}, {.interface = {}});
}

Fault of(FaultKind kind, std::optional<std::uint16_t> message, std::int32_t until_ms = 1500) {
  Fault fault = usual(kind, 300, until_ms);
  fault.message = message;
  return fault;
}

template <class Message>
inline constexpr std::uint16_t identifier = can::layout<Message>.info.id;

TEST(FaultRun, AFrozenWheelStateIsFoundWithinTwentyFiveMilliseconds) {
  const FaultResult result = play(of(FaultKind::replay, identifier<can::WheelState>));
  EXPECT_TRUE(result.violations.empty());
  ASSERT_TRUE(result.detected_ms.has_value());
  EXPECT_LE(*result.detected_ms, 25U);
  EXPECT_EQ(result.outcome, FaultOutcome::recovers);
}

TEST(FaultRun, AFrozenWheelCommandIsCutByTheDrivesWithinTenMilliseconds) {
  const FaultResult result = play(of(FaultKind::replay, identifier<can::WheelCommand>));
  EXPECT_TRUE(result.violations.empty());
  ASSERT_TRUE(result.zero_torque_ms.has_value());
  EXPECT_LE(*result.zero_torque_ms, 10U);
}

TEST(FaultRun, LostPicturesStopItAndLeaveNothingOfTheReward) {
  const FaultResult result = play(of(FaultKind::picture_loss, {}));
  EXPECT_EQ(result.detected_by, "vision_lost");
  EXPECT_LE(result.detected_ms.value(), 200U);
  EXPECT_LT(result.reward, result.undisturbed_reward);
}

TEST(FaultRun, AnEmergencyStopStopsTheRun) {
  const FaultResult result = play(of(FaultKind::emergency_stop, {}, 301));
  EXPECT_EQ(result.detected_by, "emergency_stop");
  EXPECT_LE(result.zero_torque_ms.value(), 2U);
  EXPECT_EQ(result.outcome, FaultOutcome::stops);
  EXPECT_TRUE(result.violations.empty());
}

TEST(FaultRun, AnErrorPassiveBusDisturbsNothing) {
  const FaultResult result = play(of(FaultKind::error_passive, {}));
  EXPECT_EQ(result.outcome, FaultOutcome::rides_through);
  EXPECT_EQ(result.detected_by, "");
  EXPECT_DOUBLE_EQ(result.reward, result.undisturbed_reward);
}

TEST(FaultRun, BusOffABrownOutAndASecondControllerAreNoticed) {
  EXPECT_EQ(play(of(FaultKind::bus_off, {})).detected_by, "bus_off");
  EXPECT_EQ(play(of(FaultKind::second_controller, {})).detected_by, "second_controller");
  const FaultResult dead = play(of(FaultKind::brown_out, {}, 400));
  EXPECT_LE(dead.zero_torque_ms.value(), 10U);
  EXPECT_EQ(dead.outcome, FaultOutcome::recovers);
}

TEST(FaultRun, FlippedWeightsAreFoundAndWholeAgainAfterwards) {
  const Fault flip = of(FaultKind::weight_flips, {}, 2000);
  EXPECT_EQ(play(flip).detected_by, "policy_corrupt");
  const FaultResult next = play(of(FaultKind::error_passive, {}));
  EXPECT_EQ(next.detected_by, "");
}

TEST(FaultRun, ALineIsTheResultAgain) {
  FaultResult result = play(of(FaultKind::replay, identifier<can::WheelState>));
  result.violations.push_back({.tick = 7, .invariant = Invariant::runaway, .text = "a \"rim\""});
  EXPECT_EQ(to_line(result_from_line(to_line(result))), to_line(result));
  EXPECT_EQ(to_line(result).find('\n'), std::string::npos);
}

}  // namespace
}  // namespace striker::sil
