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
#include "sil/scenario/runs/mpi_ranks.hpp"

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

[[noreturn]] void fail(const std::filesystem::path& file, int line_number, const std::string& what) {
  fail(file,
       fmt::format("line {}: {}; remove the line, and its run is carried out again", line_number, what));
}

std::string digest_of(std::string_view header, std::string_view line) {
  std::uint64_t hash = 0xCBF29CE484222325;
  const auto add = [&hash](std::string_view text) {
    for (const char byte : text) {
      hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3;
    }
  };
  add(header);
  add("\n");
  add(line);
  return fmt::format("{:016x}", hash);
}

constexpr std::string_view digest_begin = ",\"digest\":\"";
constexpr std::string_view digest_end = "\"}";
constexpr std::size_t digest_size = digest_begin.size() + 16 + digest_end.size();

// None: it has none.
std::optional<std::string> without_digest(std::string_view line) {
  if (line.size() < digest_size || !line.substr(line.size() - digest_size).starts_with(digest_begin)) {
    return std::nullopt;
  }
  return std::string(line.substr(0, line.size() - digest_size)) + '}';
}

}  // namespace

RunFile::RunFile(std::filesystem::path file, std::string header)
    : file_(std::move(file)), header_(std::move(header)) {
  if (ranks_of_mpirun().rank == 0) {
    lock_.emplace(file_);
  }
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
  int line_number = 0;
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    ++line_number;
    if (line == header_) {
      first = false;  // several processes may have begun the file at once
      continue;
    }
    if (std::exchange(first, false)) {
      fail(file_,
           fmt::format("holds the runs of something else or of another build ({:.200}): give another --out",
                       line));
    }
    take(line_number, line);
  }
  if (first) {
    fail(file_, "is no file of runs: give another --out, or remove it");
  }
}

void RunFile::take(int line_number, std::string_view line) {
  const auto told = without_digest(line);
  if (!told || signed_line(*told) != line) {
    fail(file_, line_number, fmt::format("is not as it was written: \"{:.60}\"", line));
  }
  const auto json = nlohmann::json::parse(*told, nullptr, false);
  if (!json.is_object() || !json.contains("run") || !json["run"].is_number_unsigned()) {
    fail(file_, line_number, fmt::format("is no run: \"{:.60}\"", line));
  }
  const auto number = json["run"].get<std::uint64_t>();
  if (runs_.emplace(number, *told).first->second != *told) {
    fail(file_, line_number, fmt::format("tells the run {} otherwise than a line before it", number));
  }
}

std::string RunFile::signed_line(const std::string& line) const {
  return fmt::format("{}{}{}{}", line.substr(0, line.size() - 1), digest_begin, digest_of(header_, line),
                     digest_end);
}

void RunFile::append(std::uint64_t number, const std::string& line) {
  append_text(file_, signed_line(line) + '\n');
  runs_[number] = line;
}

void RunFile::finish() {
  read_again();
  std::string text = header_ + '\n';
  for (const auto& [number, line] : runs_) {
    text += signed_line(line) + '\n';
  }
  host::write_file(file_, text);
}

}  // namespace striker::sil
