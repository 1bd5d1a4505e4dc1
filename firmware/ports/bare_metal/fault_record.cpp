// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/bare_metal/fault_record.hpp"

#include <array>
#include <bit>
#include <span>

#include "firmware/ports/bare_metal/reset.hpp"
#include "firmware/ports/bare_metal/watchdog.hpp"

extern "C" {
// From the linker script.
extern striker::bare_metal::KeptFault kept_fault;
}

namespace striker::bare_metal {

namespace {

constexpr std::uint32_t magic = 0x464C5452;

// FNV-1a, over words: RAM that has lost a bit, or never had a record, does not fit. Compiled once: four call it.
[[gnu::noinline]] std::uint32_t check_word(const KeptFault& kept) {
  const auto words = std::bit_cast<std::array<std::uint32_t, sizeof kept / sizeof kept.check>>(kept);
  std::uint32_t hash = 0x811C9DC5;
  for (const std::uint32_t word : std::span(words).first<words.size() - 1>()) {
    hash = (hash ^ word) * 0x01000193;
  }
  return hash;
}

bool is_whole(const KeptFault& kept) {
  return kept.magic == magic && kept.check == check_word(kept);
}

void keep(const FaultRecord& record) {
  const std::uint32_t resets = is_whole(kept_fault) ? kept_fault.record.resets : 0;
  kept_fault = {.magic = magic, .record = record, .untold = 1, .check = 0};
  kept_fault.record.resets = resets + 1;
  kept_fault.check = check_word(kept_fault);
}

bool too_many_resets() {
  return is_whole(kept_fault) && kept_fault.record.resets >= most_resets;
}

}  // namespace

void end_by_fault(const FaultRecord& record) {
  keep(record);
  reset_processor();
}

void count_reset() {
  // The count stops at the limit: a watchdog that goes on through resets keeps the cause as it was.
  if (!too_many_resets() && watchdog_has_expired()) {
    keep({.cause = FaultCause::watchdog});
  }
  if (too_many_resets()) {
    stop_processor();
  }
}

std::optional<FaultRecord> take_last_fault() {
  if (!is_whole(kept_fault) || kept_fault.untold == 0) {
    return std::nullopt;
  }
  kept_fault.untold = 0;
  kept_fault.check = check_word(kept_fault);
  return kept_fault.record;
}

}  // namespace striker::bare_metal
