// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "firmware/host/atomic_file.hpp"

namespace striker::host {

std::string read_file(const std::filesystem::path& file, std::size_t most_bytes) {
  const auto refuse = [&file](const std::string& why) {
    throw std::runtime_error(fmt::format("{}: cannot be read ({})", file.string(), why));
  };
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    refuse(stream ? "it is a directory" : std::generic_category().message(errno));
  }
  constexpr std::size_t piece = std::size_t{1} << 16U;
  std::string text;
  for (std::size_t got = piece; got == piece && text.size() <= most_bytes;) {
    const std::size_t before = text.size();
    text.resize(before + piece);
    stream.read(text.data() + before, piece);
    got = static_cast<std::size_t>(stream.gcount());
    text.resize(before + got);
  }
  if (stream.bad()) {
    refuse(std::generic_category().message(errno));
  }
  if (text.size() > most_bytes) {
    refuse(fmt::format("it has more than {} MiB", most_bytes >> 20U));
  }
  return text;
}

void write_file(const std::filesystem::path& file, std::string_view content) {
  AtomicFile output(file);
  output.write(content);
  output.finish();
}

void require_writable(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    throw std::runtime_error(fmt::format("{}: cannot be made ({}); choose a place that is writable",
                                         directory.string(), error.message()));
  }
  const std::filesystem::path probe =
      directory / fmt::format(".striker-probe-{}", getpid());  // others may probe too
  write_file(probe, "");
  std::filesystem::remove(probe, error);
}

}  // namespace striker::host
