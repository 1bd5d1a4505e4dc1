// SPDX-License-Identifier: Apache-2.0
// A result file that is there whole or not at all: written under a temporary name, renamed at the end.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace striker::host {

// Everything throws std::runtime_error with one line that names the file and the way out. Without `finish`
// nothing is left behind.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);
  void finish();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path file_;
  std::filesystem::path temporary_;
  std::FILE* stream_ = nullptr;
};

}  // namespace striker::host
