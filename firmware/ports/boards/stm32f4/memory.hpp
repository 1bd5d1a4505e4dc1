// SPDX-License-Identifier: Apache-2.0
// The registers as they are in the chip's memory.
#pragma once

#include <cstdint>

namespace striker::stm32f4 {

struct Memory {
  static std::uint32_t read(std::uint32_t address) {
    return *reinterpret_cast<const volatile std::uint32_t*>(address);
  }
  static void write(std::uint32_t address, std::uint32_t value) {
    *reinterpret_cast<volatile std::uint32_t*>(address) = value;
  }
};

}  // namespace striker::stm32f4
