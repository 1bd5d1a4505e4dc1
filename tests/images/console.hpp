// SPDX-License-Identifier: Apache-2.0
// What a test image needs of the world outside: a text output, its command line, a file to read, an end.
//
// On targets this is Arm semihosting ("Semihosting for AArch32 and AArch64"): a debugger or QEMU does it, and
// without one behind it the first call stops the processor. On the host it is Linux.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace striker::images::console {

// ---- semihosting_console.cpp, host_console.cpp ----------------------------------------------------------

void print(const char* text);

// Fills `line` with the words that the image was started with, its own name first, each ended by '\0'. The
// line has to be zero before; what does not fit is cut.
void read_command_line(std::span<char> line);

// A host file, read from front to back.
class File {
 public:
  explicit File(const char* name);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  [[nodiscard]] bool is_open() const { return handle_ >= 0; }
  // True if all of `bytes` was read.
  [[nodiscard]] bool read(std::span<std::uint8_t> bytes);

 private:
  std::int32_t handle_;
};

[[noreturn]] void exit(int status);

// ---- console.cpp ----------------------------------------------------------------------------------------

void print(std::int64_t number);
void print_line(const char* name, std::int64_t number);  // "name number"

// The word after `name` on the command line; it stays valid. Null without one.
[[nodiscard]] const char* word_argument(const char* name);

// The same as a number; `otherwise` without one.
[[nodiscard]] std::uint32_t argument(const char* name, std::uint32_t otherwise);

}  // namespace striker::images::console
