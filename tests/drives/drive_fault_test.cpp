// SPDX-License-Identifier: Apache-2.0
// The promise about drives of other makes, from outside, on the bus: one that reports an error, disarms or disappears in
// mid-kick is a fault within 3 of its own periods, whenever in its period that is, and from then on no drive is told to
// move. And nothing moves or is enabled before the controller says that it is active.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <tuple>

#include "firmware/can/codec.hpp"
#include "tests/drives/drive_rig.hpp"

namespace striker::sil {
namespace {

constexpr std::uint32_t own_period_ticks = 10;  // of the heartbeats of both kinds
constexpr std::uint32_t failing_tick = 700;     // the first episode's, some 400 ms into its kick

// From the frame's bytes alone.
bool moves(can::DriveKind kind, const can::Frame& frame) {
  if (kind == can::DriveKind::odrive) {
    return (frame.id == 0x00E || frame.id == 0x02E) &&
           (frame.data[0] | frame.data[1] | frame.data[2] | frame.data[3]) != 0;
  }
  return (frame.id == 0x201 || frame.id == 0x202) && (frame.data[2] | frame.data[3]) != 0;
}
bool enables(can::DriveKind kind, const can::Frame& frame) {
  return kind == can::DriveKind::odrive
             ? (frame.id == 0x007 || frame.id == 0x027) && frame.data[0] == 8
             : (frame.id == 0x201 || frame.id == 0x202) && (frame.data[0] & 8U) != 0;
}

// What the bus tells, tick by tick, and what is done to the drives in one of them.
class Watch final : public Observer {
 public:
  Watch(can::DriveKind kind, std::function<void(std::uint32_t)> act) : kind_(kind), act_(std::move(act)) {}

  void end_tick(const Snapshot& snapshot) override {
    for (const StampedFrame& stamped : snapshot.robots.front().frames) {
      see(stamped.frame, snapshot.tick);
    }
    act_(snapshot.tick);
  }

  std::uint32_t active_tick = 0;  // the first
  std::uint32_t fault_tick = 0;
  core::Fault fault = core::Fault::none;
  std::uint32_t moved_ticks = 0;

 private:
  void see(const can::Frame& frame, std::uint32_t tick) {
    can::Status status;
    can::FaultReport report;
    if (can::is<can::Status>(frame) && can::receive(frame, status) == can::Verdict::accepted) {
      is_active_ = static_cast<core::State>(status.state) == core::State::active;
      active_tick = is_active_ && active_tick == 0 ? tick : active_tick;
    } else if (can::is<can::FaultReport>(frame) && can::receive(frame, report) == can::Verdict::accepted &&
               fault == core::Fault::none) {
      fault = static_cast<core::Fault>(report.code);
      fault_tick = tick;
    }
    moved_ticks += moves(kind_, frame) ? 1 : 0;
    EXPECT_TRUE(is_active_ || !moves(kind_, frame)) << "tick " << tick;
    EXPECT_TRUE(is_active_ || !enables(kind_, frame)) << "tick " << tick;
  }

  can::DriveKind kind_;
  std::function<void(std::uint32_t)> act_;
  bool is_active_ = false;
};

using Case = std::tuple<can::DriveKind, std::size_t, DriveFailure>;
class ForeignDriveFails : public testing::TestWithParam<Case> {};

TEST_P(ForeignDriveFails, IsAFaultWithinThreeOfItsPeriods) {
  const can::DriveKind kind = std::get<0>(GetParam());
  const std::size_t wheel = std::get<1>(GetParam());
  const DriveFailure failure = std::get<2>(GetParam());
  for (std::uint32_t phase = 0; phase < own_period_ticks; ++phase) {
    DriveRig rig(kind);
    auto& drives = dynamic_cast<ForeignDrives&>(*rig.drives);
    const std::uint32_t at = failing_tick + phase;
    std::uint32_t now = 0;
    Watch watch(kind, [&](std::uint32_t tick) {
      now = tick;
      if (tick == at) {
        drives.fail(wheel, failure);
      }
    });
    rig.play({.episodes = 1}, {&watch}, [&] { return now > at + 100; });
    EXPECT_GT(watch.moved_ticks, 100U) << "it was driving";
    EXPECT_GT(watch.fault_tick, at) << "phase " << phase << core::name_of(watch.fault);
    EXPECT_LE(watch.fault_tick, at + 3 * own_period_ticks) << "phase " << phase;
    EXPECT_EQ(watch.fault,
              failure == DriveFailure::gone ? core::Fault::wheel_state_lost : core::Fault::drives_cut)
        << core::name_of(watch.fault);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ForeignDriveFails,
                         testing::Combine(testing::Values(can::DriveKind::odrive, can::DriveKind::cia402),
                                          testing::Values(can::left_wheel, can::right_wheel),
                                          testing::Values(DriveFailure::error, DriveFailure::disarmed,
                                                          DriveFailure::gone)));

class ForeignDrivesPlay : public testing::TestWithParam<can::DriveKind> {};

TEST_P(ForeignDrivesPlay, DriveEveryEpisodeAndRestBetween) {
  DriveRig rig(GetParam());
  Watch watch(GetParam(), [&](std::uint32_t tick) {
    if (tick > kick_boot_ticks + kick_episode_ticks && (tick - kick_boot_ticks) % kick_episode_ticks == 40) {
      EXPECT_TRUE(rig.drives->cut(tick)) << "40 ms after the disarm";
    }
  });
  rig.play({.episodes = 4}, {&watch});
  EXPECT_TRUE(rig.undriven.empty());
  EXPECT_EQ(watch.fault, core::Fault::none) << core::name_of(watch.fault);
  EXPECT_GT(watch.moved_ticks, 1000U);
}

TEST_P(ForeignDrivesPlay, OneThatDoesNotComeUpIsAFault) {
  for (const std::size_t wheel : {can::left_wheel, can::right_wheel}) {
    DriveRig rig(GetParam());
    auto& drives = dynamic_cast<ForeignDrives&>(*rig.drives);
    Watch watch(GetParam(), [&](std::uint32_t) { drives.fail(wheel, DriveFailure::disarmed); });
    rig.play({.episodes = 1}, {&watch}, [&] { return watch.fault_tick != 0; });
    EXPECT_GT(watch.active_tick, 0U);
    EXPECT_LE(watch.fault_tick, watch.active_tick + 41);
    EXPECT_EQ(watch.fault, core::Fault::drives_cut) << core::name_of(watch.fault);
    EXPECT_EQ(watch.moved_ticks, 0U) << "the other one alone does not drive";
  }
}

// An error before the kick is cleared as the operator arms, and one of the kick before does not spoil the next.
TEST_P(ForeignDrivesPlay, GoOnAfterAnErrorThatIsOver) {
  DriveRig rig(GetParam());
  auto& drives = dynamic_cast<ForeignDrives&>(*rig.drives);
  Watch watch(GetParam(), [&](std::uint32_t tick) {
    if (tick == 50 || tick == failing_tick) {
      drives.fail(can::left_wheel, DriveFailure::error);
    }
  });
  const auto outcomes = rig.play({.episodes = 3}, {&watch});
  EXPECT_EQ(watch.fault_tick / 100, failing_tick / 100);
  EXPECT_EQ(rig.undriven, std::vector<std::uint64_t>{0});
}

INSTANTIATE_TEST_SUITE_P(All, ForeignDrivesPlay,
                         testing::Values(can::DriveKind::odrive, can::DriveKind::cia402));

}  // namespace
}  // namespace striker::sil
