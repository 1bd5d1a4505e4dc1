// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/campaign.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

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
  // The digests: FNV-1a of "{"a":1}\n{"run":2}" and of "{"a":1}\n{"run":5}", by another program.
  EXPECT_EQ(host::read_file(at("runs.jsonl")),
            "{\"a\":1}\n{\"run\":2,\"digest\":\"862cd084cc5deba4\"}\n"
            "{\"run\":5,\"digest\":\"862fd084cc60217b\"}\n");
  const RunFile again(at("runs.jsonl"), "{\"a\":1}");
  EXPECT_EQ(again.runs(), (std::map<std::uint64_t, std::string>{{2, "{\"run\":2}"}, {5, "{\"run\":5}"}}));
}

// Each byte of each line but the first: that one says what the file is of.
TEST_F(Campaign, EveryEditOfALineIsToldWithItsNumber) {
  std::filesystem::create_directories(at(""));
  const std::string header = R"({"a":1})";
  {
    RunFile file(at("runs.jsonl"), header);
    file.append(0, R"({"run":0,"reward":1.5})");
    file.append(1, R"({"run":1,"reward":-4})");
  }
  const std::string sound = host::read_file(at("runs.jsonl"));
  const std::size_t second = sound.find('\n') + 1;
  const std::size_t third = sound.find('\n', second) + 1;
  for (std::size_t at_byte = second; at_byte < sound.size(); ++at_byte) {
    if (sound[at_byte] == '\n') {
      continue;
    }
    std::string edited = sound;
    edited[at_byte] = edited[at_byte] == '3' ? '4' : '3';
    host::write_file(at("runs.jsonl"), edited);
    try {
      const RunFile file(at("runs.jsonl"), header);
      FAIL() << edited;
    } catch (const std::runtime_error& error) {
      const std::string place = at_byte < third ? "runs.jsonl: line 2: " : "runs.jsonl: line 3: ";
      EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
  }
}

TEST_F(Campaign, ALineOfAnotherFileOrTwoThatDisagreeAreTold) {
  std::filesystem::create_directories(at(""));
  {
    RunFile(at("other.jsonl"), R"({"a":2})").append(0, R"({"run":0})");
    RunFile file(at("runs.jsonl"), R"({"a":1})");
    file.append(0, R"({"run":0,"reward":1})");
    file.append(0, R"({"run":0,"reward":1})");  // the same, once more: two processes of an mpirun may
    file.finish();
    EXPECT_EQ(file.runs().size(), 1U);
    file.append(0, R"({"run":0,"reward":2})");
  }
  EXPECT_THROW(RunFile(at("runs.jsonl"), R"({"a":1})"), std::runtime_error);
  const std::string other = host::read_file(at("other.jsonl"));
  host::write_file(at("runs.jsonl"), "{\"a\":1}" + other.substr(other.find('\n')));
  EXPECT_THROW(RunFile(at("runs.jsonl"), R"({"a":1})"), std::runtime_error);
}

// The lock is a process's: another one is needed to see it.
TEST_F(Campaign, TheFileOfAProcessThatRunsIsRefused) {
  std::filesystem::create_directories(at(""));
  const auto taken_by_another = [&] {
    const pid_t child = fork();
    if (child == 0) {
      try {
        { const RunFile file(at("runs.jsonl"), R"({"a":1})"); }
        _exit(0);
      } catch (const std::runtime_error& error) {
        _exit(std::string(error.what()).find(std::to_string(getppid())) != std::string::npos ? 1 : 2);
      }
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WEXITSTATUS(status);
  };
  {
    const RunFile file(at("runs.jsonl"), R"({"a":1})");
    EXPECT_EQ(taken_by_another(), 1);
  }
  EXPECT_EQ(taken_by_another(), 0);
  EXPECT_FALSE(std::filesystem::exists(at("runs.jsonl.lock")));
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
