// SPDX-License-Identifier: Apache-2.0
#include "training/export/comparison/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "firmware/host/files.hpp"

namespace striker::training {

namespace {

constexpr std::string_view header_start = "episode,decision,before_contact,action,";
constexpr std::size_t before_contact_column = 2;
constexpr std::size_t action_column = 3;
constexpr std::size_t first_state_column = 4;

using Row = std::vector<std::int32_t>;

// False unless the line fills the row with whole numbers.
bool read_row(std::string_view line, Row& row, int actions) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t column = 0; column < row.size(); ++column) {
    const auto [next, error] = std::from_chars(at, end, row[column]);
    const bool last = column + 1 == row.size();
    if (error != std::errc{} || (last ? next != end : (next == end || *next != ','))) {
      return false;
    }
    at = next + 1;
  }
  const bool flag_valid = row[before_contact_column] == 0 || row[before_contact_column] == 1;
  return flag_valid && row[action_column] >= 0 && row[action_column] < actions;
}

}  // namespace

Agreement agreement(const Parameters& parameters, const StateInputs& inputs,
                    std::span<const TakenDecision> decisions) {
  Actor actor(parameters.shape());
  Agreement result;
  std::size_t same = 0;
  std::size_t clear_same = 0;
  double regret = 0.0;
  for (const TakenDecision& decision : decisions) {
    Eigen::VectorXf q = actor.values(parameters, features_of(inputs, decision.state));
    const int best = greedy_action(q);
    const float best_q = q(best);
    const bool agrees = best == decision.action;
    regret += static_cast<double>(best_q - q(decision.action));
    q(best) = -std::numeric_limits<float>::infinity();
    const bool clear = static_cast<double>(best_q - q.maxCoeff()) > clear_gap;
    same += agrees ? 1 : 0;
    clear_same += agrees && clear ? 1 : 0;
    result.clear_states += clear ? 1 : 0;
  }
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
  };
  result.states = decisions.size();
  result.agreement = share(same, result.states);
  result.clear_agreement = share(clear_same, result.clear_states);
  result.mean_regret = result.states == 0 ? 0.0 : regret / static_cast<double>(result.states);
  return result;
}

std::vector<TakenDecision> load_decisions(const std::filesystem::path& file, const Shape& shape) {
  std::istringstream stream(host::read_file(file));
  std::string line;
  Row row(first_state_column + static_cast<std::size_t>(shape.inputs));
  const bool starts = std::getline(stream, line) && line.starts_with(header_start);
  if (!starts || std::count(line.begin(), line.end(), ',') + 1 != static_cast<std::ptrdiff_t>(row.size())) {
    throw std::runtime_error(
        fmt::format("{}: line 1 is not the header of a decisions file of striker-sil: {} "
                    "and then a column for each of the network's {} inputs",
                    file.string(), header_start, shape.inputs));
  }
  std::vector<TakenDecision> decisions;
  for (int number = 2; std::getline(stream, line); ++number) {
    if (!read_row(line, row, shape.actions)) {
      throw std::runtime_error(
          fmt::format("{}: line {}: \"{}\" is not {} whole numbers with before_contact 0 "
                      "or 1 and action 0 to {}; was the file cut off?",
                      file.string(), number, line.substr(0, 80), row.size(), shape.actions - 1));
    }
    if (row[before_contact_column] == 1) {
      decisions.push_back(
          {.state = {row.begin() + first_state_column, row.end()}, .action = row[action_column]});
    }
  }
  return decisions;
}

}  // namespace striker::training
