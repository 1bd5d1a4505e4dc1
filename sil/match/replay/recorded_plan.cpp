// SPDX-License-Identifier: Apache-2.0
#include "sil/match/replay/recorded_plan.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "firmware/host/files.hpp"
#include "sil/match/play/match_faults.hpp"
#include "sil/match/play/match_setting.hpp"

namespace striker::sil {

namespace {

MatchPlan plan_in(const nlohmann::json& match) {
  MatchPlan plan;
  MatchHeader& header = plan.header;
  match.at("teams").get_to(header.teams);
  header.identities = identities_of(header.teams);
  match.at("seed").get_to(header.seed);
  match.at("plant").get_to(header.plant);
  match.at("slip").get_to(header.slip);
  match.at("jitter_m").get_to(header.jitter_m);
  match.at("jitter_rad").get_to(header.jitter_rad);
  match.at("rule_set").get_to(header.rule_set);
  header.rules = header.rule_set == "published" ? published() : official();
  match.at("rules").at("half_ms").get_to(header.rules.half_ms);
  const auto plant = plant_kind_of(header.plant);
  if (!plant) {
    throw std::runtime_error(fmt::format("\"plant\" is '{}'", header.plant));
  }
  if (!are_sound(header.rules)) {
    throw std::runtime_error(fmt::format("\"half_ms\" is {}", header.rules.half_ms));
  }
  if (!(header.slip >= 0.0 && header.slip <= 1.0)) {
    throw std::runtime_error(fmt::format("\"slip\" is {}, no share from 0 to 1", header.slip));
  }
  constexpr double greatest_jitter = 0.1;
  if (!(header.jitter_m >= 0.0 && header.jitter_m <= greatest_jitter && header.jitter_rad >= 0.0 &&
        header.jitter_rad <= greatest_jitter)) {
    throw std::runtime_error(fmt::format("\"jitter_m\", \"jitter_rad\": {} and {} are not both from 0 to {}",
                                         header.jitter_m, header.jitter_rad, greatest_jitter));
  }
  plan.plant = *plant;
  if (const auto faults = match.at("faults").get<std::string>(); !faults.empty()) {
    add_faults(plan, faults, "\"faults\"");
  }
  return plan;
}

}  // namespace

RecordedMatch read_match(const std::filesystem::path& match_json) {
  try {
    const auto match = nlohmann::json::parse(host::read_file(match_json));
    if (match.at("record") != "striker match" || match.at("format") != 1) {
      throw std::runtime_error("is no match of this format");
    }
    return {.plan = plan_in(match),
            .end = {.complete = match.at("complete").get<bool>(),
                    .state_hash = std::stoull(match.at("state_hash").get<std::string>(), nullptr, 16)},
            .frames = match.at("flow").at("frames").get<std::int64_t>() - 1};
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}; give a directory that 'striker-sil match --out' wrote",
                                         match_json.string(), error.what()));
  }
}

std::optional<std::string> first_other_value(const std::filesystem::path& match_json,
                                             const nlohmann::ordered_json& now) {
  auto recorded = nlohmann::json::parse(host::read_file(match_json));
  nlohmann::json again = nlohmann::json::parse(now.dump());
  for (const std::string_view of_build : keys_of_build) {
    recorded.erase(std::string(of_build));
    again.erase(std::string(of_build));
  }
  const nlohmann::json differences = nlohmann::json::diff(recorded, again);
  if (differences.empty()) {
    return std::nullopt;
  }
  const auto path = differences.front().at("path").get<std::string>();
  const nlohmann::json::json_pointer place(path);
  const auto value_in = [&](const nlohmann::json& report) {
    return report.contains(place) ? report.at(place).dump() : std::string("not there");
  };
  return fmt::format("{} is {}, now {}", path, value_in(recorded), value_in(again));
}

}  // namespace striker::sil
