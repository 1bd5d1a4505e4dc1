// SPDX-License-Identifier: Apache-2.0
// The console of an image on a board without a debugger: what was printed goes out on the bus, in the board's own CAN
// driver's frames or as slcan, again and again, so that it can be read at any time: `candump -a can0,7E0:7FF`.
//
// Once a second: the text, then "status 0" (the exit's), then "received N", the frames that the filters have let through.
#include <algorithm>
#include <array>
#include <cstring>

#include "firmware/can/frame.hpp"
#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/clock.hpp"
#include "tests/images/console.hpp"

namespace striker::images::console {

namespace {

constexpr std::uint16_t text_id = 0x7E0;  // of no message
constexpr std::uint32_t repeat_ticks = 1000;

std::array<char, 512> text;
std::size_t length = 0;
std::uint32_t received = 0;

void take_frames() {
  can::Frame frame;
  while (bare_metal::receive_can(frame)) {
    ++received;
  }
}

void wait_for(std::uint32_t tick) {
  while (static_cast<std::int32_t>(tick - bare_metal::ticks()) > 0) {
    take_frames();
  }
}

// A frame a tick, so that the driver's queue never fills.
void send_text() {
  for (std::size_t at = 0; at < length;) {
    can::Frame frame{.id = text_id};
    for (; frame.length < frame.data.size() && at < length; ++at) {
      frame.data[frame.length++] = static_cast<std::uint8_t>(text[at]);
    }
    wait_for(bare_metal::ticks() + 1);
    static_cast<void>(bare_metal::try_send_can(frame));
  }
}

}  // namespace

// What finds no room is cut.
void print(const char* more) {
  const std::size_t count = std::min(std::strlen(more), text.size() - length);
  std::copy_n(more, count, text.begin() + static_cast<std::ptrdiff_t>(length));
  length += count;
}

void read_command_line(std::span<char>) {}

File::File(const char*) : handle_(-1) {}
File::~File() = default;
bool File::read(std::span<std::uint8_t>) {
  return false;
}

// Does not end: there is nobody to end for.
void exit(int status) {
  bare_metal::start_can();
  bare_metal::start_ticks();
  print_line("status", status);
  const std::size_t printed = length;
  for (;;) {
    const std::uint32_t begin = bare_metal::ticks();
    length = printed;
    print_line("received", received);
    send_text();
    wait_for(begin + repeat_ticks);
  }
}

}  // namespace striker::images::console
