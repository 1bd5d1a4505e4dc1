// SPDX-License-Identifier: Apache-2.0
// Whatever a team is shown: its orders are finite and within its robots' limits, and the same again.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sil/match/team/strategies.hpp"
#include "sil/match/team/top_speed.hpp"
#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

constexpr int frames = 20'000;

void expect_possible(const TeamOrders& orders) {
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    ASSERT_TRUE(orders[id].has_value());
    if (const auto* wheels = std::get_if<SpeedOrder>(&*orders[id])) {
      const double limit_m_s = top_speed_m_s(id) * (1.0 + 1e-12);
      ASSERT_LE(std::abs(wheels->left_m_s), limit_m_s);  // false for what is no number
      ASSERT_LE(std::abs(wheels->right_m_s), limit_m_s);
    } else {
      const Pose target = std::get<MotionOrder>(*orders[id]).target;
      ASSERT_TRUE(std::isfinite(target.x_m) && std::isfinite(target.y_m) &&
                  std::isfinite(target.heading_rad));
    }
  }
}

class AnyTeam : public testing::TestWithParam<StrategyName> {};

TEST_P(AnyTeam, OrdersWhatItsRobotsCanDo) {
  const auto team = make_strategy(GetParam().name, 7);
  RandomViews views(11);
  for (int frame = 0; frame < frames && !HasFatalFailure(); ++frame) {
    SCOPED_TRACE(frame);
    expect_possible(team->play(views.next()));
  }
}

TEST_P(AnyTeam, DoesSoWhenItIsShownNonsense) {
  const auto team = make_strategy(GetParam().name, 7);
  RandomViews views(12);
  for (int frame = 0; frame < frames && !HasFatalFailure(); ++frame) {
    SCOPED_TRACE(frame);
    expect_possible(team->play(views.next_broken()));
  }
}

TEST_P(AnyTeam, SaysTheSameAgain) {
  const auto team = make_strategy(GetParam().name, 7);
  const auto again = make_strategy(GetParam().name, 7);
  RandomViews views(13);
  for (int frame = 0; frame < frames; ++frame) {
    const TeamView& view = views.next();
    ASSERT_EQ(team->play(view), again->play(view)) << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(All, AnyTeam, testing::ValuesIn(strategy_names().begin(), strategy_names().end()),
                         [](const auto& one) {
                           std::string name(one.param.name);
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace striker::sil
