// SPDX-License-Identifier: Apache-2.0
// A game log of RoboCup's Small Size League, as ssl-log-player and others read it; gzip. All numbers are big-endian.
//
//   file    "SSL_LOG_FILE", int32 version (1), then records
//   record  int64 time of receipt in ns, int32 type, int32 size, then so many bytes: a message
//   index   the last record, time 0: int64 offset of each record before it in the file that is not compressed, int64
//           size of the index record with its own head, "INDEXED"
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sil/match/record/ssl/gzip_file.hpp"

namespace striker::sil {

enum class SslRecord : std::uint8_t { referee = 3, vision = 4, tracker = 5, index = 6 };

class GameLog {
 public:
  explicit GameLog(const std::filesystem::path& file);

  void write(std::int64_t time_ns, SslRecord type, std::string_view message);
  // Adds the index.
  void finish();

 private:
  GzipFile file_;
  std::int64_t size_;  // so far, not compressed
  std::vector<std::int64_t> offsets_;
};

}  // namespace striker::sil
