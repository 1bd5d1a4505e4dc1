// SPDX-License-Identifier: Apache-2.0
// The supervisor over every state, fault and combination of conditions: what must never happen does not.
#include "firmware/core/supervisor.hpp"

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
           .requests = {.arm = (bits & 1U) != 0, .disarm = (bits & 2U) != 0, .clear = (bits & 4U) != 0},
           .emergency_stop = (bits & 8U) != 0,
           .port_fault = (bits & 128U) != 0 ? Fault::overrun : Fault::none,
           .vision_fresh = (bits & 16U) != 0,
           .vision_ready = (bits & 48U) == 48,
           .wheels_fresh = (bits & 64U) != 0});
    }
  }
  return all;
}

std::vector<Supervisor> all_supervisors() {
  std::vector<Supervisor> all = {{State::boot, Fault::none},
                                 {State::self_test, Fault::none},
                                 {State::standby, Fault::none},
                                 {State::active, Fault::none}};
  for (std::uint8_t code = 1; code <= 9; ++code) {
    all.push_back({State::fault, static_cast<Fault>(code)});
  }
  return all;
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
      EXPECT_TRUE(c.requests.arm && !c.requests.disarm && c.vision_ready && c.wheels_fresh);
    }
    if (next.state == State::active) {
      EXPECT_TRUE(c.vision_fresh && c.wheels_fresh && !c.emergency_stop && !c.requests.disarm);
      EXPECT_EQ(c.port_fault, Fault::none);
    }
  });
}

TEST(Supervisor, TheFirstFaultIsKeptUntilItIsCleared) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    if (now.state == State::fault && !c.requests.clear) {
      EXPECT_EQ(next.state, State::fault);
      EXPECT_EQ(next.fault, now.fault);
    }
    EXPECT_EQ(next.state == State::fault, next.fault != Fault::none);
  });
}

TEST(Supervisor, AClearIsRefusedWhileTheCauseLasts) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    const bool lasts = now.fault == Fault::self_test_failed ||
                       (now.fault == Fault::emergency_stop && c.emergency_stop) ||
                       (now.fault == Fault::vision_lost && !c.vision_fresh) ||
                       (now.fault == Fault::wheel_state_lost && !c.wheels_fresh) || c.emergency_stop ||
                       c.self_test == SelfTest::failed || c.port_fault != Fault::none;
    if (now.state == State::fault && c.requests.clear) {
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

TEST(Supervisor, APortsFaultStopsEveryStateAndLastsAsLongAsThePortSaysSo) {
  for_every_step([](const Supervisor& now, const Conditions& c, const Supervisor& next) {
    if (c.port_fault != Fault::none) {
      EXPECT_EQ(next.state, State::fault);
    }
    if (now.state != State::fault && c.port_fault != Fault::none && !c.emergency_stop &&
        c.self_test != SelfTest::failed) {
      EXPECT_EQ(next.fault, c.port_fault);
    }
  });
}

TEST(Supervisor, LatchKeepsAnEarlierFault) {
  const Supervisor faulty{State::fault, Fault::vision_lost};
  EXPECT_EQ(latch(faulty, Fault::overrun).fault, Fault::vision_lost);
  EXPECT_EQ(latch({State::active, Fault::none}, Fault::overrun).fault, Fault::overrun);
  EXPECT_EQ(latch({State::active, Fault::none}, Fault::overrun).state, State::fault);
}

}  // namespace
}  // namespace striker::core
