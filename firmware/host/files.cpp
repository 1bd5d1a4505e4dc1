// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "firmware/host/atomic_file.hpp"

namespace striker::host {

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    const std::string why = stream ? "it is a directory" : std::generic_category().message(errno);
    throw std::runtime_error(fmt::format("{}: cannot be read ({})", file.string(), why));
  }
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
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
