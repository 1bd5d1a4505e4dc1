// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "firmware/core/estimation/relative_state.hpp"
#include "firmware/core/freshness.hpp"
#include "firmware/core/supervision/consent.hpp"
#include "firmware/core/supervision/supervisor.hpp"

namespace striker::core {
namespace {

Requests ask(Order order) {
  return {.asked = order, .confirmed = {}};
}
Requests confirm(Order order, std::uint32_t challenge) {
  return {.confirmed = {order, challenge}};
}

TEST(Consent, AConfirmationOfTheOpenChallengeGrantsItOnce) {
  Consent consent(1);
  EXPECT_EQ(consent.step(10, ask(Order::arm)), Order::none);
  const OpenRequest open = consent.opened_at(10);
  EXPECT_EQ(open.order, Order::arm);
  EXPECT_NE(open.challenge, 0U);
  EXPECT_EQ(consent.opened_at(11).order, Order::none) << "told in its own tick alone";
  EXPECT_EQ(consent.step(11, {}), Order::none);
  EXPECT_EQ(consent.step(12, confirm(Order::arm, open.challenge)), Order::arm);
  EXPECT_EQ(consent.step(13, confirm(Order::arm, open.challenge)), Order::none);
}

TEST(Consent, AnyOtherOrderOrNumberClosesIt) {
  for (const bool other_order : {true, false}) {
    Consent consent(1);
    static_cast<void>(consent.step(0, ask(Order::clear)));
    const std::uint32_t challenge = consent.opened_at(0).challenge;
    EXPECT_EQ(consent.step(
                  1, confirm(other_order ? Order::arm : Order::clear, challenge ^ (other_order ? 0U : 1U))),
              Order::none);
    EXPECT_EQ(consent.step(2, confirm(Order::clear, challenge)), Order::none);
  }
}

TEST(Consent, LastsItsTime) {
  for (const std::uint32_t wait : {500U, 501U}) {
    Consent consent(1);
    static_cast<void>(consent.step(7, ask(Order::arm)));
    const std::uint32_t challenge = consent.opened_at(7).challenge;
    EXPECT_EQ(consent.step(7 + wait, confirm(Order::arm, challenge)), wait == 500 ? Order::arm : Order::none);
  }
}

TEST(Consent, IsNotOpenBeforeItIsAskedFor) {
  Consent consent(1);
  EXPECT_EQ(consent.step(0, confirm(Order::arm, 0)), Order::none);
  EXPECT_EQ(consent.opened_at(0).order, Order::none);
}

TEST(Consent, ANewRequestReplacesTheOpenOne) {
  Consent consent(1);
  static_cast<void>(consent.step(0, ask(Order::arm)));
  const std::uint32_t first = consent.opened_at(0).challenge;
  static_cast<void>(consent.step(1, ask(Order::arm)));
  EXPECT_NE(consent.opened_at(1).challenge, first);
  EXPECT_EQ(consent.step(2, confirm(Order::arm, first)), Order::none);
}

TEST(Consent, CanBeClosed) {
  Consent consent(1);
  static_cast<void>(consent.step(0, ask(Order::arm)));
  const std::uint32_t challenge = consent.opened_at(0).challenge;
  consent.close();
  EXPECT_EQ(consent.step(1, confirm(Order::arm, challenge)), Order::none);
}

std::uint32_t challenge_after(std::uint32_t sequence) {
  sequence = sequence * 1664525U + 1013904223U;             // Numerical Recipes' generator
  sequence = (sequence ^ (sequence >> 16U)) * 0x85EBCA6BU;  // MurmurHash3's finaliser
  sequence = (sequence ^ (sequence >> 13U)) * 0xC2B2AE35U;
  return (sequence ^ (sequence >> 16U)) & 0x7FFFFFFFU;
}

TEST(Consent, ChallengesComeFromTheSeedAsTheHeaderSays) {
  for (const std::uint32_t seed : {0U, 1U, 0x12345678U, 0xFFFFFFFFU}) {
    Consent consent(seed);
    static_cast<void>(consent.step(0, ask(Order::arm)));
    EXPECT_EQ(consent.opened_at(0).challenge, challenge_after(seed));
  }
}

// 634785765 * 1664525 + 1013904223 is 0 in 32 bits, and 0 stays 0 when it is mixed.
TEST(Consent, TheOneChallengeThatWouldBeNoneIsOne) {
  Consent consent(634'785'765);
  static_cast<void>(consent.step(0, ask(Order::arm)));
  EXPECT_EQ(consent.opened_at(0).challenge, 1U);
}

TEST(Consent, ChallengesDoNotRepeatSoon) {
  Consent consent(3);
  std::set<std::uint32_t> seen;
  for (std::uint32_t tick = 0; tick < 1000; ++tick) {
    static_cast<void>(consent.step(tick, ask(Order::arm)));
    seen.insert(consent.opened_at(tick).challenge);
  }
  EXPECT_EQ(seen.size(), 1000U);
  EXPECT_FALSE(seen.contains(0));
}

TEST(Consent, ANewBeginningGoesOnWithOtherChallengesButInASimulation) {
  EXPECT_EQ(Consent(0).next_seed(), 0U);
  Consent consent(5);
  EXPECT_EQ(consent.next_seed(), (5U ^ 0x9E3779B9U) | 1U);
  static_cast<void>(consent.step(0, ask(Order::arm)));
  EXPECT_NE(consent.next_seed(), (5U ^ 0x9E3779B9U) | 1U);
  EXPECT_EQ(Consent(0x9E3779B9U).next_seed(), 1U) << "never the simulation's";
}

TEST(Freshness, CountsTheTicksSinceAndNotTheFuture) {
  Freshness freshness;
  EXPECT_FALSE(freshness.within(0, 100));
  freshness.feed(10);
  EXPECT_TRUE(freshness.within(10, 0));
  EXPECT_TRUE(freshness.within(30, 20));
  EXPECT_FALSE(freshness.within(31, 20));
  EXPECT_FALSE(freshness.within(9, 20));
  EXPECT_EQ(freshness.tick(), 10U);
}

TEST(Freshness, WhatBecameTooOldDoesNotComeBack) {
  Freshness freshness;
  freshness.feed(10);
  EXPECT_TRUE(freshness.expire(30, 20));
  EXPECT_TRUE(freshness.ever());
  EXPECT_FALSE(freshness.expire(31, 20));
  EXPECT_FALSE(freshness.ever());
  EXPECT_FALSE(freshness.within(10, 20));
  freshness.feed(40);
  EXPECT_TRUE(freshness.ever());
  freshness.forget();
  EXPECT_FALSE(freshness.ever());
}

TEST(Supervisor, ALatchOfNothingStillStops) {
  const Supervisor latched = latch({.state = State::active}, 0);
  EXPECT_EQ(latched.state, State::fault);
  EXPECT_EQ(latched.fault, Fault::none);
  EXPECT_EQ(set_of(Fault::none), 0U);
}

TEST(RelativeState, AnElementThatThereIsNotIsZero) {
  RelativeState state;
  state.ball_um = {5, 6};
  EXPECT_EQ(element_of(state, static_cast<policy::StateElement>(200)), 0);
}

}  // namespace
}  // namespace striker::core
