// The kick runner with the controller in process: same bytes for the same seed, episodes that stand alone.
#include "sil/scenario/kick_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sil/bus/in_process_link.hpp"

namespace striker::sil {
namespace {

struct Played {
  std::vector<can::Frame> bus;
  std::vector<KickOutcome> outcomes;
};

Played play(const KickRunOptions& options) {
  Played played;
  InProcessLink link;
  KickRunner runner(options, link,
                    {.begin_tick = {},
                     .end_tick =
                         [&](const TickRecord& record) {
                           played.bus.insert(played.bus.end(), record.frames->begin(), record.frames->end());
                         },
                     .end_episode = {},
                     .stop = {}});
  runner.run();
  played.outcomes = runner.outcomes();
  return played;
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

TEST(KickRun, TheSameSeedGivesTheSameBus) {
  for (const PlantKind plant : {PlantKind::servo, PlantKind::drive}) {
    const KickRunOptions options{.plant = plant, .seed = 5, .episodes = 3};
    const Played once = play(options);
    const Played again = play(options);
    EXPECT_FALSE(once.bus.empty());
    EXPECT_TRUE(once.bus == again.bus);
  }
}

TEST(KickRun, AnotherSeedGivesAnotherBus) {
  EXPECT_FALSE(play({.seed = 5, .episodes = 1}).bus == play({.seed = 6, .episodes = 1}).bus);
}

TEST(KickRun, AnEpisodeAloneIsTheEpisodeAfterManyOthers) {
  for (const PlantKind plant : {PlantKind::servo, PlantKind::drive}) {
    const std::vector<KickOutcome> all =
        play({.plant = plant, .pose = PoseMode::anywhere, .episodes = 40}).outcomes;
    for (const std::uint64_t i : {1U, 17U, 39U}) {
      const auto alone =
          play({.plant = plant, .pose = PoseMode::anywhere, .first_episode = i, .episodes = 1}).outcomes;
      ASSERT_EQ(alone.size(), 1U);
      expect_same(alone.front(), all[i]);
    }
  }
}

// Every wheel command of a run, told apart from the state that the status frames report.
TEST(KickRun, TorqueOnlyWhileActive) {
  const Played played = play({.episodes = 5});
  auto state = can::State::boot;
  std::size_t driven = 0;
  for (const can::Frame& frame : played.bus) {
    can::Status status;
    can::WheelCommand command;
    can::ReceiveCounter any;
    if (can::is<can::Status>(frame) && can::receive(frame, any, status) == can::Verdict::accepted) {
      state = static_cast<can::State>(status.state);
    } else if (can::is<can::WheelCommand>(frame) &&
               can::receive(frame, any, command) == can::Verdict::accepted &&
               (command.left_torque_mNm != 0 || command.right_torque_mNm != 0)) {
      ++driven;
      ASSERT_EQ(state, can::State::active);
    }
  }
  EXPECT_GT(driven, 100U);
}

TEST(KickRun, StopsBetweenTicksAndKeepsWhatWasDone) {
  InProcessLink link;
  std::size_t done = 0;
  KickRunner runner({.plant = PlantKind::servo, .episodes = 1000}, link,
                    {.begin_tick = {},
                     .end_tick = {},
                     .end_episode = [&](const KickOutcome&) { ++done; },
                     .stop = [&] { return done == 2; }});
  runner.run();
  EXPECT_EQ(runner.outcomes().size(), 2U);
}

}  // namespace
}  // namespace striker::sil
