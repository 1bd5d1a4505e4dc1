// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/atomic_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace striker::host {

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file)), temporary_(file_) {
  temporary_ += ".part";
  if (std::filesystem::is_directory(file_)) {
    errno = EISDIR;
    fail("cannot be written");
  }
  stream_ = std::fopen(temporary_.c_str(), "wb");
  if (stream_ == nullptr) {
    fail("cannot be written");
  }
}

AtomicFile::~AtomicFile() {
  if (stream_ != nullptr) {
    std::fclose(stream_);
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
}

void AtomicFile::fail(const char* what) const {
  throw std::runtime_error(fmt::format("{}: {} ({}): name a file in a writable directory with room",
                                       file_.string(), what, std::strerror(errno)));
}

void AtomicFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) {
    fail("cannot be written on");
  }
}

void AtomicFile::finish() {
  std::FILE* stream = std::exchange(stream_, nullptr);
  const bool flushed = std::fflush(stream) == 0;
  const bool closed = std::fclose(stream) == 0;
  if (!flushed || !closed || std::rename(temporary_.c_str(), file_.c_str()) != 0) {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
    errno = error;
    fail("cannot be completed");
  }
}

}  // namespace striker::host
