// SPDX-License-Identifier: Apache-2.0
// The bus as a candump log (the format of candump -L and of canplayer, python-can and SavvyCAN):
//   (0000000012.345000) vcan0 050#1122334455667788
// The stamp is logical time in seconds, the interface column vcan and the robot's number: same seed, same
// bytes.
#pragma once

#include <filesystem>

#include "firmware/host/atomic_file.hpp"
#include "sil/record/observer.hpp"

namespace striker::sil {

// Written as FILE.part, renamed at the end of the run. Each tick's lines are handed to the kernel at once: a run that
// is killed leaves all of them in FILE.part. Throws std::runtime_error that names the file.
class CandumpLog final : public Observer {
 public:
  explicit CandumpLog(const std::filesystem::path& file) : file_(file, host::Unfinished::kept) {}

  void end_tick(const Snapshot& snapshot) override;
  void end_run() override { file_.finish(); }

 private:
  host::AtomicFile file_;
};

}  // namespace striker::sil
