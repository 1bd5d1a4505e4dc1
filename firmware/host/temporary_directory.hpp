// SPDX-License-Identifier: Apache-2.0
// A directory of this process alone where the system keeps what does not last ($TMPDIR, else /tmp); gone with its
// content when the object goes.
#pragma once

#include <filesystem>

namespace striker::host {

class TemporaryDirectory {
 public:
  // Throws std::runtime_error that names the place if none can be made there.
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace striker::host
