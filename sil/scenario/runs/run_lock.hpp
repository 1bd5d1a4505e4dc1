// SPDX-License-Identifier: Apache-2.0
// One program at a time works at a file of results: FILE.lock beside it is locked as long as this object lives, and
// gone afterwards. The lock is the process's own: its workers do not hold it, and a process that is killed loses it.
#pragma once

#include <filesystem>

namespace striker::sil {

class RunLock {
 public:
  // Throws std::runtime_error that names the file and who is at it, or why it cannot be locked.
  explicit RunLock(const std::filesystem::path& file);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  std::filesystem::path lock_;
  int handle_ = -1;
};

}  // namespace striker::sil
