// SPDX-License-Identifier: Apache-2.0
#include "tests/images/console.hpp"

#include <cstring>

namespace striker::images::console {

namespace {

enum class Operation : std::uint32_t {
  open = 0x01,
  close = 0x02,
  write0 = 0x04,
  read = 0x06,
  get_command_line = 0x15,
  exit_extended = 0x20,
};

constexpr std::uint32_t application_exit = 0x20026;

std::int32_t call(Operation operation, const void* parameter) {
  register std::uint32_t r0 asm("r0") = static_cast<std::uint32_t>(operation);
  register const void* r1 asm("r1") = parameter;
#if __ARM_ARCH_PROFILE == 'M'
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
#else
  asm volatile("svc 0xab" : "+r"(r0) : "r"(r1) : "memory", "lr");
#endif
  return static_cast<std::int32_t>(r0);
}

}  // namespace

void print(const char* text) {
  call(Operation::write0, text);
}

void read_command_line(std::span<char> line) {
  struct {
    char* text;
    std::uint32_t length;
  } const block{line.data(), line.size()};
  if (call(Operation::get_command_line, &block) != 0) {
    return;
  }
  for (char& letter : line) {
    letter = letter == ' ' ? '\0' : letter;
  }
}

File::File(const char* name) {
  struct {
    const char* name;
    std::uint32_t mode;  // 1: "rb"
    std::uint32_t length;
  } const block{name, 1, std::strlen(name)};
  handle_ = call(Operation::open, &block);
}

File::~File() {
  if (is_open()) {
    call(Operation::close, &handle_);
  }
}

bool File::read(std::span<std::uint8_t> bytes) {
  struct {
    std::int32_t handle;
    std::uint8_t* to;
    std::uint32_t length;
  } const block{handle_, bytes.data(), bytes.size()};
  return call(Operation::read, &block) == 0;
}

void exit(int status) {
  struct {
    std::uint32_t reason;
    std::uint32_t status;
  } const block{application_exit, static_cast<std::uint32_t>(status)};
  call(Operation::exit_extended, &block);
  for (;;) {
  }
}

}  // namespace striker::images::console
