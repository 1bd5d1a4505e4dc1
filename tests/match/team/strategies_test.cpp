// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/strategies.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "sil/match/team/top_speed.hpp"
#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

TEST(Strategies, EachNameMakesATeam) {
  std::set<std::string_view> names;
  for (const auto& [name, help, orders_motions] : strategy_names()) {
    EXPECT_NE(make_strategy(name, 1), nullptr);
    EXPECT_FALSE(help.empty());
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(orders_motions, name == "striker") << name;
  }
  EXPECT_GE(names.size(), 5U);
}

TEST(Strategies, AnUnknownNameIsAnsweredWithThoseThatExist) {
  try {
    (void)make_strategy("dream-team", 1);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("dream-team"), std::string::npos);
    for (const auto& known : strategy_names()) {
      EXPECT_NE(std::string(error.what()).find(known.name), std::string::npos) << known.name;
    }
  }
}

TEST(Strategies, IdleStands) {
  for (const auto& order : make_strategy("idle", 1)->play(home_view())) {
    EXPECT_EQ(std::get<SpeedOrder>(order.value()), SpeedOrder{});
  }
}

TEST(Strategies, RandomDrawsEachWheelFromItsWholeRange) {
  const auto team = make_strategy("random", 1);
  std::array<double, robots_a_team> greatest = {};
  std::array<double, robots_a_team> least = {};
  std::array<double, robots_a_team> difference = {};
  for (int frame = 0; frame < 1000; ++frame) {
    const TeamOrders orders = team->play(home_view());
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      const auto& wheels = std::get<SpeedOrder>(orders[id].value());
      greatest[id] = std::max({greatest[id], wheels.left_m_s, wheels.right_m_s});
      least[id] = std::min({least[id], wheels.left_m_s, wheels.right_m_s});
      difference[id] = std::max(difference[id], std::abs(wheels.left_m_s - wheels.right_m_s));
    }
  }
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    const double top_m_s = top_speed_m_s(id);
    EXPECT_LE(greatest[id], top_m_s);
    EXPECT_GE(least[id], -top_m_s);
    EXPECT_GT(greatest[id], 0.98 * top_m_s);
    EXPECT_LT(least[id], -0.98 * top_m_s);
    EXPECT_GT(difference[id], 1.8 * top_m_s);
  }
}

TEST(Strategies, RandomIsItsSeed) {
  const auto first = make_strategy("random", 1);
  const auto again = make_strategy("random", 1);
  const auto other = make_strategy("random", 2);
  for (int frame = 0; frame < 10; ++frame) {
    const TeamOrders orders = first->play(home_view());
    EXPECT_EQ(orders, again->play(home_view()));
    EXPECT_NE(orders, other->play(home_view()));
  }
}

TEST(Strategies, ATopSpeedIsItsRoles) {
  constexpr std::array expected = {1.8, 2.1, 2.1, 2.55, 2.55};
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    EXPECT_EQ(top_speed_m_s(id), expected[id]);
  }
}

}  // namespace
}  // namespace striker::sil
