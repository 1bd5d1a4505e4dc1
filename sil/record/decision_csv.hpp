// The controller's own integer state at every decision, as CSV: what `striker-evaluate --decisions` compares
// with the float network. Columns: episode, decision, before_contact (0 or 1), action, then the network's
// inputs in the controller's raw units (um, mm/s, binary angle); "@1" is the value one decision ago.
#pragma once

#include <cstdint>
#include <filesystem>

#include "firmware/core/controller.hpp"
#include "firmware/host/atomic_file.hpp"

namespace striker::sil {

// Written to a temporary file, renamed by `finish`. Throws std::runtime_error that names the file.
class DecisionCsv {
 public:
  explicit DecisionCsv(const std::filesystem::path& file);

  // Once a tick; writes a row where the controller has decided since the last call.
  void observe(const core::Controller& controller, std::uint64_t episode, bool before_contact);
  void finish();

 private:
  host::AtomicFile file_;
  std::uint32_t last_number_ = 0;
};

}  // namespace striker::sil
