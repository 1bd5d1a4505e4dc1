// SPDX-License-Identifier: Apache-2.0
// What wheels and pictures cannot be, at the limits, and for robots 10 % off the description.
#include "firmware/core/estimation/plausibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace striker::core {
namespace {

constexpr RobotProfile robot = profile_of(forward);

// A rim under full torque that gains `factor` of what the profile expects; how often that was impossible.
int impossible_with(double factor, double told_factor, int ticks = 200) {
  WheelPlausibility plausibility;
  double speed_mm_s = 0.0;
  int impossible = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    const bool forwards = tick / 50 % 2 == 0;  // a reversal every decision
    const std::int32_t torque_mNm = forwards ? robot.torque_limit_mNm : -robot.torque_limit_mNm;
    speed_mm_s += factor * 27.8e-3 * torque_mNm;  // mm/s in a tick of 1 ms, for each mNm
    const auto told = static_cast<std::int32_t>(told_factor * speed_mm_s);
    const WheelTorques torque{torque_mNm, torque_mNm};
    impossible +=
        plausibility.possible(robot, static_cast<std::uint32_t>(tick), {told, told}, torque) ? 0 : 1;
  }
  return impossible;
}

TEST(WheelPlausibility, ARobotOfAnotherMassOrTorqueIsPossible) {
  for (const double factor : {0.0, 0.5, 0.9, 1.0, 1.1, 1.5}) {
    EXPECT_EQ(impossible_with(factor, 1.0), 0) << factor;
  }
}

TEST(WheelPlausibility, AReversedWheelIsImpossibleWithinThreeWindows) {
  for (const double factor : {0.9, 1.0, 1.1}) {
    EXPECT_GT(impossible_with(factor, -1.0, 50), 0) << factor;
  }
}

// A wheel that lands after it was free in the air.
TEST(WheelPlausibility, TwoJumpsArePossibleAndAThirdSoonAfterIsNot) {
  for (const std::int32_t jump_mm_s : {1'000, 1'001, 5'000}) {
    for (const std::uint32_t pause_ticks : {1U, 7U, 8U, 40U}) {
      WheelPlausibility plausibility;
      std::uint32_t tick = 100;
      EXPECT_TRUE(plausibility.possible(robot, tick, {}, {}));
      for (int jump = 1; jump <= 3; ++jump) {
        const std::int32_t speed_mm_s = jump % 2 == 1 ? jump_mm_s : 0;
        const bool third = jump == 3 && jump_mm_s > 1'000 && pause_ticks < 8;
        EXPECT_EQ(plausibility.possible(robot, ++tick, {0, speed_mm_s}, {}), !third)
            << jump_mm_s << " " << pause_ticks;
        for (std::uint32_t i = 1; i < pause_ticks && !third; ++i) {
          EXPECT_TRUE(plausibility.possible(robot, ++tick, {0, speed_mm_s}, {}));
        }
      }
    }
  }
}

TEST(WheelPlausibility, AGapExplainsAGreaterJump) {
  WheelPlausibility plausibility;
  std::uint32_t tick = 100;
  EXPECT_TRUE(plausibility.possible(robot, tick, {}, {}));
  for (int jump = 1; jump <= 10; ++jump) {
    tick += 3;
    EXPECT_TRUE(plausibility.possible(robot, tick, {jump % 2 == 1 ? 2'900 : 0, 0}, {}));
  }
}

TEST(WheelPlausibility, NoWheelIsTwiceAsFastAsItsTopSpeed) {
  for (const std::int32_t speed_mm_s : {2 * robot.top_rim_speed_mm_s, 2 * robot.top_rim_speed_mm_s + 1}) {
    WheelPlausibility plausibility;
    EXPECT_EQ(plausibility.possible(robot, 1, {0, -speed_mm_s}, {}),
              speed_mm_s <= 2 * robot.top_rim_speed_mm_s);
  }
}

// Free at the contact with the ball, it gets what is on its way, and comes back as slowly.
TEST(WheelPlausibility, WithLateCommandsAWheelMayBeTwiceAsFastForTwiceTheDelay) {
  RobotProfile late = robot;
  late.command_delay_ticks = 20;
  WheelPlausibility plausibility;
  std::uint32_t tick = 100;
  const auto possible = [&](std::int32_t speed_mm_s) {
    return plausibility.possible(late, ++tick, {speed_mm_s, 0}, {});
  };
  ASSERT_TRUE(possible(0));
  for (int again = 0; again < 3; ++again) {
    for (const std::int32_t speed_mm_s : {5'800, 5'000}) {
      for (int i = 0; i < 40; ++i) {
        ASSERT_TRUE(possible(speed_mm_s)) << again << ' ' << speed_mm_s << ' ' << i;
      }
    }
  }
  // One reading below it now and then is no excuse.
  for (int i = 0; i < 42; ++i) {
    ASSERT_TRUE(possible(i % 20 == 19 ? 5'000 : 5'800)) << i;
  }
  bool impossible = false;
  for (int i = 0; i < 4; ++i) {
    impossible = impossible || !possible(5'800);
  }
  EXPECT_TRUE(impossible);
}

constexpr RobotProfile with_camera(std::int32_t rate_Hz) {
  RobotDescription described = forward;
  described.camera_rate_Hz = rate_Hz;
  return profile_of(described);
}

TEST(PictureTiming, ANumberFitsItsTimeByLessThanAPeriod) {
  for (const auto& [rate_Hz, period_ms, tolerance_ms] :
       {std::array{10U, 100U, 90U}, {20U, 50U, 45U}, {50U, 20U, 18U}, {100U, 10U, 9U}}) {
    const RobotProfile told = with_camera(static_cast<std::int32_t>(rate_Hz));
    for (std::int32_t pictures = 1; pictures <= 3; ++pictures) {
      const std::uint32_t due = period_ms * static_cast<std::uint32_t>(pictures);
      const auto fits = [&](std::uint32_t ticks) { return PictureTiming{}.fits(told, pictures, ticks); };
      EXPECT_TRUE(fits(due - tolerance_ms) && fits(due) && fits(due + tolerance_ms)) << rate_Hz;
      EXPECT_FALSE(fits(due - tolerance_ms - 1) || fits(due + tolerance_ms + 1)) << rate_Hz;
    }
  }
}

// How many pictures of a camera are believed, of 1,000 at a rate, if each comes late or early by so much by turns.
int believed(const RobotProfile& told, double rate_Hz, int jitter_ms) {
  PictureTiming timing;
  const auto comes_at = [&](int picture) {
    return static_cast<std::uint32_t>(1'000 + std::ceil(picture * 1'000.0 / rate_Hz) +
                                      (picture % 2 == 0 ? jitter_ms : -jitter_ms));
  };
  for (int picture = 1; picture <= 1'000; ++picture) {
    const std::uint32_t elapsed = comes_at(picture) - comes_at(picture - 1);
    if (!timing.fits(told, 1, elapsed)) {
      return picture;
    }
    timing.take(told, 1, elapsed);
  }
  return 1'000;
}

TEST(PictureTiming, JitterAndARateThatIsNotExactAreBelieved) {
  for (const std::int32_t rate_Hz : {10, 20, 30, 50, 60, 75, 90, 100}) {
    const RobotProfile told = with_camera(rate_Hz);
    for (const double factor : {0.96, 0.999, 1.0, 1.001, 1.04}) {
      EXPECT_EQ(believed(told, factor * rate_Hz, 2), 1'000) << factor << " of " << rate_Hz << " Hz";
    }
  }
}

TEST(PictureTiming, ACameraOfAnotherRateIsNotBelievedForLong) {
  for (const std::int32_t rate_Hz : {10, 20, 30, 50, 60, 75, 90, 100}) {
    const RobotProfile told = with_camera(rate_Hz);
    for (const double factor : {0.33, 0.5, 0.8, 0.9, 1.1, 1.2, 1.5, 2.0, 3.0}) {
      EXPECT_LT(believed(told, factor * rate_Hz, 0), 40) << factor << " of " << rate_Hz << " Hz";
    }
  }
  EXPECT_LE(believed(with_camera(20), 60.0, 0), 3);
  EXPECT_LE(believed(with_camera(60), 20.0, 0), 1);
}

// In every direction, on an arc, with axle and radius 10 % off.
TEST(PicturePlausibility, WheelsAgreeWithARobotTenPercentOff) {
  for (std::int32_t heading = -32'000; heading < 32'000; heading += 1'000) {
    for (const double off : {0.9, 1.0, 1.1}) {
      Odometry odometry;
      odometry.take({2'000, 2'400});
      for (std::uint32_t tick = 1; tick <= 50; ++tick) {
        odometry.advance(robot, tick);
      }
      // 110 mm along an arc of 20 mm between the rims on 140 mm: 0.143 rad.
      const double turned = off * 0.142857 * 10'430.4;
      const auto end = static_cast<std::int32_t>(heading + turned);
      const Vector way = rotate({static_cast<std::int32_t>(off * 110'000), 0},
                                wrap_angle(static_cast<std::int32_t>(heading + turned / 2)));
      const Picture from{.number = 0, .robot_um = {}, .heading = wrap_angle(heading), .ball_um = {}};
      const Picture to{.number = 1, .robot_um = way, .heading = wrap_angle(end), .ball_um = {}};
      EXPECT_TRUE(wheels_agree(robot, from, to, odometry.until(50))) << heading << " " << off;
      const Picture backwards{
          .number = 1, .robot_um = {-way.x, -way.y}, .heading = wrap_angle(end), .ball_um = {}};
      EXPECT_FALSE(wheels_agree(robot, from, backwards, odometry.until(50))) << heading;
    }
  }
}

// Straight on, as it believes, at 2.5 m/s.
TEST(PicturePlausibility, WheelsAgreeThoughOneIsTenPercentSmaller) {
  for (const std::int32_t axle_um : {40'000, 60'000, 140'000, 1'000'000}) {
    for (const std::int32_t rate_Hz : {10, 12, 15, 20, 30, 100}) {
      RobotDescription described = forward;
      described.axle_length_um = axle_um;
      described.camera_rate_Hz = rate_Hz;
      const double rolled_um = 2'500'000.0 / rate_Hz * std::max(1.0, std::round(rate_Hz / 20.0));
      const double turned = 0.1 * rolled_um / axle_um;
      const double chord_um = 0.95 * rolled_um * std::sin(turned / 2) / (turned / 2);
      const Picture to{.number = 1,
                       .robot_um = {static_cast<std::int32_t>(chord_um * std::cos(turned / 2)),
                                    static_cast<std::int32_t>(chord_um * std::sin(turned / 2))},
                       .heading = wrap_angle(static_cast<std::int32_t>(turned * 10'430.4)),
                       .ball_um = {}};
      EXPECT_TRUE(wheels_agree(profile_of(described), {}, to,
                               {.travelled_um = static_cast<std::int32_t>(rolled_um), .turned_um = 0}))
          << axle_um << ' ' << rate_Hz;
    }
  }
}

// A narrow robot and a slow camera: more than a turn between two pictures, of a robot whose wheels are 10 % off.
TEST(PicturePlausibility, WheelsAgreeHoweverFarTheRobotTurns) {
  RobotDescription described = forward;
  described.axle_length_um = 60'000;
  described.camera_rate_Hz = 10;
  const RobotProfile narrow = profile_of(described);
  double furthest = 0.0;
  for (double left_m_s = -2.5; left_m_s <= 2.5; left_m_s += 0.25) {
    for (double right_m_s = -2.5; right_m_s <= 2.5; right_m_s += 0.25) {
      const Way rolled = {.travelled_um = static_cast<std::int32_t>(50'000 * (left_m_s + right_m_s)),
                          .turned_um = static_cast<std::int32_t>(100'000 * (right_m_s - left_m_s))};
      for (const double off : {0.9, 1.0, 1.1}) {
        const double turned = off * 0.1 * (right_m_s - left_m_s) / 0.060;
        const double chord_um =
            off * rolled.travelled_um * (turned == 0.0 ? 1.0 : std::sin(turned / 2) / (turned / 2));
        const Picture to{.number = 1,
                         .robot_um = {static_cast<std::int32_t>(chord_um * std::cos(turned / 2)),
                                      static_cast<std::int32_t>(chord_um * std::sin(turned / 2))},
                         .heading = wrap_angle(static_cast<std::int32_t>(turned * 10'430.4)),
                         .ball_um = {}};
        EXPECT_TRUE(wheels_agree(narrow, {}, to, rolled)) << left_m_s << ' ' << right_m_s << ' ' << off;
        const Picture elsewhere{.number = 1, .robot_um = {0, 700'000}, .heading = to.heading, .ball_um = {}};
        EXPECT_FALSE(wheels_agree(narrow, {}, elsewhere, rolled)) << left_m_s << ' ' << right_m_s;
        furthest = std::max(furthest, turned);
      }
    }
  }
  EXPECT_GT(furthest, 9.0) << "rad";
}

// 150 ms at the greatest speeds that a wheel state can carry: the sanitized build sees an overflow.
TEST(PicturePlausibility, NoWayOfTheNarrowestRobotLeaves32Bits) {
  RobotDescription narrow = forward;
  narrow.axle_length_um = 40'000;
  const auto agrees = [profile = profile_of(narrow)](std::int32_t turned_um) {
    return wheels_agree(profile, {}, {}, {.travelled_um = 0, .turned_um = turned_um});
  };
  EXPECT_EQ(agrees(-2'400'000), agrees(2'400'000));
}

}  // namespace
}  // namespace striker::core
