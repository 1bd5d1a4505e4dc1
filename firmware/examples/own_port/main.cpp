// The controller in a main loop of your own: this file, a timer, and a CAN controller.
#include <array>
#include <cstddef>
#include <span>

#include "firmware/core/controller.hpp"
#include "own_port.hpp"

namespace {

using namespace striker;

// More than 1 ms of a 1 Mbit/s bus holds (21 of the shortest frames).
constexpr std::size_t most_frames_a_tick = 24;

// Statics: no heap, and the linker knows what they take.
core::Controller controller;
core::Outputs outputs;
std::array<can::Frame, most_frames_a_tick> received;

std::span<const can::Frame> receive_all() {
  std::size_t count = 0;
  while (count < received.size() && own_port::receive(received[count])) {
    ++count;
  }
  return std::span(received).first(count);
}

}  // namespace

int main() {
  std::uint32_t tick = 0;
  while (own_port::wait_for_tick(tick)) {
    controller.step({.tick = tick, .frames = receive_all()}, outputs);
    for (const can::Frame& frame : outputs.frames()) {
      static_cast<void>(own_port::send(frame));  // the next tick brings a newer one
    }
  }
  return controller.state() == can::State::standby ? 0 : 1;
}
