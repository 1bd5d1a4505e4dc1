// SPDX-License-Identifier: Apache-2.0
// A robot's place: what it sends in which order, parts that a test replaces, and ten of them side by side.
#include "sil/robot/seat.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "sil/bus/in_process_link.hpp"
#include "sil/robot/striker_drives.hpp"
#include "sil/scenario/operator.hpp"
#include "sil/task/kick_task.hpp"

namespace striker::sil {
namespace {

class RecordingLink final : public ControllerLink {
 public:
  std::vector<can::Frame> sent;

  void send(std::uint32_t, std::span<const can::Frame> frames) override {
    sent.assign(frames.begin(), frames.end());
  }
  void collect(std::uint32_t, std::vector<can::Frame>&) override {}
};

template <class Message>
constexpr std::uint16_t id = can::layout<Message>.info.id;

std::vector<std::uint16_t> identifiers(const std::vector<can::Frame>& frames) {
  std::vector<std::uint16_t> ids;
  ids.reserve(frames.size());
  for (const can::Frame& frame : frames) {
    ids.push_back(frame.id);
  }
  return ids;
}

// A robot in a world of its own.
struct Robot {
  explicit Robot(ControllerLink& controller, bool lockstep = true)
      : world(kick_world(tick_s)),
        plant(make_plant(PlantKind::drive, 0, robot_spec(Role::forward))),
        seat(
            {.plant = *plant, .drives = drives, .camera = camera, .link = controller, .lockstep = lockstep}) {
  }

  World world;
  std::unique_ptr<Plant> plant;
  StrikerDrives drives;
  ExactCamera camera{0};
  Seat seat;
};

TEST(Seat, SendsWhatIsQueuedThenTheWheelStatesAndSyncLast) {
  RecordingLink link;
  Robot robot(link);
  Operator console;
  robot.seat.begin_tick(0);
  EXPECT_EQ(identifiers(link.sent), std::vector<std::uint16_t>{id<can::Sync>}) << "nothing was measured yet";
  robot.seat.end_tick(0);
  robot.seat.queue(console.order(can::Mode::arm));
  robot.seat.take_picture(robot.world, 1);
  robot.seat.begin_tick(1);
  EXPECT_EQ(identifiers(link.sent),
            (std::vector<std::uint16_t>{id<can::ModeCommand>, id<can::VisionPose>, id<can::VisionBall>,
                                        id<can::WheelState>, id<can::Sync>}));
}

TEST(Seat, OnAWallClockThereIsNoSync) {
  RecordingLink link;
  Robot robot(link, false);
  robot.seat.begin_tick(0);
  robot.seat.end_tick(0);
  robot.seat.begin_tick(1);
  EXPECT_EQ(identifiers(link.sent), std::vector<std::uint16_t>{id<can::WheelState>});
}

TEST(Seat, TheTrafficOfATickIsWhatItSentAndTheAnswerAtTheTick) {
  InProcessLink link;
  Robot robot(link);
  for (std::uint32_t tick = 0; tick < 3; ++tick) {
    robot.seat.begin_tick(tick);
    robot.seat.end_tick(tick);
  }
  const auto traffic = robot.seat.traffic();
  ASSERT_EQ(traffic.size(), 2 + robot.seat.answer().size());
  EXPECT_EQ(traffic[1].frame.id, id<can::Sync>);
  EXPECT_EQ(traffic.back().frame, robot.seat.answer().back());
  for (const StampedFrame& stamped : traffic) {
    EXPECT_EQ(stamped.received_ns, 2'000'000);
  }
}

// Sees everything this much further along x.
class ShiftedCamera final : public Camera {
 public:
  ShiftedCamera(Camera& camera, double shift_m) : camera_(&camera), shift_m_(shift_m) {}
  Picture look(const World& world) override {
    Picture picture = camera_->look(world);
    picture.robot.x_m += shift_m_;
    picture.ball_m.x += shift_m_;
    return picture;
  }

 private:
  Camera* camera_;
  double shift_m_;
};

TEST(Seat, ACamerasFaultForgesNoFrame) {
  RecordingLink link;
  Robot robot(link);
  robot.world.place_robot(0, {.x_m = 0.5, .y_m = -0.25, .heading_rad = 0.0});
  robot.world.place_ball({.position_m = {1.0, 2.0}, .velocity_m_s = {}});
  ShiftedCamera shifted(robot.camera, 0.1);
  Seat seat({.plant = *robot.plant, .drives = robot.drives, .camera = shifted, .link = link});
  seat.take_picture(robot.world, 0);
  seat.begin_tick(0);
  can::VisionPose pose;
  can::VisionBall ball;
  ASSERT_EQ(can::receive(link.sent.at(0), pose), can::Verdict::accepted);
  ASSERT_EQ(can::receive(link.sent.at(1), ball), can::Verdict::accepted);
  EXPECT_EQ(pose.x_quarter_mm, 600 * 4);
  EXPECT_EQ(pose.y_quarter_mm, -250 * 4);
  EXPECT_EQ(ball.x_quarter_mm, 1100 * 4);
  EXPECT_EQ(ball.y_quarter_mm, 2000 * 4);
}

// As where an episode's first pictures come at once and later ones late.
TEST(Seat, PicturesLeaveInTheOrderInWhichTheyAreDueAndAreNumberedSo) {
  RecordingLink link;
  Robot robot(link);
  robot.seat.take_picture(robot.world, 0, 5);
  robot.seat.reset();
  robot.seat.take_picture(robot.world, 0, 35);
  std::vector<std::pair<std::uint32_t, std::int32_t>> seen;
  for (std::uint32_t tick = 0; tick < 40; ++tick) {
    if (tick == 10 || tick == 20) {
      robot.seat.take_picture(robot.world, tick);
    }
    robot.seat.begin_tick(tick);
    can::VisionPose pose;
    if (can::is<can::VisionPose>(link.sent.front())) {
      ASSERT_EQ(can::receive(link.sent.front(), pose), can::Verdict::accepted);
      seen.emplace_back(tick, pose.frame);
    }
    robot.seat.end_tick(tick);
  }
  EXPECT_EQ(seen, (std::vector<std::pair<std::uint32_t, std::int32_t>>{{10, 0}, {20, 1}, {35, 2}}));
}

// ---- ten seats -----------------------------------------------------------------------------------------

constexpr std::uint32_t play_ticks = 1500;

struct Player {
  explicit Player(std::uint64_t episode) : start(draw_kick(3, episode, PoseMode::anywhere)) {
    robot.world.place_robot(0, start.robot);
    robot.world.place_ball(start.ball);
  }

  void prepare(std::uint32_t tick) {
    if (tick == 201) {
      robot.seat.queue(console.order(can::Mode::arm));
    } else if (const auto confirmation = console.confirmation()) {
      robot.seat.queue(*confirmation);
    }
    if (tick % 50 == 0) {
      robot.seat.take_picture(robot.world, 1);
    }
  }
  void finish(std::uint32_t tick) {
    answers.insert(answers.end(), robot.seat.answer().begin(), robot.seat.answer().end());
    console.hear(robot.seat.answer());
    robot.seat.actuate(robot.world, tick);
    robot.world.step();
    robot.seat.sense(robot.world);
  }

  InProcessLink controller;
  Robot robot{controller};
  Operator console;
  KickStart start;
  std::vector<can::Frame> answers;
};

// As a match would: everything is sent before the first answer is waited for.
void play(std::span<const std::unique_ptr<Player>> players) {
  for (std::uint32_t tick = 0; tick < play_ticks; ++tick) {
    for (const auto& player : players) {
      player->prepare(tick);
      player->robot.seat.begin_tick(tick);
    }
    for (const auto& player : players) {
      player->robot.seat.end_tick(tick);
    }
    for (const auto& player : players) {
      player->finish(tick);
    }
  }
}

TEST(Seat, TenSideBySideAnswerAsEachWouldAlone) {
  std::vector<std::unique_ptr<Player>> ten;
  for (std::uint64_t episode = 0; episode < 10; ++episode) {
    ten.push_back(std::make_unique<Player>(episode));
  }
  play(ten);
  for (std::uint64_t episode = 0; episode < 10; ++episode) {
    const std::array alone = {std::make_unique<Player>(episode)};
    play(alone);
    EXPECT_EQ(alone[0]->controller.controller().state(), core::State::active) << episode;
    EXPECT_GT(alone[0]->answers.size(), play_ticks);
    EXPECT_TRUE(alone[0]->answers == ten[episode]->answers) << episode;
  }
  EXPECT_FALSE(ten[0]->answers == ten[1]->answers) << "the ten have nothing to tell apart";
}

}  // namespace
}  // namespace striker::sil
