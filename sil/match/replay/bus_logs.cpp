// SPDX-License-Identifier: Apache-2.0
#include "sil/match/replay/bus_logs.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sil/record/candump_text.hpp"

namespace striker::sil {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) {
  const int error = errno;
  throw std::runtime_error(
      fmt::format("{}: {} ({})", file.string(), what,
                  error == 0 ? "not a gzip file, or a damaged one" : std::generic_category().message(error)));
}

std::filesystem::path part_of(const std::filesystem::path& file) {
  return file.string() + ".part";
}

gzFile stream_of(void* stream) {
  return static_cast<gzFile>(stream);
}

}  // namespace

std::filesystem::path bus_log_file(const std::filesystem::path& directory, std::size_t robot) {
  return directory / fmt::format("vcan{}.log.gz", robot);
}

BusLogs::BusLogs(const std::filesystem::path& directory, std::size_t robots) {
  std::filesystem::create_directories(directory);
  for (std::size_t robot = 0; robot < robots; ++robot) {
    const std::filesystem::path file = bus_log_file(directory, robot);
    // Level 1: a seventh of the text, for a tenth of the time that the best level takes.
    logs_.push_back({.file = file, .stream = gzopen(part_of(file).c_str(), "wbe1")});
    if (logs_.back().stream == nullptr) {
      fail(file, "cannot be written: give an --out with room");
    }
  }
}

BusLogs::~BusLogs() {
  for (const Log& log : logs_) {
    if (log.stream != nullptr) {
      gzclose(stream_of(log.stream));
    }
  }
}

void BusLogs::end_tick(const Snapshot& snapshot) {
  for (std::size_t robot = 0; robot < logs_.size(); ++robot) {
    CandumpText text;
    for (const StampedFrame& stamped : snapshot.robots[robot].frames) {
      append_line(text, robot, stamped);
    }
    const auto size = static_cast<unsigned>(text.size());
    if (size != 0 && gzwrite(stream_of(logs_[robot].stream), text.data(), size) != static_cast<int>(size)) {
      fail(logs_[robot].file, "cannot be written: give an --out with room");
    }
  }
}

void BusLogs::end_run() {
  for (Log& log : logs_) {
    if (gzclose(stream_of(std::exchange(log.stream, nullptr))) != Z_OK) {
      fail(log.file, "cannot be written: give an --out with room");
    }
    std::filesystem::rename(part_of(log.file), log.file);
  }
}

// The reader's line has no end of its own, so that one which is missing in the file is said in words.
std::optional<std::string> BusLogReader::next() {
  std::string line;
  for (;;) {
    const std::size_t end = left_.find('\n');
    line += left_.substr(0, end);
    if (end != std::string_view::npos) {
      left_.remove_prefix(end + 1);
      return line;
    }
    left_ = reader_.next();
    if (left_.empty()) {
      return line.empty() ? std::nullopt : std::optional(line + " (a line without an end)");
    }
  }
}

}  // namespace striker::sil
