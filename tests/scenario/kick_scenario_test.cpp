// SPDX-License-Identifier: Apache-2.0
// The kick scenario with the controller in process: same bytes for the same seed, episodes that stand alone.
#include "sil/scenario/kick_scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sil/bus/in_process_link.hpp"
#include "tests/scenario/kick_rig.hpp"

namespace striker::sil {
namespace {

std::vector<StampedFrame> bus_of(PlantKind plant, const KickPlan& plan) {
  InProcessLink link;
  BusRecord bus;
  KickRig(link, plant).play(plan, {&bus});
  return bus.frames;
}

std::vector<KickOutcome> outcomes_of(PlantKind plant, const KickPlan& plan) {
  InProcessLink link;
  return KickRig(link, plant).play(plan);
}

void expect_same(const KickOutcome& a, const KickOutcome& b) {
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.contact_decision, b.contact_decision);
  EXPECT_EQ(a.theta_contact_rad, b.theta_contact_rad);
  EXPECT_EQ(a.v_contact_m_s, b.v_contact_m_s);
  EXPECT_EQ(a.reward, b.reward);
  EXPECT_EQ(a.ball_speed_m_s, b.ball_speed_m_s);
  EXPECT_EQ(a.kicked, b.kicked);
}

TEST(KickScenario, TheSameSeedGivesTheSameBus) {
  for (const PlantKind plant : plant_kinds) {
    const KickPlan plan{.seed = 5, .episodes = 3};
    const auto once = bus_of(plant, plan);
    EXPECT_FALSE(once.empty());
    ASSERT_NO_FATAL_FAILURE(expect_same(once, bus_of(plant, plan)));
  }
}

TEST(KickScenario, AnotherSeedGivesAnotherBus) {
  const auto five = bus_of(PlantKind::drive, {.seed = 5, .episodes = 1});
  const auto six = bus_of(PlantKind::drive, {.seed = 6, .episodes = 1});
  const auto equal = [](const StampedFrame& a, const StampedFrame& b) { return a.frame == b.frame; };
  EXPECT_FALSE(std::equal(five.begin(), five.end(), six.begin(), six.end(), equal));
}

TEST(KickScenario, AnEpisodeAloneIsTheEpisodeAfterManyOthers) {
  for (const PlantKind plant : plant_kinds) {
    const auto all = outcomes_of(plant, {.pose = PoseMode::anywhere, .episodes = 40});
    for (const std::uint64_t i : {1U, 17U, 39U}) {
      const auto alone = outcomes_of(plant, {.pose = PoseMode::anywhere, .first_episode = i, .episodes = 1});
      ASSERT_EQ(alone.size(), 1U);
      expect_same(alone.front(), all[i]);
    }
  }
}

// Every wheel command of a run, told apart from the state that the status frames report.
TEST(KickScenario, TorqueOnlyWhileActive) {
  auto state = core::State::boot;
  std::size_t driven = 0;
  for (const auto& [frame, received_ns] : bus_of(PlantKind::drive, {.episodes = 5})) {
    can::Status status;
    can::WheelCommand command;
    if (can::is<can::Status>(frame) && can::receive(frame, status) == can::Verdict::accepted) {
      state = static_cast<core::State>(status.state);
    } else if (can::is<can::WheelCommand>(frame) && can::receive(frame, command) == can::Verdict::accepted &&
               (command.left_torque_mNm != 0 || command.right_torque_mNm != 0)) {
      ++driven;
      ASSERT_EQ(state, core::State::active);
    }
  }
  EXPECT_GT(driven, 100U);
}

TEST(KickScenario, StopsBetweenTicksAndKeepsWhatWasDone) {
  InProcessLink link;
  std::uint32_t ticks = 0;
  AtEndOfTick count([&](const Snapshot&) { ++ticks; });
  const auto outcomes = KickRig(link, PlantKind::servo).play({.episodes = 1000}, {&count}, [&] {
    return ticks == kick_boot_ticks + 2 * kick_episode_ticks + 700;
  });
  EXPECT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(ticks, kick_boot_ticks + 2 * kick_episode_ticks + 700 + 1) << "a tick more, to disarm";
  EXPECT_EQ(link.controller().state(), core::State::standby);
}

}  // namespace
}  // namespace striker::sil
