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
  const bool another = decisions != last_decisions_;
  last_decisions_ = decisions;
  if (another || !snapshot.deciding) {
    write_row();
  }
  if (another && snapshot.deciding && decisions != 0) {
    row_ = {.episode = snapshot.episode, .decision = decisions - 1, .before_contact = !snapshot.contact};
  }
  if (row_) {
    row_->action = pilot_->action();
    row_->inputs = pilot_->inputs();
  }
}

void DecisionCsv::end_run() {
  write_row();
  file_.finish();
}

void DecisionCsv::write_row() {
  if (row_) {
    file_.write(fmt::format("{},{},{:d},{},{}\n", row_->episode, row_->decision, row_->before_contact,
                            row_->action, fmt::join(row_->inputs, ",")));
    row_.reset();
  }
}

}  // namespace striker::sil
