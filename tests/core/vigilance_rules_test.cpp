// SPDX-License-Identifier: Apache-2.0
// Every cause that the controller knows of its inputs, at its limit.
#include "firmware/core/supervision/vigilance.hpp"

#include <gtest/gtest.h>

namespace striker::core {
namespace {

constexpr bool has(Faults faults, Fault fault) {
  return (faults & set_of(fault)) != 0;
}

class VigilanceRules : public testing::Test {
 protected:
  Vigilance vigilance;
  std::uint32_t tick = 1000;
  bool active = true;
  bool driving = true;

  void pass(std::uint32_t elapsed, const Percepts& percepts = {}) {
    tick += elapsed;
    vigilance.begin_tick(tick, elapsed, active, driving, percepts);
  }
  void run(std::uint32_t ticks, const Percepts& percepts = {}) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      pass(1, percepts);
    }
  }
  [[nodiscard]] bool sees(Fault fault) const { return has(vigilance.causes(active), fault); }
};

Percepts wheels(bool cut = false) {
  Percepts percepts;
  percepts.wheels = WheelSpeeds{};
  percepts.drives_cut = cut;
  return percepts;
}
Percepts invalid_wheels() {
  Percepts percepts;
  percepts.invalid.wheels = true;
  return percepts;
}
Percepts invalid_vision() {
  Percepts percepts;
  percepts.invalid.vision = true;
  return percepts;
}
Percepts wrong_operator() {
  Percepts percepts;
  percepts.invalid.operators = true;
  return percepts;
}
Percepts renewal() {
  Percepts percepts;
  percepts.requests.renew = true;
  return percepts;
}

TEST_F(VigilanceRules, AtFirstNothingIsFreshAndNothingIsWrong) {
  pass(1);
  EXPECT_FALSE(vigilance.vision_is_fresh());
  EXPECT_FALSE(vigilance.wheels_are_fresh());
  EXPECT_FALSE(vigilance.stop_is_pressed());
  EXPECT_EQ(vigilance.causes(true), 0U);
}

TEST_F(VigilanceRules, WheelsAreFreshFor20Ticks) {
  pass(1, wheels());
  pass(20);
  EXPECT_TRUE(vigilance.wheels_are_fresh());
  pass(1);
  EXPECT_FALSE(vigilance.wheels_are_fresh());
}

TEST_F(VigilanceRules, WheelsAreAsOldAsTheyAre) {
  Percepts old = wheels();
  old.wheels_age_ticks = 20;
  pass(1, old);
  EXPECT_TRUE(vigilance.wheels_are_fresh());
  old.wheels_age_ticks = 21;
  pass(1, old);
  EXPECT_FALSE(vigilance.wheels_are_fresh());
}

TEST_F(VigilanceRules, PicturesAreFreshFor150Ticks) {
  pass(1);
  vigilance.see_picture(PictureResult::taken, tick, tick);
  pass(150);
  EXPECT_TRUE(vigilance.vision_is_fresh());
  pass(1);
  EXPECT_FALSE(vigilance.vision_is_fresh());
  vigilance.see_picture(PictureResult::taken, tick - 150, tick);
  EXPECT_TRUE(vigilance.vision_is_fresh());
  vigilance.see_picture(PictureResult::taken, tick - 151, tick);
  EXPECT_FALSE(vigilance.vision_is_fresh());
  vigilance.see_picture(PictureResult::taken, tick, tick);
  vigilance.see_picture(PictureResult::none, tick, tick);
  EXPECT_TRUE(vigilance.vision_is_fresh());
  vigilance.forget_pictures();
  EXPECT_FALSE(vigilance.vision_is_fresh());
}

TEST_F(VigilanceRules, AStopHolds200Ticks) {
  Percepts stop;
  stop.emergency_stop = true;
  pass(1, stop);
  pass(200);
  EXPECT_TRUE(vigilance.stop_is_pressed());
  pass(1);
  EXPECT_FALSE(vigilance.stop_is_pressed());
}

TEST_F(VigilanceRules, TheDeadManActsBeyond10000TicksWithoutARenewal) {
  pass(10'000);
  EXPECT_FALSE(sees(Fault::dead_man));
  pass(1);
  EXPECT_TRUE(sees(Fault::dead_man));
  EXPECT_EQ(vigilance.causes(false), 0U) << "unarmed it does not matter";
  pass(1, renewal());
  EXPECT_FALSE(sees(Fault::dead_man));
  pass(0x7FFFFFFF);
  pass(0x7FFFFFFF);
  pass(0x7FFFFFFF);
  EXPECT_TRUE(sees(Fault::dead_man)) << "and does not wrap";
  active = false;
  pass(1);
  active = true;
  pass(10'000);
  EXPECT_FALSE(sees(Fault::dead_man)) << "each arming has its own time";
}

TEST_F(VigilanceRules, DrivesThatCutAreACauseBeyond20TicksOfDriving) {
  run(20, wheels(true));
  EXPECT_FALSE(sees(Fault::drives_cut));
  run(1);
  EXPECT_TRUE(sees(Fault::drives_cut)) << "without news they are as they were";
  run(1, wheels(false));
  EXPECT_FALSE(sees(Fault::drives_cut));
  driving = false;
  run(30, wheels(true));
  EXPECT_FALSE(sees(Fault::drives_cut)) << "nothing was commanded";
  driving = true;
  active = false;
  run(30, wheels(true));
  active = true;
  EXPECT_FALSE(sees(Fault::drives_cut));
}

TEST_F(VigilanceRules, DrivesThatSaidItOnceCutUntilTheySayOtherwise) {
  pass(1, wheels(true));
  run(20);
  EXPECT_TRUE(sees(Fault::drives_cut));
}

TEST_F(VigilanceRules, DrivesThatNeverSaidSoDoNotCut) {
  run(30);
  EXPECT_FALSE(sees(Fault::drives_cut));
}

TEST_F(VigilanceRules, InvalidWheelStatesAreACauseOnceNoneIsFresh) {
  pass(1, wheels());
  pass(1, invalid_wheels());
  EXPECT_FALSE(sees(Fault::wheel_state_invalid));
  pass(20);
  EXPECT_TRUE(sees(Fault::wheel_state_invalid));
  active = false;
  EXPECT_TRUE(sees(Fault::wheel_state_invalid)) << "armed or not";
  active = true;
  pass(1, wheels());
  EXPECT_FALSE(sees(Fault::wheel_state_invalid));
  pass(21);
  EXPECT_FALSE(sees(Fault::wheel_state_invalid)) << "what was taken ended it";
}

TEST_F(VigilanceRules, InvalidPicturesAreACauseOnceNoneIsFresh) {
  pass(1);
  vigilance.see_picture(PictureResult::taken, tick, tick);
  pass(1, invalid_vision());
  EXPECT_FALSE(sees(Fault::vision_invalid));
  pass(150);
  EXPECT_TRUE(sees(Fault::vision_invalid));
  active = false;
  EXPECT_TRUE(sees(Fault::vision_invalid));
  vigilance.see_picture(PictureResult::taken, tick, tick);
  EXPECT_FALSE(sees(Fault::vision_invalid));
  pass(151);
  EXPECT_FALSE(sees(Fault::vision_invalid));
}

TEST_F(VigilanceRules, ImplausiblePicturesAreACauseOnceNoneIsFresh) {
  pass(1);
  vigilance.see_picture(PictureResult::taken, tick, tick);
  vigilance.see_picture(PictureResult::implausible, tick, tick);
  EXPECT_FALSE(sees(Fault::vision_implausible));
  pass(151);
  EXPECT_TRUE(sees(Fault::vision_implausible));
  EXPECT_FALSE(has(vigilance.causes(false), Fault::vision_implausible));
  vigilance.see_picture(PictureResult::taken, tick, tick);
  pass(151);
  EXPECT_FALSE(sees(Fault::vision_implausible));
  vigilance.see_picture(PictureResult::implausible, tick, tick);
  vigilance.forget_pictures();
  EXPECT_FALSE(sees(Fault::vision_implausible));
}

TEST_F(VigilanceRules, TwoMismatchesInARowAreACause) {
  pass(1);
  vigilance.see_picture(PictureResult::mismatched, tick, tick);
  EXPECT_FALSE(sees(Fault::motion_mismatch));
  vigilance.see_picture(PictureResult::taken, tick, tick);
  vigilance.see_picture(PictureResult::mismatched, tick, tick);
  EXPECT_FALSE(sees(Fault::motion_mismatch));
  vigilance.see_picture(PictureResult::between, tick, tick);
  vigilance.see_picture(PictureResult::mismatched, tick, tick);
  EXPECT_TRUE(sees(Fault::motion_mismatch)) << "what was not measured is no excuse";
  EXPECT_FALSE(has(vigilance.causes(false), Fault::motion_mismatch));
  EXPECT_TRUE(vigilance.vision_is_fresh());
  vigilance.forget_pictures();
  EXPECT_FALSE(sees(Fault::motion_mismatch));
  vigilance.see_picture(PictureResult::mismatched, tick, tick);
  EXPECT_FALSE(sees(Fault::motion_mismatch)) << "the ones before are forgotten";
}

TEST_F(VigilanceRules, ImpossibleWheelsAreACauseInTheirTick) {
  pass(1);
  vigilance.see_impossible_wheels();
  EXPECT_TRUE(sees(Fault::wheels_implausible));
  EXPECT_FALSE(has(vigilance.causes(false), Fault::wheels_implausible));
  pass(1);
  EXPECT_FALSE(sees(Fault::wheels_implausible));
}

TEST_F(VigilanceRules, SevenWrongFramesOfOperatorsAtOnceAreNoCause) {
  active = false;
  for (int i = 0; i < 7; ++i) {
    pass(0, wrong_operator());
  }
  EXPECT_FALSE(sees(Fault::operator_invalid));
  pass(0, wrong_operator());
  EXPECT_TRUE(sees(Fault::operator_invalid));
}

TEST_F(VigilanceRules, EightWrongFramesOfOperatorsIn16TicksAreACause) {
  active = false;
  run(7, wrong_operator());
  EXPECT_FALSE(sees(Fault::operator_invalid));
  run(1, wrong_operator());
  EXPECT_TRUE(sees(Fault::operator_invalid)) << "8 * 16 - 7 of 112";
  run(8);
  EXPECT_TRUE(sees(Fault::operator_invalid));
  run(1);
  EXPECT_FALSE(sees(Fault::operator_invalid));
}

TEST_F(VigilanceRules, AnyNumberOfWrongFramesIsForgottenWithin224Ticks) {
  run(1000, wrong_operator());
  run(111);
  EXPECT_TRUE(sees(Fault::operator_invalid));
  run(1);
  EXPECT_FALSE(sees(Fault::operator_invalid));
  pass(0x7FFFFFFF);
  EXPECT_FALSE(sees(Fault::operator_invalid)) << "and does not wrap";
}

TEST_F(VigilanceRules, ASecondControllerIsACauseFor1000Ticks) {
  Percepts second;
  second.second_controller = true;
  active = false;
  pass(1, second);
  EXPECT_TRUE(sees(Fault::second_controller));
  pass(999);
  EXPECT_TRUE(sees(Fault::second_controller));
  pass(1);
  EXPECT_FALSE(sees(Fault::second_controller));
}

}  // namespace
}  // namespace striker::core
