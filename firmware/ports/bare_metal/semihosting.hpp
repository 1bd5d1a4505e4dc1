// Arm semihosting (Arm's "Semihosting for AArch32 and AArch64"): a debugger, or QEMU, does an image's input
// and output. Test images only: without a host behind it, the first call stops the processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace striker::semihosting {

void print(const char* text);
void print(std::int64_t number);
void print_line(const char* name, std::int64_t number);  // "name number"

// The word after `name` on the image's command line as a number, or `otherwise`.
[[nodiscard]] std::uint32_t argument(const char* name, std::uint32_t otherwise);

// A host file, read from front to back.
class File {
 public:
  explicit File(const char* name);
  [[nodiscard]] bool is_open() const { return handle_ > 0; }
  // True if all of `bytes` was read.
  [[nodiscard]] bool read(std::span<std::uint8_t> bytes);

 private:
  std::int32_t handle_;
};

[[noreturn]] void exit(int status);

}  // namespace striker::semihosting
