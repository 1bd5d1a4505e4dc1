// SPDX-License-Identifier: Apache-2.0
#include "training/run/directory/episode_csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "firmware/host/files.hpp"

namespace striker::training {

namespace {

constexpr int greatest_row_bytes = 120;

// -1 if the line does not begin with a whole number and a comma.
int episode_of(const std::string& line) {
  int episode = -1;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), episode);
  return error == std::errc{} && *end == ',' ? episode : -1;
}

}  // namespace

EpisodeCsv::EpisodeCsv(std::filesystem::path file, std::string header)
    : file_(std::move(file)), header_(std::move(header)), text_(header_) {}

void EpisodeCsv::reserve(int rows) {
  text_.reserve(static_cast<std::size_t>(rows) * greatest_row_bytes);
}

void EpisodeCsv::write() const {
  host::write_file(file_, text_);
}

std::string EpisodeCsv::content() const {
  std::string text = host::read_file(file_);
  if (!text.starts_with(header_)) {
    throw std::runtime_error(fmt::format("{}: line 1 is not \"{}\"; it is not this program's table",
                                         file_.string(), header_.substr(0, header_.size() - 1)));
  }
  return text;
}

void EpisodeCsv::keep(int rows) {
  std::istringstream lines(content());
  text_ = header_;
  std::string line;
  std::getline(lines, line);
  for (int row = 0; row < rows; ++row) {
    // A line without its end was cut off.
    if (!std::getline(lines, line) || lines.eof() || episode_of(line) != row) {
      throw std::runtime_error(
          fmt::format("{}: line {} is not that of episode {}: the table was cut off or "
                      "changed, and the checkpoint counts on {} episodes",
                      file_.string(), row + 2, row, rows));
    }
    text_ += line + "\n";
  }
}

void EpisodeCsv::keep_up_to(int episode) {
  if (!std::filesystem::exists(file_)) {
    return;
  }
  std::istringstream lines(content());
  text_ = header_;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && !lines.eof() && episode_of(line) <= episode) {
    text_ += line + "\n";
  }
}

}  // namespace striker::training
