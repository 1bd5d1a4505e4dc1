// SPDX-License-Identifier: Apache-2.0
// Consent attacked from outside: requests without confirmation, guesses, late and replayed confirmations, and random
// frames by the million.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "firmware/can/receiver.hpp"
#include "firmware/core/supervision/consent.hpp"
#include "tests/loop/bench/node_rig.hpp"

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

// Random bytes in frames of the right length on the identifiers of mode and stop, in front of a receiver and a consent
// that always has an open challenge: an honest operator asks in every tick. The receiver's fault after a few wrong
// frames, which would end all this, is left out. A frame passes the CRC with probability 2^-8 and confirms the open
// challenge with 2^-31 of those: over a thousand million frames 2^-9 that it ever happens. STRIKER_RANDOM_FRAMES sets how
// many.
TEST(Consent, RandomFramesNeverArm) {
  const char* const wanted = std::getenv("STRIKER_RANDOM_FRAMES");
  const std::uint64_t frames = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 3'000'000;
  std::mt19937_64 random(20);
  can::Receiver receiver;
  can::StrikerDrives drives;
  core::Consent consent(1);
  std::uint64_t passed = 0;
  std::uint64_t open = 0;
  for (std::uint64_t tick = 0; tick < frames; ++tick) {
    const std::uint64_t bits = random();
    const bool mode = (bits & 15U) != 0;
    can::Frame frame{
        .id = mode ? can::layout<can::ModeCommand>.info.id : can::layout<can::EmergencyStop>.info.id,
        .length = static_cast<std::uint8_t>(mode ? 6 : 2)};
    for (std::size_t byte = 0; byte < 6; ++byte) {
      frame.data[byte] = static_cast<std::uint8_t>(bits >> (8 * byte + 16));
    }
    const auto now = static_cast<std::uint32_t>(tick);
    const core::Percepts babble = receiver.take(std::span(&frame, 1), now, drives);
    passed += babble.requests.confirmed.order != core::Order::none ? 1U : 0U;
    ASSERT_EQ(consent.step(now, babble.requests), core::Order::none) << "after " << tick << " frames";
    ASSERT_EQ(consent.step(now, {.asked = core::Order::arm, .confirmed = {}}), core::Order::none);
    open += consent.opened_at(now).order == core::Order::arm ? 1U : 0U;
  }
  EXPECT_EQ(open, frames) << "a challenge was open for every frame";
  EXPECT_GT(passed, 0U) << "some frames have to come as far as the challenge";
  std::printf("%llu random frames, a challenge open for each; %llu passed as confirmations, none was right\n",
              static_cast<unsigned long long>(frames), static_cast<unsigned long long>(passed));
}

// The same on a whole node, where the fault comes after a few frames: nothing but a fault comes of it.
TEST(Consent, RandomFramesMakeANodeFault) {
  std::mt19937_64 random(21);
  NodeRig rig;
  rig.run(210);
  for (int tick = 0; tick < 10'000; ++tick) {
    for (int i = 0; i < 20; ++i) {
      can::Frame frame{.id = can::layout<can::ModeCommand>.info.id, .length = 6};
      for (std::uint8_t& byte : frame.data) {
        byte = static_cast<std::uint8_t>(random());
      }
      rig.extra.push_back(frame);
    }
    rig.tick();
    ASSERT_NE(rig.state(), State::active);
    ASSERT_FALSE(rig.torque());
  }
  EXPECT_EQ(rig.fault(), core::Fault::operator_invalid);
}

}  // namespace
}  // namespace striker::loop
