// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/atomic_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace striker::host {

namespace {

constexpr mode_t permissions = 07777;

// Through all links, also those to what is yet to be made.
std::filesystem::path target_of(std::filesystem::path file) {
  constexpr int most_links = 40;  // as the kernel follows
  for (int links = 0; links < most_links && std::filesystem::is_symlink(file); ++links) {
    file = file.parent_path() / std::filesystem::read_symlink(file);
  }
  return file;
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& file, Unfinished unfinished)
    : file_(file), temporary_(file), unfinished_(unfinished) {
  if (std::filesystem::is_directory(file)) {
    errno = EISDIR;
    fail("cannot be written");
  }
  if (!std::filesystem::exists(file) || std::filesystem::is_regular_file(file)) {
    file_ = target_of(file);
    temporary_ = file_;
    temporary_ += ".part";
  }
  stream_ = std::fopen(temporary_.c_str(), "wb");
  if (stream_ == nullptr) {
    fail("cannot be written");
  }
  // What is flushed more often than this goes to the kernel in the very pieces that it was flushed in: whole lines.
  constexpr std::size_t buffer_bytes = 1U << 16U;
  std::setvbuf(stream_, nullptr, _IOFBF, buffer_bytes);
}

AtomicFile::~AtomicFile() {
  if (stream_ == nullptr) {
    return;
  }
  std::fclose(stream_);
  if (unfinished_ == Unfinished::removed && temporary_ != file_) {
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
}

void AtomicFile::fail(const char* what) const {
  const int error = errno;
  std::error_code unknown;
  const bool leaves_a_part =
      unfinished_ == Unfinished::kept && temporary_ != file_ && std::filesystem::exists(temporary_, unknown);
  const std::string kept =
      leaves_a_part ? fmt::format("; what was written before is in {}", temporary_.string()) : "";
  throw std::runtime_error(fmt::format("{}: {} ({}): name a file in a writable directory with room{}",
                                       file_.string(), what, std::strerror(error), kept));
}

void AtomicFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) {
    error_ = errno;
    fail("cannot be written on");
  }
}

void AtomicFile::flush() {
  if (std::fflush(stream_) != 0 && error_ == 0) {
    error_ = errno;
  }
  if (error_ != 0) {
    errno = error_;
    fail("cannot be written on");
  }
}

// Only who may give files away can keep the owner; the others' new file is their own, as every file of theirs.
void AtomicFile::take_over_owner_and_mode() const {
  struct stat before {};
  if (stat(file_.c_str(), &before) == 0) {
    const int handle = fileno(stream_);
    static_cast<void>(fchown(handle, before.st_uid, before.st_gid) == 0);
    static_cast<void>(fchmod(handle, before.st_mode & permissions) == 0);
  }
}

void AtomicFile::finish() {
  flush();
  const bool is_regular = temporary_ != file_;
  if (is_regular) {
    take_over_owner_and_mode();
  }
  const bool closed = std::fclose(std::exchange(stream_, nullptr)) == 0;
  if (closed && (!is_regular || std::rename(temporary_.c_str(), file_.c_str()) == 0)) {
    return;
  }
  const int error = errno;
  if (is_regular && unfinished_ == Unfinished::removed) {
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
  errno = error;
  fail("cannot be completed");
}

}  // namespace striker::host
