#include "agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "files.hpp"

namespace striker::training {

namespace {

constexpr std::string_view header =
    "episode,decision,before_contact,action,ball_x_um,ball_y_um,robot_speed_mm_s,ball_vx_mm_s,ball_vy_mm_s,"
    "ball_angle";
constexpr std::size_t columns = 10;
constexpr std::size_t before_contact_column = 2;
constexpr std::size_t action_column = 3;
constexpr std::size_t first_state_column = 4;

using Row = std::array<std::int32_t, columns>;

// False unless the line is ten whole numbers.
bool read_row(std::string_view line, Row& row) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t column = 0; column < columns; ++column) {
    const auto [next, error] = std::from_chars(at, end, row[column]);
    const bool last = column + 1 == columns;
    if (error != std::errc{} || (last ? next != end : (next == end || *next != ','))) {
      return false;
    }
    at = next + 1;
  }
  const bool flag_valid = row[before_contact_column] == 0 || row[before_contact_column] == 1;
  return flag_valid && row[action_column] >= 0 && row[action_column] < actions;
}

}  // namespace

Agreement agreement(const Parameters& parameters, std::span<const Decision> decisions) {
  Agreement result;
  std::size_t same = 0;
  std::size_t clear_same = 0;
  double regret = 0.0;
  for (const Decision& decision : decisions) {
    QValues q = q_values(parameters, features(state_of(decision.state)));
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

std::vector<Decision> load_decisions(const std::filesystem::path& file) {
  std::istringstream stream(read_file(file));
  std::string line;
  if (!std::getline(stream, line) || line != header) {
    throw std::runtime_error(fmt::format(
        "{}: line 1 is not the header of a decisions file of striker-sil: {}", file.string(), header));
  }
  std::vector<Decision> decisions;
  for (int number = 2; std::getline(stream, line); ++number) {
    Row row{};
    if (!read_row(line, row)) {
      throw std::runtime_error(fmt::format(
          "{}: line {}: \"{}\" is not ten whole numbers with before_contact 0 or 1 and action 0 to {}; was "
          "the file cut off?",
          file.string(), number, line.substr(0, 80), actions - 1));
    }
    Decision decision{.action = row[action_column]};
    std::copy(row.begin() + first_state_column, row.end(), decision.state.begin());
    if (row[before_contact_column] == 1) {
      decisions.push_back(decision);
    }
  }
  return decisions;
}

}  // namespace striker::training
