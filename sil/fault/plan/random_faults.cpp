// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/plan/random_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "firmware/can/messages.hpp"
#include "sil/world/random.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::sil {

namespace {

constexpr std::uint64_t most_faults = 3;
constexpr double earliest_ms = -100.0;  // the first picture
constexpr double latest_ms = 1900.0;
constexpr double shortest_fault_ms = 1.0;
constexpr double longest_fault_ms = 2000.0;

std::uint16_t draw_message(Random& random) {
  std::vector<std::uint16_t> identifiers;
  can::for_each_layout([&](const auto& message) { identifiers.push_back(message.info.id); });
  return identifiers[random.below(identifiers.size())];
}

// As many short ones as long ones: evenly over the logarithm.
double draw_log(Random& random, double least, double greatest) {
  return std::exp(random.uniform(std::log(least), std::log(greatest)));
}

std::uint32_t draw_count(Random& random, const ParameterRange& range) {
  return static_cast<std::uint32_t>(
      std::lround(draw_log(random, range.least + 1.0, range.greatest + 1.0) - 1.0));
}

// Two decimals are enough for any parameter, and read better in a plan.
double rounded(double value) {
  return std::round(value * 100.0) / 100.0;
}

std::vector<FaultKindInfo> kinds_in_process() {
  std::vector<FaultKindInfo> kinds;
  const auto all = fault_kinds();
  std::copy_if(all.begin(), all.end(), std::back_inserter(kinds),
               [](const FaultKindInfo& info) { return !info.real_bus; });
  return kinds;
}

Fault draw_fault(Random& random) {
  static const std::vector<FaultKindInfo> kinds = kinds_in_process();
  const FaultKindInfo& info = kinds[random.below(kinds.size())];
  Fault fault = usual(info.kind, 0, 0);
  fault.from_ms = static_cast<std::int32_t>(random.uniform(earliest_ms, latest_ms));
  const auto lasts_ms = static_cast<std::int32_t>(draw_log(random, shortest_fault_ms, longest_fault_ms));
  fault.until_ms = fault.from_ms + (info.at_once ? 1 : lasts_ms);
  if (info.message == MessageParameter::one ||
      (info.message == MessageParameter::any && random.uniform() < 0.7)) {
    fault.message = draw_message(random);
  }
  if (info.kind == FaultKind::masquerade) {
    fault.as = draw_message(random);
  }
  if (info.wheel) {
    fault.wheel = static_cast<FaultyWheel>(random.below(faulty_wheel_names.size()));
  }
  if (info.probability.known() && random.uniform() < 0.5) {
    fault.probability = std::fmax(info.probability.least, rounded(random.uniform()));
  }
  if (info.count.known()) {
    fault.count = draw_count(random, info.count);
  }
  if (info.value.known()) {
    fault.value = rounded(random.uniform(info.value.least, info.value.greatest));
  }
  return fault;
}

}  // namespace

FaultCase random_case(std::uint64_t seed, std::uint64_t number) {
  Random random(seed, number, random_stream::campaign);
  FaultCase result{.name = fmt::format("run {} of seed {}", number, seed), .setup = {}, .faults = {}};
  result.setup.plant = plant_kinds[random.below(plant_kinds.size())];
  result.setup.anywhere = random.below(2) == 1;
  result.setup.seed = seed;
  result.setup.episode = number;
  result.setup.torque_scale = rounded(random.uniform(0.7, 1.3));
  const std::uint64_t faults = 1 + random.below(most_faults);
  for (std::uint64_t i = 0; i < faults; ++i) {
    result.faults.push_back(draw_fault(random));
    result.faults.back().stream = i;
  }
  return result;
}

}  // namespace striker::sil
