// SPDX-License-Identifier: Apache-2.0
// The controller dies in mid-run, and comes back: the drives act by themselves, and nobody arms it unasked.
#include <gtest/gtest.h>

#include <vector>

#include "sil/bus/in_process_link.hpp"
#include "sil/fault/faulty_link.hpp"
#include "tests/scenario/kick_rig.hpp"

namespace striker::sil {
namespace {

constexpr std::uint32_t first_decision = kick_boot_ticks + kick_first_decision_tick;
constexpr std::uint32_t second_episode = kick_boot_ticks + kick_episode_ticks;
constexpr std::uint32_t lost = first_decision + 700;
constexpr std::uint32_t back = lost + 300;

TEST(LostController, TheDrivesCutWithinTenMillisecondsAndOnlyAnArmBringsTorqueBack) {
  InProcessLink controller;
  FaultyLink link(controller, {{.from = lost, .until = back}}, [&] { controller = {}; });
  KickRig rig(link);
  std::vector<bool> cut;
  std::vector<core::State> states;
  AtEndOfTick watch([&](const Snapshot& snapshot) {
    cut.push_back(rig.drives.cut(snapshot.tick));
    states.push_back(controller.controller().state());
  });
  EXPECT_EQ(rig.play({.episodes = 2}, {&watch}).size(), 2U);
  EXPECT_FALSE(cut[lost - 1]);
  for (std::uint32_t tick = lost + 9; tick < back; ++tick) {
    ASSERT_TRUE(cut[tick]) << tick;
  }
  for (std::uint32_t tick = back; tick < second_episode + 51; ++tick) {
    ASSERT_NE(states[tick], core::State::active) << tick;
  }
  EXPECT_EQ(states[second_episode + 60], core::State::active);
}

// A camera that comes back is believed after six steps: too late for the next episode, and in time for the one after.
TEST(LostController, WithoutPicturesItFaultsAndTheEpisodeAfterTheNextClearsAndArmsIt) {
  InProcessLink controller;
  FaultyLink link(
      controller,
      {{.from = lost, .until = second_episode, .lost_identifier = can::layout<can::VisionPose>.info.id}});
  std::vector<core::Fault> faults;
  std::vector<core::State> states;
  AtEndOfTick watch([&](const Snapshot&) {
    faults.push_back(controller.controller().fault());
    states.push_back(controller.controller().state());
  });
  KickRig(link).play({.episodes = 3}, {&watch});
  EXPECT_EQ(states[lost - 1], core::State::active);
  EXPECT_EQ(faults[lost + 210], core::Fault::vision_lost);
  EXPECT_EQ(states[second_episode + kick_episode_ticks + 60], core::State::active);
}

}  // namespace
}  // namespace striker::sil
