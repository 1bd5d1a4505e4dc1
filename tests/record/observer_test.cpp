// SPDX-License-Identifier: Apache-2.0
// What observers see of a run: every tick, in order, and the true world.
#include "sil/record/observer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sil/bus/in_process_link.hpp"
#include "tests/scenario/kick_rig.hpp"

namespace striker::sil {
namespace {

constexpr std::uint32_t boot_ticks = kick_boot_ticks;
constexpr std::uint32_t lead_ticks = 100;  // until decision 0
constexpr std::uint32_t episode_ticks = 2200;
const KickPlan plan{.pose = PoseMode::anywhere, .seed = 11, .first_episode = 4, .episodes = 2};

// Writes down what it is called with.
class Diary final : public Observer {
 public:
  std::string calls;            // b: begin_tick, t: end_tick, e: end_episode, r: end_run
  std::vector<Snapshot> ticks;  // their robots are kept beside them
  std::vector<RobotSnapshot> robots;
  std::vector<can::Frame> pictures;

  void begin_tick() override { calls += 'b'; }
  void end_tick(const Snapshot& snapshot) override {
    calls += 't';
    ticks.push_back(snapshot);
    ASSERT_EQ(snapshot.robots.size(), 1U);
    robots.push_back(snapshot.robots.front());
    for (const StampedFrame& stamped : snapshot.robots.front().frames) {
      if (can::is<can::VisionPose>(stamped.frame) || can::is<can::VisionBall>(stamped.frame)) {
        pictures.push_back(stamped.frame);
      }
    }
  }
  void end_episode() override { calls += 'e'; }
  void end_run() override { calls += 'r'; }
};

Diary watch() {
  InProcessLink link;
  Diary diary;
  KickRig(link).play(plan, {&diary});
  return diary;
}

TEST(Observer, SeesEveryTickOnceAndTheEndsOfEpisodesAndRun) {
  const Diary diary = watch();
  std::string expected;
  const auto ticks = [&](std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      expected += "bt";
    }
  };
  ticks(boot_ticks);
  for (std::uint64_t i = 0; i < plan.episodes; ++i) {
    ticks(episode_ticks);
    expected += 'e';
  }
  ticks(1);  // to disarm
  EXPECT_EQ(diary.calls, expected + "r");
  for (std::size_t i = 0; i < diary.ticks.size(); ++i) {
    ASSERT_EQ(diary.ticks[i].tick, i);
  }
}

TEST(Observer, KnowsWhichEpisodeItIsAndWhenItDecides) {
  const Diary diary = watch();
  for (std::uint32_t i = 0; i < 2 * episode_ticks; ++i) {
    const Snapshot& snapshot = diary.ticks[boot_ticks + i];
    ASSERT_EQ(snapshot.episode, plan.first_episode + i / episode_ticks);
    const std::uint32_t episode_tick = i % episode_ticks;
    ASSERT_EQ(snapshot.deciding, episode_tick >= lead_ticks && episode_tick < lead_ticks + 2000) << i;
  }
}

TEST(Observer, SeesTheRobotHeldAndTheBallLedUntilDecision0) {
  const Diary diary = watch();
  const KickStart start = draw_kick(plan.seed, plan.first_episode, plan.pose);
  for (std::uint32_t i = 0; i < lead_ticks; ++i) {
    const Snapshot& snapshot = diary.ticks[boot_ticks + i];
    const RobotSnapshot& robot = diary.robots[boot_ticks + i];
    const Vec2 ball = ball_before(start, (lead_ticks - i) * tick_s).position_m;
    ASSERT_EQ(robot.pose.x_m, start.robot.x_m);
    ASSERT_NEAR(robot.pose.heading_rad, start.robot.heading_rad, 1e-12);
    ASSERT_EQ(robot.velocity_m_s.x, 0.0);
    ASSERT_EQ(snapshot.ball.position_m.x, ball.x);
    ASSERT_EQ(snapshot.ball.position_m.y, ball.y);
  }
}

// A picture is taken before the world moves: it shows what the tick before has left, as far as its counts can.
TEST(Observer, SeesWhatTheCameraSeesWithoutItsRounding) {
  const Diary diary = watch();
  for (std::uint32_t i = lead_ticks + 50; i < episode_ticks; i += 50) {
    const std::size_t picture = std::size_t{2} * ((boot_ticks + i) / 50);
    can::VisionPose pose;
    can::VisionBall ball;
    ASSERT_EQ(can::receive(diary.pictures.at(picture), pose), can::Verdict::accepted);
    ASSERT_EQ(can::receive(diary.pictures.at(picture + 1), ball), can::Verdict::accepted);
    const std::size_t before = boot_ticks + i - 1;
    ASSERT_NEAR(pose.x_quarter_mm * 0.25e-3, diary.robots[before].pose.x_m, 0.126e-3) << i;
    ASSERT_NEAR(pose.y_quarter_mm * 0.25e-3, diary.robots[before].pose.y_m, 0.126e-3) << i;
    ASSERT_NEAR(ball.x_quarter_mm * 0.25e-3, diary.ticks[before].ball.position_m.x, 0.126e-3) << i;
    ASSERT_NEAR(ball.y_quarter_mm * 0.25e-3, diary.ticks[before].ball.position_m.y, 0.126e-3) << i;
  }
  EXPECT_GT(std::hypot(diary.robots[boot_ticks + episode_ticks - 1].velocity_m_s.x,
                       diary.robots[boot_ticks + episode_ticks - 1].velocity_m_s.y),
            0.0);
}

TEST(Observer, ChangesNothing) {
  InProcessLink watched;
  InProcessLink unwatched;
  Diary diary;
  const auto seen = KickRig(watched).play(plan, {&diary});
  const auto unseen = KickRig(unwatched).play(plan);
  ASSERT_EQ(seen.size(), unseen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].reward, unseen[i].reward);
    EXPECT_EQ(seen[i].ball_speed_m_s, unseen[i].ball_speed_m_s);
  }
}

}  // namespace
}  // namespace striker::sil
