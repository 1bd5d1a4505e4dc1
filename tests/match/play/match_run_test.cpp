// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/match_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/match/play/watched_match.hpp"

namespace striker::sil {
namespace {

const MatchSetting rules_against_rules = {.teams = {"rules", "rules"}, .seed = 3, .half_s = 10};

TEST(MatchRun, SameSeedSameFrames) {
  std::array<std::uint64_t, 2> hashes = {};
  std::array<std::uint64_t, 2> states = {};
  for (std::size_t i = 0; i < 2; ++i) {
    ShortMatch match(rules_against_rules);
    BusHash buses;
    match.play({}, {&buses});
    EXPECT_TRUE(match.end.complete);
    EXPECT_GT(buses.frames(), 400'000U);
    hashes[i] = buses.hash();
    states[i] = match.end.state_hash;
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(states[0], states[1]);
}

TEST(MatchRun, AnotherSeedIsAnotherMatch) {
  ShortMatch one(rules_against_rules);
  one.play({}, {});
  MatchSetting setting = rules_against_rules;
  setting.seed = 4;
  ShortMatch other(setting);
  other.play({}, {});
  EXPECT_NE(one.end.state_hash, other.end.state_hash);
}

TEST(MatchRun, SimulatedTimeIsTheClockAndTheDeadTime) {
  ShortMatch match(rules_against_rules);
  int stops_s = 0;
  struct Stops final : MatchObserver {
    explicit Stops(int& into) : stops(&into) {}
    void frame(const MatchFrame& frame) override {
      for (const MatchEvent& event : frame.ruling.events) {
        *stops += event.kind == EventKind::goal ? 4 : 0;
        const bool stops_play = event.kind == EventKind::ball_out || event.kind == EventKind::crowding ||
                                event.kind == EventKind::deadlock;
        *stops += stops_play ? 2 : 0;
      }
    }
    int* stops;
  } stops(stops_s);
  match.play({&stops}, {});
  EXPECT_EQ(match.last.sim_ms, (2 * 10 + 1 + 4 + 3 + stops_s) * 1000);
}

// What every drive may do, from outside: only what the robot was ordered on its own bus within the last 151 ms, and
// nothing while the referee lets it not move.
class Watch final : public MatchObserver, public Observer {
 public:
  void frame(const MatchFrame& frame) override {
    ruling_ = frame.ruling;
    frame_begins_ = true;
  }

  void end_tick(const Snapshot& snapshot) override {
    ticks_in_frame_ = frame_begins_ ? 0 : ticks_in_frame_ + 1;
    frame_begins_ = false;
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      for (const StampedFrame& frame : snapshot.robots[robot].frames) {
        see(snapshot.tick, robot, frame.frame);
      }
    }
  }

  int driven = 0;  // wheel commands with a set-point
  int wrong = 0;
  std::string first;

 private:
  void see(std::uint32_t tick, std::size_t robot, const can::Frame& frame) {
    can::WheelOrder order;
    can::MotionOrder motion;
    can::WheelCommand command;
    if (can::is<can::WheelOrder>(frame) && can::receive(frame, order) == can::Verdict::accepted) {
      moves_until_[robot] = order.left_mm_s != 0 || order.right_mm_s != 0 ? tick + 151 : tick;
    } else if (can::is<can::MotionOrder>(frame) && can::receive(frame, motion) == can::Verdict::accepted) {
      moves_until_[robot] = tick + 151;
    } else if (can::is<can::WheelCommand>(frame) && can::receive(frame, command) == can::Verdict::accepted) {
      judge(tick, robot, command);
    }
  }

  void judge(std::uint32_t tick, std::size_t robot, const can::WheelCommand& command) {
    const bool has_set_point = command.left_set_point_2mm_s != 0 || command.right_set_point_2mm_s != 0;
    const bool has_torque = command.left_torque_mNm != 0 || command.right_torque_mNm != 0;
    driven += has_set_point ? 1 : 0;
    const bool stands = !ruling_.may_move(robot);
    const bool is_out = ruling_.sent_out[robot];
    if (has_set_point && (tick > moves_until_[robot] || stands)) {
      note(tick, robot, "a set-point without an order");
    }
    if (has_torque && is_out) {
      note(tick, robot, "a torque of one that was sent out");
    }
  }

  void note(std::uint32_t tick, std::size_t robot, const char* what) {
    if (wrong++ == 0) {
      first = "tick " + std::to_string(tick) + ", robot " + std::to_string(robot) + ": " + what;
    }
  }

  Ruling ruling_;
  bool frame_begins_ = false;
  std::uint32_t ticks_in_frame_ = 0;
  std::array<std::uint32_t, robots_in_match> moves_until_ = {};
};

TEST(MatchRun, NobodyDrivesWithoutAnOrderOrAgainstTheReferee) {
  for (const char* plant : {"servo", "drive"}) {
    MatchSetting setting = {.teams = {"rules", "random"}, .seed = 5, .half_s = 20, .plant = plant};
    ShortMatch match(setting);
    Watch watch;
    match.play({&watch}, {&watch});
    EXPECT_EQ(watch.wrong, 0) << watch.first;
    EXPECT_GT(watch.driven, 100'000);
  }
}

TEST(MatchRun, WhoIsFreeToMoveIsArmed) {
  struct Armed final : MatchObserver {
    void frame(const MatchFrame& frame) override {
      for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
        free += frame.ruling.may_move(robot) ? 1 : 0;
        armed += frame.ruling.may_move(robot) && frame.robots[robot].state == core::State::active ? 1 : 0;
      }
    }
    int free = 0;
    int armed = 0;
  } armed;
  ShortMatch match({.teams = {"rules", "rules"}, .seed = 3, .half_s = 20, .plant = "drive"});
  match.play({&armed}, {});
  EXPECT_GT(armed.armed, 0.97 * armed.free);
}

TEST(MatchRun, IsIncompleteWhereItWasStopped) {
  ShortMatch match(rules_against_rules);
  int frames = 0;
  match.play({}, {}, [&] { return ++frames > 40; });
  EXPECT_FALSE(match.end.complete);
  EXPECT_EQ(match.last.sim_ms, 40 * 50);
}

}  // namespace
}  // namespace striker::sil
