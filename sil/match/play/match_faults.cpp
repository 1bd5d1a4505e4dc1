// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/match_faults.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "sil/fault/plan/plan_file.hpp"

namespace striker::sil {

namespace {

std::size_t robot_of_case(const FaultCase& one, const std::string& file) {
  constexpr std::string_view prefix = "robot";
  const bool is_robot = one.name.size() == prefix.size() + 1 && one.name.starts_with(prefix) &&
                        one.name.back() >= '0' && one.name.back() <= '9';
  if (!is_robot) {
    throw std::runtime_error(
        fmt::format("{}: the case \"{}\" is of no robot: its name is robot0 to robot9", file, one.name));
  }
  if (one.setup != FaultSetup{}) {
    throw std::runtime_error(fmt::format(
        "{}: {}: plant, pose, seed, episode and torque_scale are the match's, not a case's", file, one.name));
  }
  return static_cast<std::size_t>(one.name.back() - '0');
}

}  // namespace

void add_faults(MatchPlan& plan, std::string_view text, const std::string& file) {
  for (const FaultCase& one : parse_plan(text, file).cases) {
    auto& faults = plan.faults[robot_of_case(one, file)];
    const auto more = timed(one.faults, 0);
    faults.insert(faults.end(), more.begin(), more.end());
  }
  plan.header.faults = text;
}

}  // namespace striker::sil
