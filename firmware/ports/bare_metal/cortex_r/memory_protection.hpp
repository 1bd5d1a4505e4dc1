// SPDX-License-Identifier: Apache-2.0
// What memory may be used for (Armv7-R Architecture Reference Manual, "Protected Memory System Architecture"):
// flash is read-only, RAM is not executed, and the 4 KB below the stack are not touched at all, which is more
// than any frame steps over. Everything else stays as the default map has it.
#pragma once

#include <cstdint>

extern "C" {
// From the linker script: values as addresses.
extern std::uint32_t flash_start;
extern std::uint32_t flash_size_bits;
extern std::uint32_t ram_start;
extern std::uint32_t ram_size_bits;
extern std::uint32_t guard_start;
}

// Tells the linker script that regions have the sizes of the board's memories.
asm(".global memory_map_is_the_boards\n\t"
    ".set memory_map_is_the_boards, 1");

namespace striker::cortex_r {

inline std::uint32_t value_of(const std::uint32_t& symbol) {
  return reinterpret_cast<std::uintptr_t>(&symbol);
}

inline void set_region(std::uint32_t number, std::uint32_t base, std::uint32_t attributes,
                       std::uint32_t size) {
  asm volatile("mcr p15, 0, %0, c6, c2, 0" : : "r"(number));
  asm volatile("mcr p15, 0, %0, c6, c1, 0" : : "r"(base));
  asm volatile("mcr p15, 0, %0, c6, c1, 4" : : "r"(attributes));
  asm volatile("mcr p15, 0, %0, c6, c1, 2" : : "r"(size));
}

inline std::uint32_t size_of(std::uint32_t bits) {
  return (bits - 1) << 1U | 1U;
}

// Once, when memory is prepared. Later regions go before earlier ones; what a boot loader left is switched off.
inline void protect_memory() {
  constexpr std::uint32_t never_executed = 1U << 12U;
  constexpr std::uint32_t read_only = 6U << 8U;
  constexpr std::uint32_t read_write = 3U << 8U;
  constexpr std::uint32_t write_back = 1U << 3U | 1U << 1U | 1U << 0U;
  constexpr std::uint32_t enable = 1U << 0U;
  constexpr std::uint32_t default_map_elsewhere = 1U << 17U;
  std::uint32_t type = 0;
  std::uint32_t control = 0;
  asm volatile("mrc p15, 0, %0, c0, c0, 4" : "=r"(type));
  asm volatile("mrc p15, 0, %0, c1, c0, 0" : "=r"(control));
  asm volatile("dsb\n\tmcr p15, 0, %0, c1, c0, 0\n\tisb" : : "r"(control & ~enable) : "memory");
  for (std::uint32_t number = 3; number < (type >> 8U & 0xFFU); ++number) {
    set_region(number, 0, 0, 0);
  }
  set_region(0, value_of(flash_start), read_only | write_back, size_of(value_of(flash_size_bits)));
  set_region(1, value_of(ram_start), read_write | never_executed | write_back,
             size_of(value_of(ram_size_bits)));
  set_region(2, value_of(guard_start), never_executed | write_back, size_of(12));
  asm volatile("dsb\n\tmcr p15, 0, %0, c1, c0, 0\n\tisb"
               :
               : "r"(control | enable | default_map_elsewhere)
               : "memory");
}

}  // namespace striker::cortex_r
