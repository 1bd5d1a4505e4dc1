// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/ssl/game_log.hpp"

#include <cstddef>
#include <type_traits>

namespace striker::sil {
namespace {

constexpr std::string_view mark = "SSL_LOG_FILE";
constexpr std::int32_t version = 1;
constexpr std::int64_t head_bytes = 16;

template <class T>
std::string big_endian(T value) {
  const auto bits = static_cast<std::make_unsigned_t<T>>(value);
  std::string bytes;
  for (std::size_t byte = sizeof bits; byte > 0; --byte) {
    bytes.push_back(static_cast<char>((bits >> (8U * (byte - 1))) & 0xFFU));
  }
  return bytes;
}

}  // namespace

GameLog::GameLog(const std::filesystem::path& file) : file_(file) {
  const std::string head = std::string(mark) + big_endian(version);
  file_.write(head);
  size_ = static_cast<std::int64_t>(head.size());
}

void GameLog::write(std::int64_t time_ns, SslRecord type, std::string_view message) {
  const auto message_bytes = static_cast<std::int32_t>(message.size());
  file_.write(big_endian(time_ns) + big_endian(static_cast<std::int32_t>(type)) + big_endian(message_bytes));
  file_.write(message);
  offsets_.push_back(size_);
  size_ += head_bytes + message_bytes;
}

void GameLog::finish() {
  std::string index;
  for (const std::int64_t offset : offsets_) {
    index += big_endian(offset);
  }
  constexpr std::string_view end_mark = "INDEXED";
  constexpr std::size_t end_bytes = sizeof(std::int64_t) + end_mark.size();
  index += big_endian(static_cast<std::int64_t>(index.size() + end_bytes) + head_bytes);
  index += end_mark;
  write(0, SslRecord::index, index);
  file_.finish();
}

}  // namespace striker::sil
