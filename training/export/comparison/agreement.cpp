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
#include "firmware/policy/state_elements.hpp"

namespace striker::training {

namespace {

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

// Without the end of line, of either kind.
std::string_view without_return(std::string_view line) {
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

std::vector<std::string> columns_of(std::string_view header) {
  std::vector<std::string> names;
  std::istringstream stream{std::string(header)};
  for (std::string name; std::getline(stream, name, ',');) {
    names.push_back(name);
  }
  return names;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), why));
}

// Names the first column that is not the expected one.
void require_header(std::string_view line, const std::string& expected, const std::filesystem::path& file) {
  const std::vector<std::string> found = columns_of(line);
  const std::vector<std::string> wanted = columns_of(expected);
  for (std::size_t i = 0; i < std::max(found.size(), wanted.size()); ++i) {
    const std::string is = i < found.size() ? fmt::format("\"{}\"", found[i].substr(0, 40)) : "missing";
    const std::string shall = i < wanted.size() ? fmt::format("\"{}\"", wanted[i]) : "none";
    if (is != shall) {
      refuse(file,
             fmt::format("line 1, column {} is {}, not {}; the model's decisions files begin with {}; give "
                         "one that striker-sil wrote with this policy, or the model's --config",
                         i + 1, is, shall, expected));
    }
  }
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
  const auto share = [](double part, std::size_t whole) {
    return whole == 0 ? std::nullopt : std::optional(part / static_cast<double>(whole));
  };
  result.states = decisions.size();
  result.agreement = share(static_cast<double>(same), result.states);
  result.clear_agreement = share(static_cast<double>(clear_same), result.clear_states);
  result.mean_regret = share(regret, result.states);
  return result;
}

std::string share_text(const std::optional<double>& share, int digits) {
  return share ? fmt::format("{:.{}f}", *share, digits) : "none";
}

std::string decisions_header(const StateInputs& inputs) {
  std::string header = "episode,decision,before_contact,action";
  for (const auto& [element, ago] : inputs) {
    const ElementFacts& facts = facts_of(element);
    if (facts.raw_per_value == 0.0) {
      throw std::runtime_error(fmt::format(
          "the model reads {}, which no controller has: there are no decisions to compare it with",
          facts.name));
    }
    header += fmt::format(",{}", policy::row_of(static_cast<policy::StateElement>(element)).column);
    header += ago > 0 ? fmt::format("@{}", ago) : "";
  }
  return header;
}

std::vector<TakenDecision> load_decisions(const std::filesystem::path& file, const StateInputs& inputs,
                                          int actions) {
  std::istringstream stream(host::read_file(file));
  std::string line;
  std::getline(stream, line);
  require_header(without_return(line), decisions_header(inputs), file);
  Row row(first_state_column + inputs.size());
  std::vector<TakenDecision> decisions;
  for (int number = 2; std::getline(stream, line); ++number) {
    if (stream.eof()) {
      refuse(file, fmt::format("line {}: it has no end: the file was cut off; write it anew", number));
    }
    if (!read_row(without_return(line), row, actions)) {
      refuse(file,
             fmt::format("line {}: \"{}\" is not {} whole numbers with before_contact 0 or 1 and action 0 "
                         "to {}; was the file changed?",
                         number, without_return(line).substr(0, 80), row.size(), actions - 1));
    }
    if (row[before_contact_column] == 1) {
      decisions.push_back(
          {.state = {row.begin() + first_state_column, row.end()}, .action = row[action_column]});
    }
  }
  if (decisions.empty()) {
    refuse(file, "it holds no decision before contact, so that nothing can be compared; play more episodes");
  }
  return decisions;
}

}  // namespace striker::training
