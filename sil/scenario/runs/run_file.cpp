// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/runs/run_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "firmware/host/files.hpp"

namespace striker::sil {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

void append_text(const std::filesystem::path& file, const std::string& text) {
  const int handle = open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  const bool written =
      handle >= 0 && write(handle, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const std::string why = std::generic_category().message(errno);
  if (handle >= 0) {
    close(handle);
  }
  if (!written) {
    fail(file, fmt::format("cannot be written ({}): give an --out with room", why));
  }
}

std::uint64_t number_of(const std::filesystem::path& file, const std::string& line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("run") || !json["run"].is_number_unsigned()) {
    fail(file,
         fmt::format("holds a line that is no run: \"{:.60}\"; give another --out, or remove it", line));
  }
  return json["run"].get<std::uint64_t>();
}

}  // namespace

RunFile::RunFile(std::filesystem::path file, std::string header)
    : file_(std::move(file)), header_(std::move(header)) {
  if (!std::filesystem::exists(file_) || std::filesystem::file_size(file_) == 0) {
    append_text(file_, header_ + '\n');
    return;
  }
  read_again();
  cut_incomplete_line();
}

void RunFile::cut_incomplete_line() const {
  const std::string text = host::read_file(file_);
  const std::size_t complete = text.rfind('\n') + 1;
  if (complete < text.size()) {
    std::filesystem::resize_file(file_, complete);
  }
}

void RunFile::read_again() {
  const std::string text = host::read_file(file_);
  std::string_view rest = text;
  bool first = true;
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    const std::string line(rest.substr(0, end));
    rest.remove_prefix(end + 1);
    if (line == header_) {
      first = false;  // several processes may have begun the file at once
      continue;
    }
    if (std::exchange(first, false)) {
      fail(file_,
           fmt::format("holds the runs of something else or of another build ({:.200}): give another --out",
                       line));
    }
    runs_[number_of(file_, line)] = line;
  }
  if (first) {
    fail(file_, "is no file of runs: give another --out, or remove it");
  }
}

void RunFile::append(std::uint64_t number, const std::string& line) {
  append_text(file_, line + '\n');
  runs_[number] = line;
}

void RunFile::finish() {
  std::string text = header_ + '\n';
  for (const auto& [number, line] : runs_) {
    text += line + '\n';
  }
  host::write_file(file_, text);
}

}  // namespace striker::sil
