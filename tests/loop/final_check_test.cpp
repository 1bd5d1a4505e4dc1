// SPDX-License-Identifier: Apache-2.0
// What the controller makes of a pilot that goes wrong, of memory that changes before a decision, and of a seed that
// is known at run time alone. The pilot is the test's own: no policy would do this.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/core/controller.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/controller_node.hpp"
#include "firmware/loop/gated_node.hpp"

namespace striker::core {
namespace {

constexpr std::uint32_t mark = 0xC0FFEE11;
constexpr RobotProfile robot = profile_of(forward);

struct ReadyWeights {
  std::uint32_t reserved = 0;
  bool step() { return true; }
};

// Always wants the set-point that it was made for.
template <std::int32_t wanted_mm_s>
struct StubbornPilot {
  using WeightsCheck = ReadyWeights;
  static constexpr std::uint32_t identity = 1;

  SelfTest test_self(const RobotProfile&) { return SelfTest::passed; }
  void reset() {}
  Decision decide(const RelativeState&, DecisionDue due, std::uint32_t late) {
    begun_late = late;
    return {.extrapolated = due == DecisionDue::extrapolated};
  }
  void end_if(bool ends, Decision& decision) { decision.over = ends; }
  [[nodiscard]] WheelSpeeds set_point() const { return {wanted_mm_s, wanted_mm_s}; }

  std::uint32_t marked = mark;
  std::uint32_t begun_late = 77;
};

template <std::int32_t wanted_mm_s>
class Bench {
 public:
  explicit Bench(const RobotProfile& profile = robot) : controller(profile) {}

  Controller<StubbornPilot<wanted_mm_s>> controller;
  Actions actions;
  bool sends_pictures = true;
  Requests requests;

  void tick() {
    Percepts percepts;
    percepts.wheels = WheelSpeeds{};
    percepts.requests = std::exchange(requests, {});
    if (sends_pictures && now_ % 50 == 0) {
      const auto number = static_cast<std::int32_t>(now_ / 50 % 16);
      percepts.robot = {.picture = number};
      percepts.ball = {.picture = number, .position_um = {1'000'000, 0}};
    }
    controller.step({.tick = now_, .percepts = percepts}, actions);
    ++now_;
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      tick();
    }
  }
  void arm() {
    run(110);
    requests.asked = Order::arm;
    tick();
    requests.confirmed = {Order::arm, actions.challenge.challenge};
    tick();
    ASSERT_EQ(controller.state(), State::active);
  }

 private:
  std::uint32_t now_ = 0;
};

TEST(FinalCheck, ASetPointBeyondTheRobotsTopSpeedIsRefusedAndLatched) {
  Bench<2551> bench;
  bench.arm();
  bench.run(60);
  EXPECT_EQ(bench.controller.fault(), Fault::command_rejected);
  EXPECT_EQ(bench.actions.drive, DriveCommand{});
  EXPECT_EQ(bench.actions.fault, Fault::command_rejected);
}

TEST(FinalCheck, ARobotThatThePolicyDoesNotSuitFailsTheSelfTest) {
  RobotProfile slow = loop::built_in_robot;
  slow.top_rim_speed_mm_s = 1'000;
  RobotProfile strong = loop::built_in_robot;
  strong.torque_limit_mNm = INT32_MAX;
  for (const RobotProfile& unfit : {slow, strong}) {
    EXPECT_FALSE(loop::BuiltInPilot::suits(unfit));
    loop::BuiltInNode node(unfit);
    can::FrameList frames;
    for (std::uint32_t tick = 0; tick < 100; ++tick) {
      node.step({.number = tick}, {}, frames);
    }
    EXPECT_EQ(node.controller().fault(), Fault::self_test_failed);
  }
}

TEST(FinalCheck, TheTopSpeedItselfIsDriven) {
  Bench<2550> bench;
  bench.arm();
  bench.run(60);
  EXPECT_EQ(bench.controller.fault(), Fault::none);
  EXPECT_EQ(bench.actions.drive.set_point.left_mm_s, 2550);
}

// Wheels that hardly turn for a while are pushed harder and harder: of that nothing is left when another run begins.
TEST(FinalCheck, AnotherArmingForgetsWhatTheLoopsSummedUp) {
  Bench<10> bench;
  std::array<std::int32_t, 2> first_mNm{};
  for (std::int32_t& torque_mNm : first_mNm) {
    bench.arm();
    while (bench.actions.drive.torque == WheelTorques{}) {
      bench.tick();
    }
    torque_mNm = bench.actions.drive.torque.left_mNm;
    bench.run(200);
    ASSERT_EQ(bench.controller.fault(), Fault::none);
    ASSERT_GT(bench.actions.drive.torque.left_mNm, torque_mNm + 20);
    bench.requests.disarm = true;
    bench.tick();
    ASSERT_EQ(bench.actions.drive, DriveCommand{});
  }
  EXPECT_EQ(first_mNm[0], first_mNm[1]);
}

// A decision that acts late is one of fewer that are left: the one before it has passed by then.
TEST(FinalCheck, ADecisionIsCountedWhenItActs) {
  for (const std::int32_t delay_ms : {0, 1, 20, 50}) {
    RobotDescription late = forward;
    late.command_delay_ms = delay_ms;
    Bench<10> bench(profile_of(late));
    bench.arm();
    bench.run(60);
    EXPECT_EQ(bench.controller.pilot().begun_late, delay_ms == 0 ? 0U : 1U) << delay_ms;
  }
}

// In a fault nothing is wanted of the drives: there is nothing to refuse.
TEST(FinalCheck, AFaultWhileDrivingStaysAlone) {
  Bench<1000> bench;
  bench.arm();
  bench.run(60);
  ASSERT_NE(bench.actions.drive, DriveCommand{});
  bench.sends_pictures = false;
  bench.run(300);
  EXPECT_EQ(bench.controller.fault(), Fault::vision_lost);
  EXPECT_EQ(bench.controller.faults(), set_of(Fault::vision_lost));
}

TEST(FinalCheck, MemoryThatChangedIsNoticedBeforeADecisionWithoutAPicture) {
  Bench<1000> bench;
  bench.arm();
  bench.run(60);
  ASSERT_NE(bench.actions.drive, DriveCommand{});
  bench.sends_pictures = false;
  auto* const bytes = reinterpret_cast<unsigned char*>(&bench.controller);
  std::size_t at = 0;
  while (at + sizeof mark <= sizeof bench.controller && std::memcmp(bytes + at, &mark, sizeof mark) != 0) {
    ++at;
  }
  ASSERT_LE(at + sizeof mark, sizeof bench.controller);
  bytes[at] ^= 1U;
  for (int i = 0; i < 60 && bench.controller.fault() == Fault::none; ++i) {
    bench.tick();
    EXPECT_FALSE(bench.actions.decision) << "none is made of it";
  }
  EXPECT_EQ(bench.controller.fault(), Fault::state_corrupt);
  EXPECT_EQ(bench.actions.drive, DriveCommand{});
}

TEST(FinalCheck, ASeedOfTheRunTimeGivesOtherChallenges) {
  const auto first_challenge = [](std::uint32_t seed) {
    using Node = loop::ControllerNode<Controller<StubbornPilot<0>>, can::StrikerDrives>;
    loop::GatedNode<Node> node(robot);
    if (seed != 0) {
      node.seed_challenges(seed);
    }
    can::SendCounter counter;
    const can::Frame request =
        can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(can::Mode::arm)}, counter);
    can::FrameList sent;
    for (std::uint32_t tick = 0; tick < 3; ++tick) {
      node.step({.number = tick}, sent);  // to standby: a change of state closes a request
    }
    node.step({.number = 3, .frames = {&request, 1}}, sent);
    can::Challenge challenge;
    EXPECT_EQ(can::receive(sent.frames().front(), challenge), can::Verdict::accepted);
    return challenge.challenge;
  };
  EXPECT_EQ(first_challenge(0), first_challenge(0));
  EXPECT_EQ(first_challenge(7), first_challenge(7));
  EXPECT_NE(first_challenge(0), first_challenge(7));
  EXPECT_NE(first_challenge(8), first_challenge(7));
}

}  // namespace
}  // namespace striker::core
