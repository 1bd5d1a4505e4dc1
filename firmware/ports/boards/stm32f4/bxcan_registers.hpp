// SPDX-License-Identifier: Apache-2.0
// CAN1's registers (RM0090, "Controller area network (bxCAN)"), of what the driver uses.
#pragma once

#include <cstdint>

namespace striker::stm32f4::can1 {

inline constexpr std::uint32_t base = 0x40006400;

inline constexpr std::uint32_t control = base + 0x000;  // MCR
inline constexpr std::uint32_t initialise = 1U << 0U;
inline constexpr std::uint32_t sleep = 1U << 1U;
inline constexpr std::uint32_t receive_locked = 1U << 3U;  // a full FIFO drops the newest frame

inline constexpr std::uint32_t status = base + 0x004;  // MSR
inline constexpr std::uint32_t initialising = 1U << 0U;

inline constexpr std::uint32_t transmit_status = base + 0x008;  // TSR
constexpr std::uint32_t completed(std::uint32_t mailbox) {      // cleared, with what tells how, by writing 1
  return 1U << (8 * mailbox);
}
constexpr std::uint32_t was_sent(std::uint32_t mailbox) {
  return 2U << (8 * mailbox);
}
constexpr std::uint32_t take_back(std::uint32_t mailbox) {
  return 0x80U << (8 * mailbox);
}
constexpr std::uint32_t is_empty(std::uint32_t mailbox) {
  return 1U << (26 + mailbox);
}

inline constexpr std::uint32_t receive_fifo = base + 0x00C;  // RF0R
inline constexpr std::uint32_t frames_pending = 3U << 0U;
inline constexpr std::uint32_t release = 1U << 5U;

inline constexpr std::uint32_t interrupts = base + 0x014;  // IER
inline constexpr std::uint32_t on_reception = 1U << 1U;

inline constexpr std::uint32_t errors = base + 0x018;  // ESR
inline constexpr std::uint32_t error_passive = 1U << 1U;
inline constexpr std::uint32_t bus_off = 1U << 2U;

inline constexpr std::uint32_t timing = base + 0x01C;  // BTR, written while initialising alone

// Mailboxes, three to transmit, and the FIFO's oldest: identifier, length, two words of data.
constexpr std::uint32_t transmit_mailbox(std::uint32_t mailbox) {
  return base + 0x180 + 0x10 * mailbox;
}
inline constexpr std::uint32_t receive_mailbox = base + 0x1B0;
inline constexpr std::uint32_t length_offset = 0x4;
inline constexpr std::uint32_t low_offset = 0x8;
inline constexpr std::uint32_t high_offset = 0xC;
inline constexpr std::uint32_t transmit = 1U << 0U;
inline constexpr std::uint32_t remote = 1U << 1U;
inline constexpr std::uint32_t extended = 1U << 2U;
inline constexpr std::uint32_t standard_id_at = 21;

inline constexpr std::uint32_t filter_control = base + 0x200;  // FMR
inline constexpr std::uint32_t filters_initialise = 1U << 0U;
inline constexpr std::uint32_t filter_is_list = base + 0x204;     // FM1R, a bit a bank, as the next three
inline constexpr std::uint32_t filter_is_32_bits = base + 0x20C;  // FS1R
inline constexpr std::uint32_t filter_to_fifo_1 = base + 0x214;   // FFA1R
inline constexpr std::uint32_t filter_is_on = base + 0x21C;       // FA1R
constexpr std::uint32_t filter_bank(std::uint32_t bank) {         // two words, of two identifiers each
  return base + 0x240 + 8 * bank;
}
inline constexpr std::uint32_t filtered_id_at = 5;  // of 16 bits: no remote and no extended frame below it
inline constexpr std::uint32_t banks = 14;          // CAN1's, as reset shares them with CAN2

inline constexpr std::uint32_t reception_line = 20;  // of the interrupt controller: CAN1_RX0

}  // namespace striker::stm32f4::can1
