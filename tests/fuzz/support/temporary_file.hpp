// SPDX-License-Identifier: Apache-2.0
// An input as a file, for readers that take a path: in memory, one a process.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/fuzz/support/bytes.hpp"

namespace striker::fuzz {

inline std::filesystem::path file_of(const std::uint8_t* data, std::size_t size) {
  static const int file = memfd_create("input", 0);
  require(file >= 0 && ftruncate(file, 0) == 0 && pwrite(file, data, size, 0) == static_cast<ssize_t>(size),
          "this machine has memory for the input");
  return "/proc/self/fd/" + std::to_string(file);
}

}  // namespace striker::fuzz
