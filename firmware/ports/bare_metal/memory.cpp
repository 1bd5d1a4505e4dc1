// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/bare_metal/memory.hpp"

extern "C" {
// From the linker script: addresses, not values.
extern std::uint32_t data_start;
extern std::uint32_t data_end;
extern const std::uint32_t data_load;
extern std::uint32_t bss_start;
extern std::uint32_t bss_end;
extern std::uint32_t stack_bottom;
extern std::uint32_t stack_top;
}

namespace striker::bare_metal {

namespace {

constexpr std::uint32_t paint = 0xC5C5C5C5;
constexpr int guarding_words = 4;

}  // namespace

namespace {

// FNV-1a of the RAM that the stack will have.
std::uint32_t hash_of_stack_memory(const std::uint32_t* end) {
  std::uint32_t hash = 2166136261U;
  for (const volatile std::uint32_t* word = &stack_bottom; word < end; ++word) {
    hash = (hash ^ *word) * 16777619U;
  }
  return hash;
}

std::uint32_t noise = 0;

}  // namespace

std::uint32_t power_on_noise() {
  return noise | 1U;
}

void prepare_memory() {
  const std::uint32_t* from = &data_load;
  for (volatile std::uint32_t* to = &data_start; to != &data_end; ++to) {
    *to = *from++;
  }
  for (volatile std::uint32_t* to = &bss_start; to != &bss_end; ++to) {
    *to = 0;
  }
  const auto* here = static_cast<const std::uint32_t*>(__builtin_frame_address(0));
  noise = hash_of_stack_memory(here - 16);
  for (volatile std::uint32_t* to = &stack_bottom; to < here - 16; ++to) {
    *to = paint;
  }
}

bool stack_is_intact() {
  const volatile std::uint32_t* word = &stack_bottom;
  for (int i = 0; i < guarding_words; ++i) {
    if (word[i] != paint) {
      return false;
    }
  }
  return true;
}

std::uint32_t stack_high_water_bytes() {
  const volatile std::uint32_t* word = &stack_bottom;
  while (word != &stack_top && *word == paint) {
    ++word;
  }
  return static_cast<std::uint32_t>(&stack_top - word) * sizeof(std::uint32_t);
}

}  // namespace striker::bare_metal
