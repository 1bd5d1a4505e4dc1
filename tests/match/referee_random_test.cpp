// SPDX-License-Identifier: Apache-2.0
// A quarter of a million random frames, or STRIKER_REFEREE_FRAMES: what must always hold does, and every rule was used.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "tests/match/random_frames.hpp"
#include "tests/match/referee_invariants.hpp"

namespace striker::sil {
namespace {

struct Seen {
  std::array<int, event_kind_names.size()> kinds = {};
  std::array<int, cause_names.size()> causes = {};
  int frames = 0;

  void add(const Ruling& ruling) {
    ++frames;
    for (const MatchEvent& event : ruling.events) {
      ++kinds[static_cast<std::size_t>(event.kind)];
      ++causes[static_cast<std::size_t>(event.cause)];
    }
  }
};

// Whole matches until the frames are used up.
void play_at_random(MatchRules rules, std::uint64_t first_seed, int frames, Seen& seen) {
  rules.half_ms = 100'000;
  for (std::uint64_t seed = first_seed; seen.frames < frames; ++seed) {
    Referee referee(rules);
    Referee twin(rules);
    RefereeWatch watch(referee);
    RandomFrames random(seed);
    seen.add(referee.ruling());
    const MatchEvent* const room = referee.ruling().events.data();
    while (referee.ruling().state != GameState::over) {
      const RefereeFrame& frame = random.after(referee.ruling());
      const Ruling& ruling = referee.step(frame);
      const std::string_view broken = watch.watch(frame, ruling);
      ASSERT_EQ(broken, "") << "seed " << seed << ", " << ruling.sim_ms << " ms";
      ASSERT_EQ(RulingDigest::of(ruling), RulingDigest::of(twin.step(frame)));
      ASSERT_EQ(ruling.events.data(), room) << "a step allocates nothing";
      seen.add(ruling);
    }
  }
}

void expect_every_rule(const Seen& seen) {
  for (std::size_t kind = 0; kind < seen.kinds.size(); ++kind) {
    EXPECT_GE(seen.kinds[kind], 10) << event_kind_names[kind];
  }
  for (std::size_t cause = 0; cause < seen.causes.size(); ++cause) {
    EXPECT_GE(seen.causes[cause], 10) << cause_names[cause];
  }
}

TEST(RefereeRandom, OfficialRulesKeepEveryPromise) {
  const char* wanted = std::getenv("STRIKER_REFEREE_FRAMES");
  Seen seen;
  play_at_random(official(), 1,
                 wanted == nullptr ? 200'000 : static_cast<int>(std::strtol(wanted, nullptr, 10)), seen);
  expect_every_rule(seen);
}

TEST(RefereeRandom, PublishedRulesKeepEveryPromise) {
  Seen seen;
  play_at_random(published(), 1001, 50'000, seen);
}

// A copy goes on as the original does, and what happens to it does not touch the original.
TEST(RefereeRandom, ACopyGoesOnByItself) {
  Referee referee;
  RandomFrames random(7);
  for (int frame = 0; frame < 5000; ++frame) {
    const RefereeFrame& seen = random.after(referee.ruling());
    Referee copy = referee;
    Referee stray = referee;
    stray.step({});
    const std::uint64_t copied = RulingDigest::of(copy.step(seen));
    ASSERT_EQ(RulingDigest::of(referee.step(seen)), copied);
  }
}

}  // namespace
}  // namespace striker::sil
