// SPDX-License-Identifier: Apache-2.0
// The controller's own integer state at every decision, as CSV: what `striker-evaluate --decisions` compares
// with the float network. Columns: episode, decision, before_contact (0 or 1), action, then the network's
// inputs in the controller's raw units (um, mm/s, binary angle); "@1" is the value one decision ago.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "firmware/host/atomic_file.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "sil/record/observer.hpp"

namespace striker::sil {

// Written to a temporary file, renamed at the end of the run. Throws std::runtime_error that names the file.
class DecisionCsv final : public Observer {
 public:
  // `pilot` outlives it.
  DecisionCsv(const std::filesystem::path& file, const loop::BuiltInPilot& pilot);

  // A row for each decision, as it was when the next one was due: a late picture may have made it again.
  void end_tick(const Snapshot& snapshot) override;
  void end_run() override;

 private:
  struct Row {
    std::uint64_t episode = 0;
    std::uint32_t decision = 0;
    bool before_contact = false;
    std::uint32_t action = 0;
    loop::BuiltInPilot::Inputs inputs = {};
  };

  void write_row();

  host::AtomicFile file_;
  const loop::BuiltInPilot* pilot_;
  std::uint32_t last_decisions_ = 0;
  std::optional<Row> row_;
};

}  // namespace striker::sil
