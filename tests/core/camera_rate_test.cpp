// SPDX-License-Identifier: Apache-2.0
// The estimator and the decisions' clock with cameras of other rates than a picture a decision: a ball that rolls and a
// robot that gains speed, seen late and in whole ms, are where they truly are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "firmware/core/decision_clock.hpp"
#include "firmware/core/estimation/estimator.hpp"

namespace striker::core {
namespace {

constexpr std::int32_t ball_mm_s = 3'000;
constexpr std::array rates_Hz = {10, 15, 20, 25, 30, 50, 55, 60, 75, 90, 100};

constexpr RobotProfile with_camera(std::int32_t rate_Hz, std::int32_t latency_ms) {
  RobotDescription described = forward;
  described.camera_rate_Hz = rate_Hz;
  described.camera_latency_ms = latency_ms;
  return profile_of(described);
}

// The world, a camera that takes a picture in each tick that reaches n / rate, and an estimator that is told of one.
class Bench {
 public:
  Bench(const RobotProfile& told, std::int32_t rate_Hz, std::int32_t latency_ms)
      : told_(told), rate_Hz_(rate_Hz), latency_ms_(latency_ms) {}

  // One tick on.
  PictureResult pass() {
    const std::int32_t speed_mm_s = robot_speed_at(++tick_);
    robot_um_.at(static_cast<std::size_t>(tick_)) =
        robot_um_.at(static_cast<std::size_t>(tick_ - 1)) + speed_mm_s;
    odometry_.take({speed_mm_s, speed_mm_s});
    const std::int32_t taken = tick_ - latency_ms_;
    if (taken > 0 && taken * rate_Hz_ / 1'000 != (taken - 1) * rate_Hz_ / 1'000) {
      show(taken * rate_Hz_ / 1'000, taken);
    }
    odometry_.advance(told_, static_cast<std::uint32_t>(tick_));
    return estimator_.end_tick(told_, odometry_);
  }

  void lose(std::int32_t number) { lost_ = number; }

  [[nodiscard]] bool has_velocity() const { return estimator_.has_velocity(); }
  [[nodiscard]] Estimate now() const { return estimator_.at(static_cast<std::uint32_t>(tick_), odometry_); }
  [[nodiscard]] std::int32_t ball_um() const { return ball_at(tick_); }
  [[nodiscard]] std::int32_t robot_um() const { return robot_um_.at(static_cast<std::size_t>(tick_)); }

 private:
  // 11 m/s^2, up and down.
  static std::int32_t robot_speed_at(std::int32_t tick) {
    const std::int32_t phase = tick % 400;
    return 11 * std::min(phase, 400 - phase);
  }
  static std::int32_t ball_at(std::int32_t tick) { return 4'000'000 - ball_mm_s * tick; }

  void show(std::int32_t number, std::int32_t taken) {
    if (number == lost_) {
      return;
    }
    const auto now = static_cast<std::uint32_t>(tick_);
    estimator_.take(RobotSighting{.picture = number % picture_numbers,
                                  .position_um = {robot_um_.at(static_cast<std::size_t>(taken)), 0}},
                    now);
    estimator_.take(BallSighting{.picture = number % picture_numbers, .position_um = {ball_at(taken), 0}},
                    now);
  }

  RobotProfile told_;
  std::int32_t rate_Hz_;
  std::int32_t latency_ms_;
  std::int32_t lost_ = -1;
  std::int32_t tick_ = 0;
  std::array<std::int32_t, 3'000> robot_um_{};
  Estimator estimator_;
  Odometry odometry_;
};

// A ms of rounding in 50 is 2 %. Numbers come again after 160 ms to 1.6 s.
TEST(CameraRate, BallAndRobotAreFoundAtEveryRate) {
  for (const std::int32_t rate_Hz : rates_Hz) {
    for (const std::int32_t latency_ms : {0, 7, 35, 50}) {
      const std::string seen = std::to_string(rate_Hz) + " Hz, " + std::to_string(latency_ms) + " ms";
      Bench bench(with_camera(rate_Hz, latency_ms), rate_Hz, latency_ms);
      for (std::int32_t tick = 1; tick < 2'500; ++tick) {
        const PictureResult result = bench.pass();
        ASSERT_TRUE(result == PictureResult::none || is_new(result)) << seen << ", tick " << tick;
        ASSERT_NE(result, PictureResult::mismatched) << seen << ", tick " << tick;
        if (tick > 350) {
          const Estimate now = bench.now();
          ASSERT_NEAR(now.ball_velocity_mm_s.x, -ball_mm_s, ball_mm_s * 0.02) << seen << ", tick " << tick;
          ASSERT_NEAR(now.ball_um.x, bench.ball_um(), 8'000) << seen << ", tick " << tick;
          ASSERT_NEAR(now.robot_um.x, bench.robot_um(), 2'000) << seen << ", tick " << tick;
        }
      }
    }
  }
}

// 60 Hz is no whole number of ms, but three pictures are 50.
TEST(CameraRate, WhereADecisionIsAWholeNumberOfPicturesNothingIsLost) {
  for (const std::int32_t rate_Hz : {20, 40, 60, 80, 100}) {
    Bench bench(with_camera(rate_Hz, 35), rate_Hz, 35);
    for (std::int32_t tick = 1; tick < 2'500; ++tick) {
      bench.pass();
      if (tick > 250) {
        ASSERT_NEAR(bench.now().ball_velocity_mm_s.x, -ball_mm_s, 1) << rate_Hz << " Hz, tick " << tick;
        ASSERT_NEAR(bench.now().ball_um.x, bench.ball_um(), 100) << rate_Hz << " Hz, tick " << tick;
      }
    }
  }
}

TEST(CameraRate, AVelocityIsDrawnOverAboutADecision) {
  for (const auto& [rate_Hz, first_tick] :
       {std::array{10, 200}, {20, 100}, {30, 100}, {50, 80}, {60, 67}, {100, 60}}) {
    Bench bench(with_camera(rate_Hz, 0), rate_Hz, 0);
    std::int32_t tick = 0;
    while (!bench.has_velocity()) {
      bench.pass();
      ++tick;
    }
    EXPECT_EQ(tick, first_tick) << rate_Hz << " Hz";
  }
}

TEST(CameraRate, ALostPictureCostsNoVelocity) {
  for (const std::int32_t rate_Hz : {20, 60, 100}) {
    for (std::int32_t lost = 30; lost < 46; ++lost) {
      Bench bench(with_camera(rate_Hz, 35), rate_Hz, 35);
      bench.lose(lost);
      for (std::int32_t tick = 1; tick < 2'500; ++tick) {
        ASSERT_NE(bench.pass(), PictureResult::implausible);
        if (tick > 250) {
          ASSERT_NEAR(bench.now().ball_velocity_mm_s.x, -ball_mm_s, ball_mm_s * 0.02)
              << rate_Hz << " Hz, tick " << tick;
        }
      }
    }
  }
}

// Long before a kick is over no picture is taken, for longer than one stays fresh.
TEST(CameraRate, AnotherRateThanDescribedIsNotBelieved) {
  for (const std::int32_t told_Hz : {10, 20, 50, 60, 100}) {
    for (const std::int32_t rate_Hz : {10, 15, 20, 30, 50, 60, 75, 100}) {
      Bench bench(with_camera(told_Hz, 0), rate_Hz, 0);
      bool refused = false;
      std::uint32_t without = 0;
      for (std::uint32_t tick = 1; tick < 2'500 && without <= vision_timeout_ticks; ++tick) {
        const PictureResult result = bench.pass();
        refused = refused || result == PictureResult::implausible;
        without = is_new(result) ? 0 : without + 1;
      }
      EXPECT_EQ(refused && without > vision_timeout_ticks, rate_Hz != told_Hz)
          << rate_Hz << " Hz, told " << told_Hz;
    }
  }
}

// With a camera that moves otherwise than the wheels in pictures of which each alone would pass for slip.
TEST(CameraRate, AFastCameraIsHeldAgainstTheWheelsAllTheSame) {
  for (const std::int32_t rate_Hz : {20, 60, 100}) {
    const RobotProfile told = with_camera(rate_Hz, 0);
    Estimator estimator;
    Odometry odometry;
    int mismatches = 0;
    for (std::int32_t tick = 0; tick <= 1'000; ++tick) {
      const auto now = static_cast<std::uint32_t>(tick);
      odometry.take({2'000, 2'000});
      if (tick == 0 || tick * rate_Hz / 1'000 != (tick - 1) * rate_Hz / 1'000) {
        const std::int32_t number = tick * rate_Hz / 1'000 % picture_numbers;
        estimator.take(RobotSighting{.picture = number}, now);
        estimator.take(BallSighting{.picture = number}, now);
      }
      odometry.advance(told, now);
      mismatches += estimator.end_tick(told, odometry) == PictureResult::mismatched ? 1 : 0;
    }
    EXPECT_EQ(mismatches, 20) << rate_Hz << " Hz: one every 50 ms";
  }
}

// 200 decisions in 10 s, none of them twice, whatever the pictures do.
TEST(CameraRate, DecisionsComeEveryFiftyMilliseconds) {
  for (const std::int32_t rate_Hz : rates_Hz) {
    DecisionClock clock;
    std::uint32_t last_tick = 0;
    int decisions = 0;
    int on_picture = 0;
    for (std::int32_t tick = 0; tick < 10'000; ++tick) {
      const bool new_picture = tick == 0 || tick * rate_Hz / 1'000 != (tick - 1) * rate_Hz / 1'000;
      const DecisionDue due = clock.at(static_cast<std::uint32_t>(tick), new_picture,
                                       decides_on_each_picture(with_camera(rate_Hz, 0)));
      if (due != DecisionDue::no) {
        ASSERT_TRUE(decisions == 0 || static_cast<std::uint32_t>(tick) - last_tick == decision_period_ticks)
            << rate_Hz << " Hz, tick " << tick;
        last_tick = static_cast<std::uint32_t>(tick);
        ++decisions;
        on_picture += due == DecisionDue::on_picture ? 1 : 0;
      }
    }
    EXPECT_EQ(decisions, 200) << rate_Hz << " Hz";
    if (rate_Hz % 20 == 0) {
      EXPECT_EQ(on_picture, 200) << rate_Hz << " Hz: in phase";
    }
  }
}

}  // namespace
}  // namespace striker::core
