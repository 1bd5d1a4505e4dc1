// SPDX-License-Identifier: Apache-2.0
#include "sil/record/decision_csv.hpp"

#include <fmt/format.h>

#include <string>

namespace striker::sil {

DecisionCsv::DecisionCsv(const std::filesystem::path& file, const loop::BuiltInPilot& pilot)
    : file_(file), pilot_(&pilot) {
  std::string header = "episode,decision,before_contact,action";
  for (const auto& [element, ago] : loop::BuiltInPilot::state) {
    header += fmt::format(",{}", policy::row_of(element).column);
    header += ago > 0 ? fmt::format("@{}", ago) : "";
  }
  file_.write(header + "\n");
}

void DecisionCsv::end_tick(const Snapshot& snapshot) {
  const std::uint32_t decisions = pilot_->decisions();
  if (!snapshot.deciding || decisions == last_decisions_) {
    return;
  }
  last_decisions_ = decisions;
  if (decisions == 0) {
    return;
  }
  file_.write(fmt::format("{},{},{:d},{},{}\n", snapshot.episode, decisions - 1, !snapshot.contact,
                          pilot_->action(), fmt::join(pilot_->inputs(), ",")));
}

}  // namespace striker::sil
