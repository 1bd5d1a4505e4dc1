// SPDX-License-Identifier: Apache-2.0
// A team that is shown a match in a mirror does there what it does here: left and right wheels change places. The rules
// do so but for rounding (180 degrees is to the left of a robot in either), and where they are published otherwise:
//   goalkeeper  a ball ahead of it in its area: 60 degrees to its left it gives up, to its right it does not look;
//               right behind it: it turns to +90 degrees
//   all         something at exactly y = 0 counts as left; a target under the robot lies at +90 degrees (no draw
//               of this test comes there)
//   passing     who is stuck goes to the centre at y > 0 alone, which side a robot faces is lost in an arc cosine
#include <gtest/gtest.h>

#include "sil/match/team/plane.hpp"
#include "sil/match/team/rules/sight.hpp"
#include "sil/match/team/strategies.hpp"
#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

bool are_mirrored(const RobotOrder& first, const RobotOrder& second) {
  if (first.index() != second.index()) {
    return false;
  }
  if (const auto* motion = std::get_if<MotionOrder>(&first)) {
    const auto& there = std::get<MotionOrder>(second);
    return motion->number == there.number && std::abs(motion->target.y_m + there.target.y_m) < 1e-12 &&
           std::abs(motion->target.heading_rad + there.target.heading_rad) < 1e-12;
  }
  const auto& here = std::get<SpeedOrder>(first);
  const auto& there = std::get<SpeedOrder>(second);
  return std::abs(here.left_m_s - there.right_m_s) < 1e-12 &&
         std::abs(here.right_m_s - there.left_m_s) < 1e-12;
}

bool is_played_by_the_tables(const TeamView& view) {
  return view.state == GameState::open_play || view.state == GameState::corner;
}

// Rows four and five of the goalkeeper's table, and their mirrors.
bool is_one_sided(const TeamView& view) {
  const Pose& keeper = view.own[goalkeeper_id].pose;
  if (!in_own_penalty_area(place_of(keeper)) || !in_own_penalty_area(view.ball_m)) {
    return false;
  }
  if (view.ball_m.x < keeper.x_m) {
    return std::abs(view.ball_m.y - keeper.y_m) <= 0.3;
  }
  return std::abs(wrapped_rad(bearing_rad(place_of(keeper), view.ball_m) - keeper.heading_rad)) >
         radians(60.0);
}

class MirroredRules : public testing::TestWithParam<std::string_view> {};

TEST_P(MirroredRules, DoTheSameInAMirror) {
  const auto team = make_strategy(GetParam(), 1);
  const auto in_mirror = make_strategy(GetParam(), 1);
  RandomViews views(21);
  bool keeper_differs = false;  // its last order, which set pieces repeat
  int one_sided = 0;
  for (int frame = 0; frame < 50'000; ++frame) {
    const TeamView& view = views.next();
    const TeamOrders orders = team->play(view);
    const TeamOrders in_mirror_orders = in_mirror->play(mirrored(view));
    if (is_played_by_the_tables(view)) {
      keeper_differs = is_one_sided(view);
      one_sided += keeper_differs ? 1 : 0;
    }
    for (std::size_t id = keeper_differs ? 1 : 0; id < robots_a_team; ++id) {
      ASSERT_TRUE(are_mirrored(*orders[id], *in_mirror_orders[id]))
          << "robot " << id << " in frame " << frame;
    }
  }
  EXPECT_GT(one_sided, 10);
  EXPECT_LT(one_sided, 2'000);
}

INSTANTIATE_TEST_SUITE_P(Rules, MirroredRules, testing::Values("rules", "rules-published"),
                         [](const auto& one) { return one.param == "rules" ? "corrected" : "published"; });

class MirroredStriker : public testing::TestWithParam<std::string_view> {};

TEST_P(MirroredStriker, DoesTheSameInAMirror) {
  const auto team = make_strategy(GetParam(), 1);
  const auto in_mirror = make_strategy(GetParam(), 1);
  RandomViews views(22);
  int kicks = 0;
  for (int frame = 0; frame < 50'000; ++frame) {
    const TeamView& view = views.next();
    const TeamOrders orders = team->play(view);
    const TeamOrders in_mirror_orders = in_mirror->play(mirrored(view));
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      ASSERT_TRUE(are_mirrored(*orders[id], *in_mirror_orders[id]))
          << "robot " << id << " in frame " << frame;
      kicks += std::holds_alternative<MotionOrder>(*orders[id]) ? 1 : 0;
    }
  }
  EXPECT_EQ(kicks > 0, GetParam() == "striker");
}

INSTANTIATE_TEST_SUITE_P(Striker, MirroredStriker, testing::Values("striker", "striker-driving"),
                         [](const auto& one) { return one.param == "striker" ? "kicks" : "drives"; });

}  // namespace
}  // namespace striker::sil
