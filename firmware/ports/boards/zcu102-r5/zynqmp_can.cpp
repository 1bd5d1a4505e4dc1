// SPDX-License-Identifier: Apache-2.0
// CAN0 as the board's bus. The boot loader has set its pins and its reference clock, which board.cmake states.
#include "firmware/ports/boards/zcu102-r5/zynqmp_can.hpp"

#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/can_driver/accepted_identifiers.hpp"
#include "firmware/ports/bare_metal/clock.hpp"

namespace striker::bare_metal {

namespace {

#ifdef STRIKER_CAN_WORDS_OF_QEMU
constexpr auto encoding = zcu102::Encoding::qemu;
#else
constexpr auto encoding = zcu102::Encoding::hardware;
#endif

static_assert(zcu102::suits_bit_rate(STRIKER_CAN_CLOCK_HZ), "STRIKER_CAN_CLOCK_HZ gives no 1 Mbit/s");

struct Can0 {
  static volatile std::uint32_t& at(zcu102::CanRegister offset, std::uint32_t words) {
    constexpr std::uintptr_t base = 0xFF060000;
    return *reinterpret_cast<volatile std::uint32_t*>(base + static_cast<std::uint32_t>(offset) + 4 * words);
  }
  static std::uint32_t read(zcu102::CanRegister offset, std::uint32_t words = 0) { return at(offset, words); }
  static void write(zcu102::CanRegister offset, std::uint32_t value, std::uint32_t words = 0) {
    at(offset, words) = value;
  }
};

constinit zcu102::ZynqmpCan<Can0, encoding> controller;

}  // namespace

void start_can() {
  constexpr static auto filters = acceptance_filters<4>(accepted_identifiers);
  controller.start(zcu102::bit_timing(STRIKER_CAN_CLOCK_HZ), filters);
}

bool receive_can(can::Frame& frame) {
  return controller.receive(frame, ticks());
}

bool try_send_can(const can::Frame& frame) {
  return controller.try_send(frame, ticks());
}

can::BusHealth can_health() {
  return controller.health(ticks());
}

}  // namespace striker::bare_metal
