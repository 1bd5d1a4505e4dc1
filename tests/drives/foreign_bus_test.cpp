// SPDX-License-Identifier: Apache-2.0
// Frames of drives of other makes lost, in another order, or contradicting each other within a tick. The promises, from
// outside, by the torque that the virtual drives give: an emergency stop or a fault takes it from both wheels, in time, and
// for good; and no lost frame leaves a wheel without torque for long unless the bus says so.
#include <gtest/gtest.h>

#include <cmath>

#include "firmware/can/codec.hpp"
#include "tests/drives/drive_rig.hpp"

namespace striker::sil {
namespace {

using Frames = std::vector<can::Frame>;

constexpr std::uint32_t disturbed_tick = 700;  // some 400 ms into the first kick
constexpr std::uint32_t in_time_ticks = 30;    // three heartbeats

// Drives, and what is done to the frames to and from them.
struct Disturbance {
  std::function<Frames(const can::Frame&, std::uint32_t)> to_drives = {};
  std::function<void(Frames&, std::uint32_t)> from_drives = {};
};
class DisturbedDrives final : public WheelDrives {
 public:
  DisturbedDrives(const can::DriveWiring& wiring, Disturbance disturbance)
      : drives_(make_drives(wiring)), disturbance_(std::move(disturbance)) {}

  void take(const can::Frame& frame, std::uint32_t tick) override {
    for (const can::Frame& arriving :
         disturbance_.to_drives ? disturbance_.to_drives(frame, tick) : Frames{frame}) {
      drives_->take(arriving, tick);
    }
  }
  [[nodiscard]] bool cut(std::uint32_t tick) const override { return drives_->cut(tick); }
  [[nodiscard]] const WheelOrders& orders() const override { return drives_->orders(); }
  void report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) override {
    Frames sent;
    drives_->report(speeds, tick, sent);
    if (disturbance_.from_drives) {
      disturbance_.from_drives(sent, tick);
    }
    frames.insert(frames.end(), sent.begin(), sent.end());
  }

 private:
  std::unique_ptr<WheelDrives> drives_;
  Disturbance disturbance_;
};

// The last tick in which a wheel had torque, and the first fault that was told.
class TorqueWatch final : public Observer {
 public:
  TorqueWatch(const DriveRig& rig, std::function<void(std::uint32_t)> act = {})
      : rig_(rig), act_(std::move(act)) {}

  void end_tick(const Snapshot& snapshot) override {
    tick = snapshot.tick;
    for (const StampedFrame& stamped : snapshot.robots.front().frames) {
      can::FaultReport report;
      if (can::is<can::FaultReport>(stamped.frame) && fault == core::Fault::none &&
          can::receive(stamped.frame, report) == can::Verdict::accepted) {
        fault = static_cast<core::Fault>(report.code);
        fault_tick = tick;
      }
    }
    for (const WheelOrder& order : rig_.drives->orders()) {
      last_torque_tick = order.torque_Nm != 0.0 ? tick : last_torque_tick;
    }
    if (act_) {
      act_(tick);
    }
  }

  std::uint32_t tick = 0;
  std::uint32_t last_torque_tick = 0;
  std::uint32_t fault_tick = 0;
  core::Fault fault = core::Fault::none;

 private:
  const DriveRig& rig_;
  std::function<void(std::uint32_t)> act_;
};

DriveRig disturbed_rig(can::DriveKind kind, Disturbance disturbance) {
  return {kind, std::make_unique<DisturbedDrives>(wiring_of(kind), std::move(disturbance))};
}

// Half a second with a disturbance, which has to be a fault that takes the torque from both wheels.
void expect_torque_gone(can::DriveKind kind, Disturbance disturbance, core::Fault fault) {
  DriveRig rig = disturbed_rig(kind, std::move(disturbance));
  TorqueWatch watch(rig);
  rig.play({.episodes = 1}, {&watch}, [&] { return watch.tick > disturbed_tick + 500; });
  EXPECT_GE(watch.last_torque_tick, disturbed_tick - 1) << "it was driving";
  EXPECT_LE(watch.last_torque_tick, disturbed_tick + in_time_ticks);
  EXPECT_EQ(watch.fault, fault) << core::name_of(watch.fault);
  EXPECT_LE(watch.fault_tick, disturbed_tick + in_time_ticks);
}

can::Frame heartbeat_of(std::size_t wheel, std::uint8_t state) {
  can::Frame frame = {.id = static_cast<std::uint16_t>(0x701 + wheel), .length = 1};
  frame.data[0] = state;
  return frame;
}

TEST(Cia402OnTheBus, HeartbeatsHoldNoTorque) {
  for (const std::size_t wheel : {can::left_wheel, can::right_wheel}) {
    for (const std::uint32_t period : {1U, 2U, 10U}) {
      expect_torque_gone(can::DriveKind::cia402,
                         {.from_drives =
                              [&](Frames& frames, std::uint32_t tick) {
                                if (tick >= disturbed_tick && tick % period == 0) {
                                  frames.push_back(heartbeat_of(wheel, 0x7F));
                                }
                              }},
                         core::Fault::drives_cut);
    }
  }
}

TEST(Cia402OnTheBus, ALostSyncHoldsNoTorque) {
  expect_torque_gone(can::DriveKind::cia402,
                     {.to_drives =
                          [](const can::Frame& frame, std::uint32_t tick) {
                            return tick >= disturbed_tick && frame.id == 0x080 ? Frames{} : Frames{frame};
                          }},
                     core::Fault::wheel_state_lost);
}

// A bus carries the lowest identifier first: SYNC before the PDOs of its tick.
TEST(Cia402OnTheBus, AnEmergencyStopActsInItsTickInTheBusesOrder) {
  for (std::uint32_t phase = 0; phase < 20; ++phase) {
    DriveRig rig =
        disturbed_rig(can::DriveKind::cia402, {.to_drives = [](const can::Frame& frame, std::uint32_t) {
                        return frame.id == 0x201   ? Frames{{.id = 0x080}, frame}
                               : frame.id == 0x080 ? Frames{}
                                                   : Frames{frame};
                      }});
    can::SendCounter counter;
    TorqueWatch watch(rig, [&](std::uint32_t tick) {
      if (tick == disturbed_tick + phase) {
        rig.queue(can::send(can::EmergencyStop{}, counter));  // for the next tick
      }
    });
    rig.play({.episodes = 1}, {&watch}, [&] { return watch.tick > disturbed_tick + 100; });
    EXPECT_GE(watch.last_torque_tick, disturbed_tick - 1) << "it was driving";
    EXPECT_LE(watch.last_torque_tick, disturbed_tick + phase);
  }
}

// The bus brings an emergency frame before the status of its millisecond, which may still be the old one.
TEST(Cia402OnTheBus, AnErrorIsNotForgottenInItsTick) {
  for (const std::size_t wheel : {can::left_wheel, can::right_wheel}) {
    expect_torque_gone(can::DriveKind::cia402,
                       {.from_drives =
                            [&](Frames& frames, std::uint32_t tick) {
                              if (tick == disturbed_tick) {
                                can::Frame error = {.id = static_cast<std::uint16_t>(0x081 + wheel),
                                                    .length = 8};
                                error.data[1] = 0x23;
                                frames.insert(frames.begin(), error);
                              }
                            }},
                       core::Fault::drives_cut);
  }
}

TEST(OdriveOnTheBus, AnErrorIsNotForgottenInItsTick) {
  for (const std::size_t wheel : {can::left_wheel, can::right_wheel}) {
    expect_torque_gone(can::DriveKind::odrive,
                       {.from_drives =
                            [&](Frames& frames, std::uint32_t tick) {
                              if (tick != disturbed_tick) {
                                return;
                              }
                              can::Frame error = {
                                  .id = static_cast<std::uint16_t>(wheel == can::left_wheel ? 0x001 : 0x021),
                                  .length = 8};
                              error.data[0] = 1;
                              can::Frame well = {.id = error.id, .length = 8};
                              well.data[4] = 8;
                              frames.insert(frames.begin(), {error, well});
                            }},
                       core::Fault::drives_cut);
  }
}

// One frame of the way to closed loop is lost, whichever: the kick is driven nearly as if it were not, or a fault is told.
TEST(OdriveOnTheBus, OneLostFrameLeavesNoWheelWithoutTorqueUnsaid) {
  const double undisturbed = DriveRig(can::DriveKind::odrive).play({.episodes = 1}).front().reward;
  for (const std::uint32_t wanted : {0x018U, 0x038U, 0x00BU, 0x02BU, 0x007U, 0x027U}) {
    bool is_lost = false;
    DriveRig rig =
        disturbed_rig(can::DriveKind::odrive, {.to_drives = [&](const can::Frame& frame, std::uint32_t tick) {
                        const bool loses = !is_lost && tick > kick_boot_ticks && frame.id == wanted &&
                                           (wanted % 0x20 != 0x07 || frame.data[0] == 8);
                        is_lost = is_lost || loses;
                        return loses ? Frames{} : Frames{frame};
                      }});
    TorqueWatch watch(rig);
    const auto outcomes = rig.play({.episodes = 1}, {&watch});
    EXPECT_TRUE(is_lost);
    if (watch.fault == core::Fault::none) {
      EXPECT_NEAR(outcomes.front().reward, undisturbed, 0.5) << std::hex << wanted;
    }
  }
}

}  // namespace
}  // namespace striker::sil
