#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/slcan.hpp"
#include "firmware/ports/bare_metal/uart.hpp"

namespace striker::bare_metal {

namespace {

SlcanReader reader;

}  // namespace

void start_can() {
  uart::start();
}

bool receive_can(can::Frame& frame) {
  while (uart::has_letter()) {
    if (reader.take(uart::take_letter(), frame)) {
      return true;
    }
  }
  return false;
}

bool try_send_can(const can::Frame& frame) {
  const SlcanLine line = slcan_line(frame);
  for (std::size_t i = 0; i < line.length; ++i) {
    uart::put_letter(line.text[i]);
  }
  return true;
}

can::BusHealth can_health() {
  return can::BusHealth::active;
}

}  // namespace striker::bare_metal
