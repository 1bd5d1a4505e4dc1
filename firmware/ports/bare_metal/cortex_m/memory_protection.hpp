// SPDX-License-Identifier: Apache-2.0
// What memory may be used for, after the map that every Cortex-M has (Architecture Reference Manuals, "System
// address map"): code below 0x20000000 is read-only, SRAM from there to 0x3FFFFFFF is not executed, and the 4 KB
// below the stack are not touched at all, which is more than any frame steps over. On Armv8-M the stack's limit
// register does the last. RAM below 0x20000000, where a chip has some, and flash that programs itself are out of
// reach with that. Everything else stays as the map has it.
//
// A core without an MPU (a Cortex-M0 has none, others may lack it) keeps the map; an overflow is found by the
// painted words, or by the bus, which has nothing below RAM. The MPU is off in NMI and HardFault, where every fault ends.
#pragma once

#include <cstdint>

extern "C" {
extern std::uint32_t stack_bottom;
extern std::uint32_t guard_start;
}

namespace striker::cortex_m {

struct Mpu {
  std::uint32_t type;
  std::uint32_t control;
  std::uint32_t number;
  std::uint32_t base;
  std::uint32_t extent;  // Armv8-M: the limit. Before: attributes and size
};

inline volatile Mpu& mpu = *reinterpret_cast<volatile Mpu*>(0xE000ED90);

inline constexpr std::uint32_t mpu_enable_over_default_map = 1U << 0U | 1U << 2U;
inline constexpr std::uint32_t sram_start = 0x20000000;

#if __ARM_ARCH >= 8

inline volatile std::uint32_t& mpu_attributes = *reinterpret_cast<volatile std::uint32_t*>(0xE000EDC0);

inline void add_region(std::uint32_t number, std::uint32_t base, std::uint32_t access, std::uint32_t last,
                       std::uint32_t attribute) {
  mpu.number = number;
  mpu.base = base | access;
  mpu.extent = (last & ~31U) | attribute << 1U | 1U;
}

inline void add_regions() {
  constexpr std::uint32_t write_through = 0xAA;
  constexpr std::uint32_t write_back = 0xFF;
  constexpr std::uint32_t read_only = 2U << 1U;
  constexpr std::uint32_t never_executed = 1U << 0U;
  mpu_attributes = write_through | write_back << 8U;
  add_region(0, 0, read_only, sram_start - 1, 0);
  add_region(1, sram_start, never_executed, 2 * sram_start - 1, 1);
  asm volatile("msr msplim, %0" : : "r"(&stack_bottom));
}

#else

inline void add_region(std::uint32_t number, std::uint32_t base, std::uint32_t size_bits,
                       std::uint32_t attributes) {
  mpu.number = number;
  mpu.base = base;
  mpu.extent = attributes | (size_bits - 1) << 1U | 1U;
}

inline void add_regions() {
  constexpr std::uint32_t never_executed = 1U << 28U;
  constexpr std::uint32_t read_only = 6U << 24U;
  constexpr std::uint32_t read_write = 3U << 24U;
  constexpr std::uint32_t write_through = 1U << 17U;
  constexpr std::uint32_t write_back = 1U << 19U | 1U << 17U | 1U << 16U;
  add_region(0, 0, 29, read_only | write_through);
  add_region(1, sram_start, 29, read_write | never_executed | write_back);
  add_region(2, reinterpret_cast<std::uintptr_t>(&guard_start), 12, never_executed | write_back);
}

#endif

// Once, when memory is prepared.
inline void protect_memory() {
  constexpr std::uint32_t regions = 0xFFU << 8U;
  if ((mpu.type & regions) != 0) {
    add_regions();
    mpu.control = mpu_enable_over_default_map;
    asm volatile("dsb\n\tisb" ::: "memory");
  }
}

}  // namespace striker::cortex_m
