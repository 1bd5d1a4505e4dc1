// SPDX-License-Identifier: Apache-2.0
// The ceiling is attained, and nothing is above it.
#include "training/search/ceiling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sil/world/random.hpp"
#include "training/ceiling/ceiling_report.hpp"
#include "training/ceiling/ceiling_run.hpp"

namespace striker::training {
namespace {

const Reachable& reachable() {
  static const Reachable states({.position_cell_m = 0.005, .speed_cell_m_s = 0.02});
  return states;
}

sil::KickOutcome replayed(KickEnvironment& env, std::uint64_t seed, std::uint64_t episode,
                          const ActionSequence& actions) {
  return play(env, seed, episode, [&actions](const KickEnvironment& seen) -> int {
    return actions.at(static_cast<std::size_t>(sil::kick_decisions - seen.decisions_left()));
  });
}

// What the grid may lose in an episode: about a cell of speed, at 3.92 a m/s.
constexpr double grid_loss = 0.1;

TEST(Ceiling, TheFastWorldGivesExactlyWhatWasFound) {
  CeilingSearch search(reachable());
  for (const sil::PoseMode pose : {sil::PoseMode::origin, sil::PoseMode::anywhere}) {
    KickEnvironment env({.physics = Physics::planar, .pose = pose});
    int contacts = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Ceiling ceiling = search.search(sil::draw_kick(21, i, pose));
      for (const FoundSequence& found : {ceiling.best, ceiling.safe}) {
        const sil::KickOutcome outcome = replayed(env, 21, i, found.actions);
        EXPECT_NEAR(outcome.reward, found.reward, 1e-9) << i;
        EXPECT_EQ(outcome.contact, found.contact_step >= 0) << i;
        EXPECT_EQ(outcome.contact_decision, found.contact_step < 0 ? -1 : found.contact_step / 5) << i;
      }
      EXPECT_GE(ceiling.best.reward, ceiling.safe.reward) << i;
      contacts += ceiling.best.contact_step >= 0 ? 1 : 0;
    }
    EXPECT_GT(contacts, 150);
    EXPECT_LT(contacts, 200);
  }
}

TEST(Ceiling, TheAimedKickGetsWhatWasFound) {
  CeilingSearch search(reachable(), sil::KickReward::aimed);
  KickEnvironment env({.rules = {.reward = sil::KickReward::aimed}});
  int kicked = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Ceiling ceiling = search.search(sil::draw_kick(21, i, sil::PoseMode::origin));
    for (const FoundSequence& found : {ceiling.best, ceiling.safe}) {
      const sil::KickOutcome outcome = replayed(env, 21, i, found.actions);
      EXPECT_NEAR(outcome.reward, found.reward, 1e-9) << i;
      EXPECT_EQ(outcome.contact, found.contact_step >= 0) << i;
      kicked += outcome.kicked ? 1 : 0;
    }
    EXPECT_GE(ceiling.best.reward, ceiling.safe.reward) << i;
  }
  EXPECT_GT(kicked, 40);
}

class OtherRobots : public testing::TestWithParam<core::RobotDescription> {};

core::RobotDescription heavy(int command_delay_ms) {
  core::RobotDescription robot = core::forward;
  robot.body_mass_g = 2500;
  robot.top_rim_speed_mm_s = 2000;
  robot.command_delay_ms = command_delay_ms;
  return robot;
}

INSTANTIATE_TEST_SUITE_P(Ceiling, OtherRobots, testing::Values(heavy(0), heavy(20), heavy(50)));

// Its worlds, its search and its rivals are the same robot's.
TEST_P(OtherRobots, GetWhatWasFound) {
  const LineGrid grid{.robot = GetParam()};
  const CeilingOptions options{.seed = 29, .episodes = 100, .rivals = true, .jobs = 2, .grid = grid};
  const auto episodes = run_ceiling(options, Reachable(grid), [](int) { return true; });
  ASSERT_EQ(episodes.size(), 100U);
  double ceilings = 0.0;
  double planners = 0.0;
  for (const CeilingEpisode& episode : episodes) {
    EXPECT_NEAR(episode.best_replay.reward, episode.ceiling.best.reward, 1e-9);
    EXPECT_NEAR(episode.safe_replay.reward, episode.ceiling.safe.reward, 1e-9);
    for (const sil::KickOutcome& rival : episode.rivals) {
      EXPECT_LE(rival.reward, episode.ceiling.best.reward + grid_loss);
    }
    ceilings += episode.ceiling.best.reward;
    planners += episode.rivals.at(static_cast<std::size_t>(Rival::planner)).reward;
  }
  EXPECT_GE(ceilings, planners);
  EXPECT_GT(planners, 100.0 * 3.0);
}

// What the search drops rests on it.
TEST(Ceiling, NoRobotGainsMoreThanTheMost) {
  EXPECT_EQ(line_drive(core::forward).most_gain_m_s(), 0.118);  // 0.111 from the wheels, 0.006 from damping
  core::RobotDescription fast = core::goalkeeper;
  fast.top_rim_speed_mm_s = 8000;
  for (const core::RobotDescription& robot : {core::forward, core::goalkeeper, core::defender, fast}) {
    const LineDrive drive = line_drive(robot);
    for (double share = -1.0; share <= 1.0; share += 0.05) {
      LineState state{.speed_m_s = share * drive.top_speed_m_s};
      advance(state, drive.set_points_m_s[0], drive.gain_limit_m_s);
      EXPECT_LE(state.speed_m_s - share * drive.top_speed_m_s, drive.most_gain_m_s());
      EXPECT_LE(state.speed_m_s, drive.top_speed_m_s);
    }
  }
}

// One of the two at least: an edge may fall differently there.
TEST(Ceiling, TheFullWorldGivesWhatWasFound) {
  CeilingSearch search(reachable());
  KickEnvironment env({.physics = Physics::full});
  int edges = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const Ceiling ceiling = search.search(sil::draw_kick(22, i, sil::PoseMode::origin));
    const double best = replayed(env, 22, i, ceiling.best.actions).reward;
    const double safe = replayed(env, 22, i, ceiling.safe.actions).reward;
    EXPECT_NEAR(safe, ceiling.safe.reward, 0.01) << i;
    EXPECT_LT(std::max(best, safe), ceiling.best.reward + 0.01) << i;
    edges += std::abs(best - ceiling.best.reward) > 0.01 ? 1 : 0;
  }
  EXPECT_LT(edges, 6);
}

TEST(Ceiling, NoRandomSequenceIsAboveIt) {
  CeilingSearch search(reachable());
  KickEnvironment env({.physics = Physics::planar});
  int contacts = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const double ceiling = search.search(sil::draw_kick(23, i, sil::PoseMode::origin)).best.reward;
    for (std::uint64_t k = 0; k < 200; ++k) {
      // Each action holds for up to 1, 4 or 16 decisions.
      sil::Random random(k, i, 300);
      const std::uint64_t longest = std::uint64_t{1} << (2 * (k % 3));
      std::uint64_t held = 0;
      int action = 0;
      const sil::KickOutcome outcome = play(env, 23, i, [&](const KickEnvironment&) {
        if (held-- == 0) {
          held = random.below(longest);
          action = static_cast<int>(random.below(3));
        }
        return action;
      });
      EXPECT_LE(outcome.reward, ceiling + grid_loss) << i << " " << k;
      contacts += outcome.contact ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 1000);
}

// Nor a planner of the aimed kick, whose contacts are worth more apart.
TEST(Ceiling, NoRivalOfTheAimedKickIsAboveIt) {
  const CeilingOptions options{
      .seed = 24, .episodes = 30, .reward = sil::KickReward::aimed, .rivals = true, .jobs = 2};
  const auto episodes = run_ceiling(options, reachable(), [](int) { return true; });
  ASSERT_EQ(episodes.size(), 30U);
  for (const CeilingEpisode& episode : episodes) {
    for (const sil::KickOutcome& rival : episode.rivals) {
      EXPECT_LE(rival.reward, episode.ceiling.best.reward + 3.0 * grid_loss);
    }
  }
}

TEST(Ceiling, NoRivalIsAboveIt) {
  CeilingOptions options{.seed = 24, .episodes = 200, .rivals = true, .jobs = 2};
  const auto episodes = run_ceiling(options, reachable(), [](int) { return true; });
  ASSERT_EQ(episodes.size(), 200U);
  double above = 0.0;
  for (const CeilingEpisode& episode : episodes) {
    for (const sil::KickOutcome& rival : episode.rivals) {
      EXPECT_LE(rival.reward, episode.ceiling.best.reward + grid_loss);
      above = std::max(above, rival.reward - episode.ceiling.best.reward);
    }
  }
  RecordProperty("above", std::to_string(above));
}

// The same reward or more from a finer grid, but hardly more.
TEST(Ceiling, AFinerGridHardlyGainsAnything) {
  const Reachable coarse({.position_cell_m = 0.010, .speed_cell_m_s = 0.04});
  CeilingSearch fine_search(reachable());
  CeilingSearch coarse_search(coarse);
  constexpr int episodes = 300;
  double gain = 0.0;
  for (std::uint64_t i = 0; i < episodes; ++i) {
    const sil::KickStart start = sil::draw_kick(25, i, sil::PoseMode::origin);
    gain += (fine_search.search(start).best.reward - coarse_search.search(start).best.reward) / episodes;
  }
  EXPECT_LT(std::abs(gain), 0.015);
}

TEST(Ceiling, AnEpisodeIsTheSameAloneAndAfterOthers) {
  CeilingSearch busy(reachable());
  for (std::uint64_t i = 0; i < 50; ++i) {
    const sil::KickStart start = sil::draw_kick(26, i, sil::PoseMode::origin);
    CeilingSearch fresh(reachable());
    EXPECT_EQ(busy.search(start).best.actions, fresh.search(start).best.actions);
  }
}

TEST(Ceiling, TheReportIsTheSameWithAnyNumberOfJobs) {
  CeilingOptions options{.seed = 27, .episodes = 60, .rivals = true, .jobs = 1};
  const auto report = [&options] {
    const auto episodes = run_ceiling(options, reachable(), [](int) { return true; });
    return ceiling_table(options, episodes) + ceiling_json(options, episodes) +
           ceiling_csv(options, episodes);
  };
  const std::string one = report();
  options.jobs = 2;
  EXPECT_EQ(report(), one);
  options.jobs = 5;
  EXPECT_EQ(report(), one);
  EXPECT_NE(one.find("\"mean_reward\""), std::string::npos);
}

TEST(Ceiling, AStoppedRunHasNoResult) {
  const CeilingOptions options{.seed = 28, .episodes = 1'000'000, .jobs = 2};
  EXPECT_TRUE(run_ceiling(options, reachable(), [](int done) { return done < 3; }).empty());
}

}  // namespace
}  // namespace striker::training
