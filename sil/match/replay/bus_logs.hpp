// SPDX-License-Identifier: Apache-2.0
// The ten buses of a match as candump logs, gzipped: DIR/vcan0.log.gz to DIR/vcan9.log.gz. A minute of play is some
// 7 MB of text a bus, and a seventh of that compressed; python-can's LogReader reads them as they are, all else after
// gunzip. Stamps are logical time: same match, same bytes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sil/match/replay/gzip_reader.hpp"
#include "sil/record/observer.hpp"

namespace striker::sil {

[[nodiscard]] std::filesystem::path bus_log_file(const std::filesystem::path& directory, std::size_t robot);

// Written as FILE.part, renamed at the end of the run. Throws std::runtime_error that names the file.
class BusLogs final : public Observer {
 public:
  BusLogs(const std::filesystem::path& directory, std::size_t robots);
  ~BusLogs() override;
  BusLogs(const BusLogs&) = delete;
  BusLogs& operator=(const BusLogs&) = delete;

  void end_tick(const Snapshot& snapshot) override;
  void end_run() override;

 private:
  struct Log {
    std::filesystem::path file;
    void* stream = nullptr;  // zlib's gzFile
  };

  std::vector<Log> logs_;
};

// Reads one, gzipped or not, line by line, without its end; a last line that has none says so. Throws
// std::runtime_error that names the file, also if it holds anything behind what was compressed.
class BusLogReader {
 public:
  explicit BusLogReader(const std::filesystem::path& file) : reader_(file) {}

  // None at the end.
  [[nodiscard]] std::optional<std::string> next();

 private:
  GzipReader reader_;
  std::string_view left_;  // of what was read last
};

}  // namespace striker::sil
