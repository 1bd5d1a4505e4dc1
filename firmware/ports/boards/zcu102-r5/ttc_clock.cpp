// SPDX-License-Identifier: Apache-2.0
// Ticks from the first triple timer counter (AMD UG1087, module TTC), eight of its clocks a count.
//
// As wide as it is: 32 bits on the Zynq UltraScale+, which wrap after 343 s, and the Zynq-7000's 16 on QEMU, which
// wrap after 3.9 ms. The interval register, which counting over the whole range does not use, has the counter's width:
// of the ones that are written into it, those that are there come back.
//
// The counter begins anew in its upper half, instead of wrapping: QEMU 7.2 never returns from a wrap where its virtual
// time counts instructions (the event that it computes is 0 ns ahead, for ever). That loses less than a count each
// time, 40 ppm on QEMU.
#include "firmware/ports/bare_metal/clock.hpp"
#include "firmware/ports/boards/zcu102-r5/counted_ticks.hpp"

namespace striker::bare_metal {

namespace {

constexpr std::uintptr_t base = 0xFF110000;
constexpr std::uint32_t clocks_a_count = 8;
constexpr std::uint32_t counts_a_tick = STRIKER_CLOCK_HZ / clocks_a_count / 1'000;
static_assert(counts_a_tick * clocks_a_count * 1'000 == STRIKER_CLOCK_HZ,
              "a tick is a whole number of counts");

constexpr std::uint32_t prescale_by_8 = 1U << 0U | 2U << 1U;
constexpr std::uint32_t reset_and_run = 1U << 4U;  // of the counter control: overflow mode, upwards

volatile std::uint32_t& clock_control = *reinterpret_cast<volatile std::uint32_t*>(base + 0x00);
volatile std::uint32_t& counter_control = *reinterpret_cast<volatile std::uint32_t*>(base + 0x0C);
volatile std::uint32_t& counter = *reinterpret_cast<volatile std::uint32_t*>(base + 0x18);
volatile std::uint32_t& interval = *reinterpret_cast<volatile std::uint32_t*>(base + 0x24);

constinit zcu102::CountedTicks counted(0xFFFFFFFF, counts_a_tick, 0);

}  // namespace

void start_ticks() {
  clock_control = prescale_by_8;
  interval = 0xFFFFFFFF;
  counter_control = reset_and_run;
  counted = zcu102::CountedTicks(interval, counts_a_tick, counter);
}

std::uint32_t ticks() {
  const std::uint32_t count = counter;
  const std::uint32_t passed = counted.ticks(count);
  if (counted.is_due_to_restart(count)) {
    counter_control = reset_and_run;
    counted.restart(count);
  }
  return passed;
}

std::uint32_t since_tick_us() {
  return counted.since_tick_us(counter);
}

}  // namespace striker::bare_metal
