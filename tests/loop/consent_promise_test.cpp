// SPDX-License-Identifier: Apache-2.0
// Consent attacked from outside: requests without confirmation, guesses, late and replayed confirmations, and random
// frames by the million.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "tests/loop/node_rig.hpp"

namespace striker::loop {
namespace {

using can::Mode;
using core::State;

TEST(Consent, ARequestAloneNeverArmsHoweverOftenItComes) {
  NodeRig rig;
  rig.run(210);
  can::SendCounter counter;
  for (std::uint32_t tick = 0; tick < 3'000; ++tick) {
    rig.extra.push_back(can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(Mode::arm)}, counter));
    rig.tick();
    ASSERT_EQ(rig.state(), State::standby);
  }
}

// The confirmation of the open challenge, and everything near it.
TEST(Consent, OnlyTheOpenChallengeArmsAndOnlyOnceAndInTime) {
  const auto try_with = [](std::uint32_t wait_ticks, std::int32_t change, Mode mode) {
    NodeRig rig;
    rig.run(210);
    rig.extra.push_back(BenchOperator().command(Mode::arm));
    rig.tick();
    can::Challenge challenge;
    for (const can::Frame& frame : rig.frames()) {
      static_cast<void>(can::is<can::Challenge>(frame) &&
                        can::receive(frame, challenge) == can::Verdict::accepted);
    }
    EXPECT_NE(challenge.challenge, 0);
    rig.run(wait_ticks);
    rig.extra.push_back(BenchOperator().command(mode, challenge.challenge ^ change));
    rig.tick();
    return rig.state() == State::active;
  };
  EXPECT_TRUE(try_with(0, 0, Mode::arm));
  EXPECT_TRUE(try_with(core::consent_ticks - 1, 0, Mode::arm));
  EXPECT_FALSE(try_with(core::consent_ticks, 0, Mode::arm));
  EXPECT_FALSE(try_with(0, 0, Mode::clear));
  for (int bit = 0; bit < 31; ++bit) {
    EXPECT_FALSE(try_with(0, std::int32_t{1} << bit, Mode::arm)) << bit;
  }
}

// What a bus recorded of one controller, played to another that drew another seed.
TEST(Consent, AReplayedRecordingDoesNotArm) {
  NodeRig recorded;
  std::vector<std::vector<can::Frame>> log;
  const auto record = [&](std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      recorded.tick();
      log.push_back(recorded.delivered);
    }
  };
  record(210);
  recorded.extra.push_back(BenchOperator().command(Mode::arm));
  record(1);
  recorded.extra.push_back(*BenchOperator().answer(recorded.frames()));
  record(200);
  ASSERT_EQ(recorded.state(), State::active);
  for (std::uint32_t seed = 1; seed < 100; ++seed) {
    NodeRig fresh;
    fresh.node = GatedNode<BuiltInNode>(built_in_robot, seed);
    for (const auto& frames : log) {
      fresh.step(frames);
      ASSERT_NE(fresh.state(), State::active) << seed;
      ASSERT_FALSE(fresh.torque());
    }
  }
}

// Random bytes in frames of the right length on the identifiers of mode and stop, in front of a controller that could
// be armed at any time. A frame passes the CRC with probability 2^-8 and confirms an open challenge with 2^-31 of
// those: over a thousand million frames 2^-9 that it ever happens. STRIKER_RANDOM_FRAMES sets how many; each set of
// frames begins where the last ended, so that the count is of different frames.
TEST(Consent, RandomFramesNeverArm) {
  const char* const wanted = std::getenv("STRIKER_RANDOM_FRAMES");
  const std::uint64_t frames = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 3'000'000;
  std::mt19937_64 random(20);
  NodeRig rig;
  rig.run(210);
  std::uint64_t sent = 0;
  std::uint64_t requests = 0;
  BenchOperator honest;
  while (sent < frames) {
    rig.extra.push_back(honest.command(Mode::arm));  // so that a challenge is always open
    for (int i = 0; i < 20; ++i, ++sent) {
      const std::uint64_t bits = random();
      const bool mode = (bits & 15U) != 0;
      can::Frame frame{
          .id = mode ? can::layout<can::ModeCommand>.info.id : can::layout<can::EmergencyStop>.info.id,
          .length = static_cast<std::uint8_t>(mode ? 6 : 2)};
      for (std::size_t byte = 0; byte < 6; ++byte) {
        frame.data[byte] = static_cast<std::uint8_t>(bits >> (8 * byte + 16));
      }
      rig.extra.push_back(frame);
    }
    rig.tick();
    for (const can::Frame& frame : rig.frames()) {
      requests += can::is<can::Challenge>(frame) ? 1U : 0U;
    }
    ASSERT_NE(rig.state(), State::active) << "after " << sent << " frames";
    ASSERT_FALSE(rig.torque());
  }
  std::printf("%llu random frames, %llu challenges were open, none was met\n",
              static_cast<unsigned long long>(sent), static_cast<unsigned long long>(requests));
}

}  // namespace
}  // namespace striker::loop
