// The controller's own integer state at every decision, as CSV: what `striker-evaluate --decisions` compares
// with the float network. Columns: episode, decision, before_contact (0 or 1), action, then the network's
// inputs in the controller's raw units (um, mm/s, binary angle); "@1" is the value one decision ago.
#pragma once

#include <cstdint>
#include <filesystem>

#include "firmware/core/controller.hpp"
#include "firmware/host/atomic_file.hpp"
#include "sil/record/observer.hpp"

namespace striker::sil {

// Written to a temporary file, renamed at the end of the run. Throws std::runtime_error that names the file.
class DecisionCsv final : public Observer {
 public:
  // `controller` outlives it.
  DecisionCsv(const std::filesystem::path& file, const core::Controller& controller);

  // A row where the controller has decided since the last tick.
  void end_tick(const Snapshot& snapshot) override;
  void end_run() override { file_.finish(); }

 private:
  host::AtomicFile file_;
  const core::Controller* controller_;
  std::uint32_t last_number_ = 0;
};

}  // namespace striker::sil
