// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "sil/fault/plan/catalogue.hpp"
#include "sil/fault/plan/plan_file.hpp"
#include "sil/fault/plan/random_faults.hpp"

namespace striker::sil {
namespace {

const std::string good = R"(
[[case]]
name = "a plan"
plant = "servo"
pose = "anywhere"
seed = 5
episode = 7
torque_scale = 0.9

[[case.fault]]
kind = "loss"
message = "WheelState"
probability = 0.5
from_ms = -50
until_ms = 700

[[case.fault]]
kind = "wheels_frozen"
wheel = "left"
speed_mm_s = -1000
from_tick = 300
until_tick = 301
)";

TEST(FaultPlan, AFileIsReadAsItStandsThere) {
  const FaultPlan plan = parse_plan(good, "a.toml");
  ASSERT_EQ(plan.cases.size(), 1U);
  const FaultCase& one = plan.cases.front();
  EXPECT_EQ(one.name, "a plan");
  EXPECT_EQ(one.setup, (FaultSetup{PlantKind::servo, true, 5, 7, 0.9}));
  ASSERT_EQ(one.faults.size(), 2U);
  EXPECT_EQ(one.faults[0].kind, FaultKind::loss);
  EXPECT_EQ(one.faults[0].message, identifier_of("WheelState"));
  EXPECT_EQ(one.faults[0].from_ms, -50);
  EXPECT_EQ(one.faults[1].wheel, FaultyWheel::left);
  EXPECT_DOUBLE_EQ(one.faults[1].value, -1000.0);
  EXPECT_TRUE(one.faults[1].absolute);
  const auto times = timed(one.faults, 150);
  EXPECT_EQ(times[0].from, 100U);
  EXPECT_EQ(times[0].until, 850U);
  EXPECT_EQ(times[1].from, 300U);
}

TEST(FaultPlan, WhatIsWrittenIsReadAgain) {
  for (std::uint64_t number = 0; number < 500; ++number) {
    const FaultCase one = random_case(3, number);
    const std::string text = plan_text({.cases = {one}});
    const FaultPlan again = parse_plan(text, "again.toml");
    ASSERT_EQ(again.cases.size(), 1U);
    ASSERT_EQ(again.cases.front().setup, one.setup) << text;
    ASSERT_EQ(again.cases.front().faults, one.faults) << text;
  }
  const FaultPlan all = fault_catalogue();
  const FaultPlan again = parse_plan(plan_text(all), "all.toml");
  ASSERT_EQ(again.cases.size(), all.cases.size());
  for (std::size_t i = 0; i < all.cases.size(); ++i) {
    ASSERT_EQ(again.cases[i].faults, all.cases[i].faults) << all.cases[i].name;
  }
}

TEST(FaultPlan, TheCatalogueHasEveryKindAndNoNameTwice) {
  std::set<FaultKind> kinds;
  std::set<std::string> names;
  for (const FaultCase& one : fault_catalogue().cases) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    for (const Fault& fault : one.faults) {
      kinds.insert(fault.kind);
    }
  }
  for (const FaultKindInfo& info : fault_kinds()) {
    EXPECT_TRUE(kinds.contains(info.kind)) << info.name;
  }
}

TEST(FaultPlan, RandomCasesDrawEveryKindOfAProcessWithinItsRanges) {
  std::set<FaultKind> kinds;
  for (std::uint64_t number = 0; number < 2000; ++number) {
    const FaultCase one = random_case(1, number);
    ASSERT_GE(one.faults.size(), 1U);
    ASSERT_LE(one.faults.size(), 3U);
    ASSERT_EQ(random_case(1, number).faults, one.faults);
    for (const Fault& fault : one.faults) {
      const FaultKindInfo& info = info_of(fault.kind);
      kinds.insert(fault.kind);
      ASSERT_LT(fault.from_ms, fault.until_ms);
      ASSERT_TRUE(!info.count.known() ||
                  (fault.count >= info.count.least && fault.count <= info.count.greatest));
      ASSERT_TRUE(!info.value.known() ||
                  (fault.value >= info.value.least && fault.value <= info.value.greatest));
    }
  }
  for (const FaultKindInfo& info : fault_kinds()) {
    EXPECT_EQ(kinds.contains(info.kind), !info.real_bus) << info.name;
  }
}

// The message of what a plan's text is refused with.
std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parse_plan(text, "bad.toml"));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "was read";
}

std::string with(const std::string& what, const std::string& instead) {
  std::string text = good;
  return text.replace(text.find(what), what.size(), instead);
}

void expect_in(const std::string& message, std::initializer_list<const char*> words) {
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const char* const word : words) {
    EXPECT_NE(message.find(word), std::string::npos) << message << " / " << word;
  }
}

TEST(FaultPlan, AWrongFileIsRefusedByFileLineAndField) {
  expect_in(refusal(with("\"loss\"", "\"los\"")),
            {"bad.toml", "line 11", "case.fault.kind", "los", "babble"});
  expect_in(refusal(with("probability = 0.5", "probability = 1.5")),
            {"bad.toml", "line 13", "case.fault.probability", "1.5", "from 0.01 to 1"});
  expect_in(refusal(with("\"WheelState\"", "\"Wheels\"")), {"line 12", "message", "Wheels", "WheelState"});
  expect_in(refusal(with("until_ms = 700", "until_ms = -50")), {"line 15", "until_ms", "later than from_ms"});
  expect_in(refusal(with("until_ms = 700", "")), {"until_ms", "missing"});
  expect_in(refusal(with("probability = 0.5", "speed_mm_s = 5")),
            {"line 13", "speed_mm_s", "no key", "probability"});
  expect_in(refusal(with("\"servo\"", "\"steam\"")), {"line 4", "case.plant", "steam", "servo, drive"});
  expect_in(refusal(with("episode = 7", "episode = \"7\"")), {"line 7", "episode", "whole number"});
  expect_in(refusal(with("name = \"a plan\"", "")), {"line 2", "case.name", "missing"});
  expect_in(refusal("[[case]]\nname = \"empty\"\n"), {"bad.toml", "line 1", "case.fault"});
  expect_in(refusal("seed = 1\n"), {"line 1", "seed", "no key"});
  expect_in(refusal("[[case]\n"), {"bad.toml", "line 1"});
  expect_in(refusal(""), {"bad.toml", "case"});
}

}  // namespace
}  // namespace striker::sil
