// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tests/images/console.hpp"

namespace striker::images::console {

void print(const char* text) {
  std::fputs(text, stdout);
}

// The image's main takes no arguments: they come from where Linux keeps them.
void read_command_line(std::span<char> line) {
  if (std::FILE* file = std::fopen("/proc/self/cmdline", "rb"); file != nullptr) {
    static_cast<void>(std::fread(line.data(), 1, line.size(), file));
    std::fclose(file);
  }
}

File::File(const char* name) : handle_(::open(name, O_RDONLY | O_CLOEXEC)) {}

File::~File() {
  if (is_open()) {
    ::close(handle_);
  }
}

bool File::read(std::span<std::uint8_t> bytes) {
  return ::read(handle_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
}

void exit(int status) {
  std::exit(status);
}

}  // namespace striker::images::console
