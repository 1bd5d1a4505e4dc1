// SPDX-License-Identifier: Apache-2.0
// Both halves and both colours are judged alike. The same frames are shown in both halves, turned or with the colours
// swapped, and give the same events, turned or swapped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/match/random_frames.hpp"

namespace striker::sil {
namespace {

constexpr int half_ms = 200'000;

RobotSet swapped(RobotSet set) {
  return (set >> robots_a_team) | (set << robots_a_team);
}
std::size_t swapped(std::size_t robot) {
  return robot_of(opponent_of(team_of(robot)), id_of(robot));
}
RefereeFrame swapped(const RefereeFrame& frame) {
  RefereeFrame result = frame;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    result.robots[swapped(robot)] = frame.robots[robot];
  }
  result.standing = swapped(frame.standing);
  result.touching = swapped(frame.touching);
  return result;
}
MatchEvent swapped(MatchEvent event) {
  event.team = event.team ? std::optional(opponent_of(*event.team)) : std::nullopt;
  event.robot = event.robot ? std::optional(swapped(*event.robot)) : std::nullopt;
  event.last_touch = swapped(event.last_touch);
  std::swap(event.counts[0], event.counts[1]);
  std::swap(event.distances_m[0], event.distances_m[1]);
  return event;
}
MatchEvent turned(MatchEvent event) {
  event.ball.position_m = turned(event.ball.position_m);
  event.exit_m = event.exit_m ? std::optional(turned(*event.exit_m)) : std::nullopt;
  if (event.robot_placement) {
    event.robot_placement = turned(*event.robot_placement);
  }
  if (event.ball_placement) {
    event.ball_placement->position_m = turned(event.ball_placement->position_m);
  }
  return event;
}

// All but what numbers the match through: seq, half, simulated time, score.
void expect_same(const MatchEvent& one, const MatchEvent& other) {
  EXPECT_EQ(one.kind, other.kind);
  EXPECT_EQ(one.cause, other.cause);
  EXPECT_EQ(one.clock_ms, other.clock_ms);
  EXPECT_EQ(one.team, other.team);
  EXPECT_EQ(one.robot, other.robot);
  EXPECT_EQ(one.set_piece, other.set_piece);
  EXPECT_EQ(one.last_touch, other.last_touch);
  EXPECT_EQ(one.counts, other.counts);
  EXPECT_EQ(one.distances_m, other.distances_m);
  EXPECT_EQ(one.timer_ms, other.timer_ms);
  EXPECT_EQ(one.ball.position_m, other.ball.position_m);
  EXPECT_EQ(one.exit_m, other.exit_m);
  EXPECT_EQ(one.ball_placement, other.ball_placement);
  EXPECT_EQ(one.spot_was_taken, other.spot_was_taken);
  ASSERT_EQ(one.robot_placement.has_value(), other.robot_placement.has_value());
  if (one.robot_placement) {
    EXPECT_EQ(one.robot_placement->x_m, other.robot_placement->x_m);
    EXPECT_EQ(one.robot_placement->y_m, other.robot_placement->y_m);
    const double turn = one.robot_placement->heading_rad - other.robot_placement->heading_rad;
    EXPECT_NEAR(std::remainder(turn, 2 * std::numbers::pi), 0.0, 1e-12);
  }
}

// In a frame red's robots are judged first: that is all that colours may change.
std::vector<MatchEvent> in_order(std::vector<MatchEvent> events) {
  std::ranges::stable_sort(events, {}, [](const MatchEvent& event) {
    return std::tuple(event.sim_ms, event.kind, event.robot.value_or(0));
  });
  return events;
}

struct Half {
  std::vector<RefereeFrame> frames;  // from the kickoff's second of settling to the end of the time
  std::vector<MatchEvent> events;    // of them
};

bool is_time_up(const Referee& referee) {
  return referee.ruling().clock_ms == half_ms;
}

// `prepare` may change each frame.
template <typename Prepare>
Half play_first_half(Referee& referee, std::uint64_t seed, Prepare prepare) {
  RandomFrames random(seed);
  Half half;
  while (!is_time_up(referee)) {
    RefereeFrame frame = random.after(referee.ruling());
    prepare(half.frames.size(), frame);
    const Ruling& ruling = referee.step(frame);
    half.frames.push_back(frame);
    half.events.insert(half.events.end(), ruling.events.begin(), ruling.events.end());
  }
  return half;
}

template <typename Change>
std::vector<MatchEvent> play_second_half(Referee& referee, const Half& first, Change change) {
  while (referee.ruling().half == 1) {
    referee.step({});
  }
  std::vector<MatchEvent> events;
  for (const RefereeFrame& frame : first.frames) {
    const Ruling& ruling = referee.step(change(frame));
    events.insert(events.end(), ruling.events.begin(), ruling.events.end());
  }
  EXPECT_TRUE(is_time_up(referee));
  return events;
}

MatchRules rules_with(int time_ms) {
  MatchRules rules = official();
  rules.half_ms = time_ms;
  return rules;
}

// Blue has in the second half what red had in the first: this end, and the kickoff.
TEST(RefereeMirror, TheSecondHalfIsTheFirstWithColoursSwapped) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Referee referee(rules_with(half_ms));
    const Half first = play_first_half(referee, seed, [](std::size_t, RefereeFrame& frame) {
      // On a line of symmetry 0 counts as blue's end.
      frame.ball.position_m.x += frame.ball.position_m.x == 0.0 ? 0.001 : 0.0;
      frame.ball.position_m.y += frame.ball.position_m.y == 0.0 ? 0.001 : 0.0;
    });
    const std::array<int, 2> score = referee.ruling().score;
    const auto events =
        play_second_half(referee, first, [](const RefereeFrame& frame) { return swapped(frame); });
    ASSERT_EQ(events.size(), first.events.size());
    EXPECT_GT(events.size(), 50U);
    std::vector<MatchEvent> expected;
    for (const MatchEvent& event : first.events) {
      expected.push_back(swapped(event));
    }
    const auto ordered = in_order(events);
    const auto ordered_expected = in_order(expected);
    for (std::size_t i = 0; i + 1 < events.size(); ++i) {  // the last are half_over and match_over
      expect_same(ordered[i], ordered_expected[i]);
    }
    EXPECT_EQ(referee.ruling().score[0], score[0] + score[1]);
    EXPECT_EQ(referee.ruling().score[1], score[0] + score[1]);
  }
}

// Once both halves have seen a goal of blue, red kicks off in both.
TEST(RefereeMirror, TheSecondHalfIsTheFirstTurned) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Referee referee(rules_with(half_ms));
    constexpr std::size_t settled = 20;  // frames
    const Half first = play_first_half(referee, seed, [](std::size_t number, RefereeFrame& frame) {
      if (number <= settled + 1) {
        frame = {};
        frame.ball.position_m = number <= settled ? Vec2{0.6, 0.0} : Vec2{-4.0, 0.0};
      }
    });
    ASSERT_EQ(first.events[2].kind, EventKind::goal);
    const auto events =
        play_second_half(referee, first, [](const RefereeFrame& frame) { return turned(frame); });
    ASSERT_EQ(events.size(), first.events.size());
    for (std::size_t i = 2; i + 1 < events.size(); ++i) {
      expect_same(events[i], turned(first.events[i]));
    }
  }
}

}  // namespace
}  // namespace striker::sil
