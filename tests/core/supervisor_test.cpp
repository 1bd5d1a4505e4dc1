// SPDX-License-Identifier: Apache-2.0
// The supervisor over every state, fault and combination of conditions: what must never happen does not.
#include "firmware/core/supervision/supervisor.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace striker::core {
namespace {

std::vector<Conditions> all_conditions() {
  std::vector<Conditions> all;
  for (unsigned bits = 0; bits < 256; ++bits) {
    for (const SelfTest test : {SelfTest::running, SelfTest::passed, SelfTest::failed}) {
      all.push_back(
          {.self_test = test,
           .granted = {.arm = (bits & 1U) != 0, .disarm = (bits & 2U) != 0, .clear = (bits & 4U) != 0},
           .emergency_stop = (bits & 8U) != 0,
           .causes = (bits & 128U) != 0 ? set_of(Fault::overrun) : 0,
           .vision_fresh = (bits & 16U) != 0,
           .vision_ready = (bits & 48U) == 48,
           .wheels_fresh = (bits & 64U) != 0});
    }
  }
  return all;
}

// Every fault alone, and every one that came after another.
std::vector<Supervisor> all_supervisors() {
  std::vector<Supervisor> all = {{.state = State::boot},
                                 {.state = State::self_test},
                                 {.state = State::standby},
                                 {.state = State::active}};
  for (std::size_t first = 1; first < fault_names.size(); ++first) {
    for (std::size_t later = 1; later < fault_names.size(); ++later) {
      all.push_back({.state = State::fault,
                     .fault = static_cast<Fault>(first),
                     .faults = set_of(static_cast<Fault>(first)) | set_of(static_cast<Fault>(later))});
    }
  }
  return all;
}

constexpr bool has(Faults faults, Fault fault) {
  return (faults & set_of(fault)) != 0;
}

template <class Check>
void for_every_step(Check check) {
  for (const Supervisor& now : all_supervisors()) {
    for (const Conditions& conditions : all_conditions()) {
      check(now, conditions, supervise(now, conditions));
    }
  }
}

TEST(Supervisor, OnlyAnArmRequestWithFreshInputsLeadsToActive) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    if (next.state == State::active && now.state != State::active) {
      EXPECT_EQ(now.state, State::standby);
      EXPECT_TRUE(c.granted.arm && !c.granted.disarm && c.vision_ready && c.wheels_fresh);
    }
    if (next.state == State::active) {
      EXPECT_TRUE(c.vision_fresh && c.wheels_fresh && !c.emergency_stop && !c.granted.disarm);
      EXPECT_EQ(c.causes, 0U);
    }
  });
}

// Whoever leaves something of the conditions out gets the side on which nothing moves.
TEST(Supervisor, WhatIsNotSaidIsNotGranted) {
  constexpr Conditions silent;
  EXPECT_FALSE(silent.granted.arm || silent.granted.disarm || silent.granted.clear);
  EXPECT_FALSE(silent.vision_fresh || silent.vision_ready || silent.wheels_fresh);
  EXPECT_EQ(silent.self_test, SelfTest::running);
  EXPECT_FALSE(silent.emergency_stop);
  EXPECT_EQ(silent.causes, 0U);
  EXPECT_EQ(Supervisor{}, (Supervisor{State::boot, Fault::none, 0, 0}));
}

TEST(Supervisor, TheFirstFaultIsKeptUntilItIsCleared) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    if (now.state == State::fault && !c.granted.clear) {
      EXPECT_EQ(next.state, State::fault);
      EXPECT_EQ(next.fault, now.fault);
    }
    EXPECT_EQ(next.state == State::fault, next.fault != Fault::none);
  });
}

TEST(Supervisor, EveryLaterFaultIsKeptBesideTheFirst) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    if (next.state == State::fault) {
      EXPECT_EQ(next.faults & now.faults, now.faults) << "none is forgotten";
      EXPECT_EQ(next.faults & c.causes, c.causes);
      EXPECT_TRUE(has(next.faults, next.fault));
      EXPECT_EQ(c.emergency_stop && !has(next.faults, Fault::emergency_stop), false);
    } else {
      EXPECT_EQ(next.faults, 0U);
    }
  });
}

TEST(Supervisor, AClearIsRefusedWhileACauseLasts) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    const bool lasts = has(now.faults, Fault::self_test_failed) || has(now.faults, Fault::state_corrupt) ||
                       has(now.faults, Fault::policy_corrupt) || c.emergency_stop ||
                       (has(now.faults, Fault::vision_lost) && !c.vision_fresh) ||
                       (has(now.faults, Fault::wheel_state_lost) && !c.wheels_fresh) ||
                       c.self_test == SelfTest::failed || c.causes != 0;
    if (now.state == State::fault && c.granted.clear) {
      EXPECT_EQ(next.state == State::fault, lasts);
    }
  });
}

TEST(Supervisor, NoStandbyBeforeThePassedSelfTest) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    const bool was_before = now.state != State::standby && now.state != State::active;
    if (was_before && next.state == State::standby) {
      EXPECT_EQ(c.self_test, SelfTest::passed);
    }
  });
}

TEST(Supervisor, AnEmergencyStopStopsEveryState) {
  for_every_step([](const Supervisor&, const Conditions& c, const Supervisor& next) {
    if (c.emergency_stop) {
      EXPECT_EQ(next.state, State::fault);
    }
  });
}

TEST(Supervisor, ACauseStopsEveryStateAndLastsAsLongAsItIsSeen) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    if (c.causes != 0) {
      EXPECT_EQ(next.state, State::fault);
    }
    if (now.state != State::fault && c.causes != 0 && !c.emergency_stop && c.self_test != SelfTest::failed) {
      EXPECT_EQ(next.fault, Fault::overrun);
    }
  });
}

TEST(Supervisor, LatchKeepsAnEarlierFault) {
  const Supervisor faulty = latch({.state = State::active}, set_of(Fault::vision_lost));
  EXPECT_EQ(faulty.state, State::fault);
  const Supervisor both = latch(faulty, set_of(Fault::overrun));
  EXPECT_EQ(both.fault, Fault::vision_lost);
  EXPECT_EQ(both.faults, set_of(Fault::vision_lost) | set_of(Fault::overrun));
}

}  // namespace
}  // namespace striker::core
