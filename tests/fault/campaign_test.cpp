// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/campaign.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>

#include "firmware/host/files.hpp"
#include "sil/scenario/minimise.hpp"
#include "sil/scenario/runs/run_file.hpp"
#include "sil/scenario/runs/worker_pool.hpp"

namespace striker::sil {
namespace {

bool never() {
  return false;
}

CampaignSummary play(const CampaignOptions& options, const std::function<bool()>& stop) {
  return run_campaign(options, stop);
}

class Campaign : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  [[nodiscard]] std::filesystem::path at(const std::string& name) const { return directory_ / name; }
  [[nodiscard]] std::string runs(const std::string& name) const {
    return host::read_file(directory_ / name / "runs.jsonl");
  }

 private:
  std::filesystem::path directory_ =
      std::filesystem::temp_directory_path() /
      ("striker_campaign_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" +
       ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Campaign, IsTheSameWithOneAndTwoJobs) {
  const CampaignSummary one = play({.runs = 12, .seed = 3, .jobs = 1, .directory = at("a")}, never);
  play({.runs = 12, .seed = 3, .jobs = 2, .directory = at("b")}, never);
  EXPECT_EQ(one.runs, 12U);
  EXPECT_EQ(runs("a"), runs("b"));
}

TEST_F(Campaign, GoesOnWhereItWasInterrupted) {
  play({.runs = 12, .seed = 3, .jobs = 2, .directory = at("whole")}, never);
  int asked = 0;
  play({.runs = 12, .seed = 3, .jobs = 2, .directory = at("parts")}, [&] { return ++asked > 3; });
  std::ofstream(at("parts") / "runs.jsonl", std::ios::app) << R"({"run":11,"fau)";
  play({.runs = 12, .seed = 3, .jobs = 1, .directory = at("parts")}, never);
  EXPECT_EQ(runs("whole"), runs("parts"));
}

TEST_F(Campaign, AnothersRunsAreRefused) {
  play({.runs = 1, .seed = 3, .jobs = 1, .directory = at("a")}, never);
  EXPECT_THROW(play({.runs = 1, .seed = 4, .jobs = 1, .directory = at("a")}, never), std::runtime_error);
}

TEST_F(Campaign, ItsFileKeepsWholeLinesSorted) {
  std::filesystem::create_directories(at(""));
  RunFile file(at("runs.jsonl"), "{\"a\":1}");
  file.append(5, "{\"run\":5}");
  file.append(2, "{\"run\":2}");
  file.finish();
  EXPECT_EQ(host::read_file(at("runs.jsonl")), "{\"a\":1}\n{\"run\":2}\n{\"run\":5}\n");
  EXPECT_EQ(RunFile(at("runs.jsonl"), "{\"a\":1}").runs().size(), 2U);
}

TEST(WorkerPool, EveryTaskIsDoneOnceAndACrashCostsItselfAlone) {
  std::vector<std::uint64_t> tasks(20);
  std::iota(tasks.begin(), tasks.end(), 100);
  std::map<std::uint64_t, PoolResult> results;
  run_in_processes(
      tasks, {.jobs = 3},
      [](std::uint64_t task) {
        if (task == 107) {
          std::raise(SIGKILL);
        }
        if (task == 108) {
          throw std::runtime_error("no");
        }
        return std::to_string(task * 2);
      },
      [&](const PoolResult& result) { EXPECT_TRUE(results.emplace(result.task, result).second); }, never);
  ASSERT_EQ(results.size(), 20U);
  for (const auto& [task, result] : results) {
    if (task == 107) {
      EXPECT_NE(result.failure.find("signal 9"), std::string::npos) << result.failure;
    } else if (task == 108) {
      EXPECT_EQ(result.failure, "no");
    } else {
      EXPECT_EQ(result.line, std::to_string(task * 2));
    }
  }
}

TEST(Minimise, LeavesTheOneFaultAndTheTimeThatFail) {
  FaultCase faults{.name = "three", .setup = {}, .faults = {}};
  faults.faults = {usual(FaultKind::loss, 0, 1000), usual(FaultKind::bus_off, 100, 1500),
                   usual(FaultKind::delay, 0, 50)};
  const FaultCase smallest = minimised(faults, [](const FaultCase& one) {
    return std::any_of(one.faults.begin(), one.faults.end(), [](const Fault& fault) {
      return fault.kind == FaultKind::bus_off && fault.from_ms <= 700 && fault.until_ms > 720;
    });
  });
  ASSERT_EQ(smallest.faults.size(), 1U);
  EXPECT_EQ(smallest.faults[0].kind, FaultKind::bus_off);
  EXPECT_LE(smallest.faults[0].from_ms, 700);
  EXPECT_GT(smallest.faults[0].until_ms, 720);
  EXPECT_LT(smallest.faults[0].until_ms - smallest.faults[0].from_ms, 60);
}

}  // namespace
}  // namespace striker::sil
