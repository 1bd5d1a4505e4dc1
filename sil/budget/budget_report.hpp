// SPDX-License-Identifier: Apache-2.0
// A bus budget as text for a terminal and as JSON. A terminal gets names as they are; JSON is UTF-8, and has U+FFFD
// for what in a name is not.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sil/budget/decision_deadline.hpp"
#include "sil/budget/response_time.hpp"

namespace striker::sil {

struct BusBudget {
  std::string source;  // where the messages come from
  std::int64_t bitrate = 1'000'000;
  std::int64_t data_bitrate = 0;  // of CAN FD frames that switch; 0: there is none
  double errors_per_s = 0.0;
  std::vector<BusMessage> messages;  // in the order of priority
  std::vector<MessageResponse> responses;
  std::optional<DecisionDeadline> decision;

  [[nodiscard]] BusAssumptions assumptions() const;
  [[nodiscard]] std::vector<std::string> missed() const;  // names of the messages that miss their deadline
  [[nodiscard]] std::vector<std::string> events_uncounted() const;  // names, as in BusMessage
};

[[nodiscard]] std::string format_table(const BusBudget& budget);

// Throws std::runtime_error that names the file and the way out.
void write_json(const BusBudget& budget, const std::filesystem::path& file);

}  // namespace striker::sil
