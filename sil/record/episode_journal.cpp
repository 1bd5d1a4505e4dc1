// SPDX-License-Identifier: Apache-2.0
#include "sil/record/episode_journal.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace striker::sil {

namespace {

std::filesystem::path journal_of(std::filesystem::path summary) {
  summary += ".episodes.jsonl";
  return summary;
}

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw std::runtime_error(
      fmt::format("{}: cannot be written ({}): name a file in a writable folder with room", file.string(),
                  std::strerror(errno)));
}

}  // namespace

EpisodeJournal::EpisodeJournal(const std::filesystem::path& summary, std::function<std::string()> row)
    : file_(journal_of(summary)), row_(std::move(row)), stream_(std::fopen(file_.c_str(), "wb")) {
  if (stream_ == nullptr) {
    fail(file_);
  }
}

EpisodeJournal::~EpisodeJournal() {
  std::fclose(stream_);
}

void EpisodeJournal::end_episode() {
  const std::string line = row_();
  if (std::fwrite(line.data(), 1, line.size(), stream_) != line.size() || std::fflush(stream_) != 0) {
    fail(file_);
  }
}

void EpisodeJournal::done() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

}  // namespace striker::sil
