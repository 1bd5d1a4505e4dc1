// SPDX-License-Identifier: Apache-2.0
// A result file that is there whole or not at all: written under a temporary name beside it, FILE.part, renamed at
// the end.
//
// What was there keeps its owner, group and mode. A symbolic link stays one: the file that it points to is replaced.
// What is no regular file (/dev/null, a FIFO, /dev/stdout) is written into as it is.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace striker::host {

// Without `finish`: nothing is left behind; or FILE.part with all that was flushed, for records of a run that may
// end at any moment.
enum class Unfinished : std::uint8_t { removed, kept };

// Everything throws std::runtime_error with one line that names the file and the way out.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& file, Unfinished unfinished = Unfinished::removed);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);
  // Hands all that was written to the kernel: a killed process has not lost it.
  void flush();
  void finish();

 private:
  [[noreturn]] void fail(const char* what) const;
  void take_over_owner_and_mode() const;

  std::filesystem::path file_;       // where links lead to
  std::filesystem::path temporary_;  // the same for what is no regular file
  Unfinished unfinished_;
  std::FILE* stream_ = nullptr;
  int error_ = 0;  // why something was not taken: it never becomes the file
};

}  // namespace striker::host
