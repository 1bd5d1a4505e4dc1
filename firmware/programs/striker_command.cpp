// SPDX-License-Identifier: Apache-2.0
// striker-command: the operator's tool. Sends a protected command and waits until the controller's status
// shows its effect.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "firmware/can/codec.hpp"
#include "firmware/host/can_socket.hpp"
#include "firmware/host/command_line.hpp"

namespace {

using namespace striker;
using Clock = std::chrono::steady_clock;

constexpr std::array<std::uint16_t, 1> tool_receives = {can::layout<can::Status>.info.id};

// An operator's tool starts with any counter: of two frames in a row, the second always follows the first.
// The bus budget counts on their distance.
template <class Message>
void send_twice(host::CanSocket& socket, const Message& message) {
  can::SendCounter counter;
  socket.send(can::send(message, counter));
  std::this_thread::sleep_for(std::chrono::milliseconds(can::layout<Message>.info.traffic.distance_ms));
  socket.send(can::send(message, counter));
}

// The first status that satisfies `wanted`; without one the last that came, or nothing, after the timeout.
std::optional<can::Status> await_status(host::CanSocket& socket, std::chrono::milliseconds timeout,
                                        const std::function<bool(const can::Status&)>& wanted) {
  std::optional<can::Status> last;
  const auto deadline = Clock::now() + timeout;
  while (Clock::now() < deadline) {
    socket.wait(std::chrono::milliseconds(10));
    while (const auto frame = socket.receive()) {
      can::Status status;
      can::ReceiveCounter any;
      if (can::receive(*frame, any, status) == can::Verdict::accepted) {
        last = status;
        if (wanted(status)) {
          return last;
        }
      }
    }
  }
  return last;
}

std::string describe(const can::Status& status) {
  return fmt::format(
      "state {}, fault {}, vision {}, wheels {}, ignored frames: {} wrong length, {} wrong CRC, {} wrong counter, {} out of range",
      core::name_of(static_cast<core::State>(status.state)),
      core::name_of(static_cast<core::Fault>(status.fault)), status.vision_ready != 0 ? "ready" : "not ready",
      status.wheels_ready != 0 ? "ready" : "not ready", status.wrong_length, status.wrong_crc,
      status.wrong_counter, status.out_of_range);
}

bool has_effect(const std::string& command, const can::Status& status) {
  const auto state = static_cast<core::State>(status.state);
  if (command == "arm") {
    return state == core::State::active;
  }
  if (command == "estop") {
    return state == core::State::fault;
  }
  if (command == "clear") {
    return state != core::State::fault;
  }
  return command == "status" || state != core::State::active;
}

void send_command(host::CanSocket& socket, const std::string& command) {
  if (command == "estop") {
    send_twice(socket, can::EmergencyStop{});
  } else if (command != "status") {
    const can::Mode mode = command == "arm"      ? can::Mode::arm
                           : command == "disarm" ? can::Mode::disarm
                                                 : can::Mode::clear;
    send_twice(socket, can::ModeCommand{.mode = static_cast<std::int32_t>(mode)});
  }
}

int run(const std::string& interface, const std::string& command, std::chrono::milliseconds timeout) {
  host::CanSocket socket(interface, tool_receives);
  send_command(socket, command);
  const auto status =
      await_status(socket, timeout, [&](const can::Status& seen) { return has_effect(command, seen); });
  if (!status) {
    fmt::print(stderr, "striker-command: no status on {} within {} ms: is striker-firmware running{}?\n",
               interface, timeout.count(), command == "status" ? "" : " (the command was sent)");
    return 2;
  }
  const bool done = has_effect(command, *status);
  fmt::print(done ? stdout : stderr, "{}{}\n",
             done ? "" : "striker-command: " + command + " had no effect: ", describe(*status));
  return done ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Sends a command to the controller and waits for its effect. Exit status: 0 done, 1 no effect, 2 no answer or no bus.",
      "striker-command");
  std::string interface;
  unsigned timeout_ms = 1000;
  app.add_option("--can", interface, "CAN interface, for example vcan0")->required();
  app.add_option("--timeout", timeout_ms, "wait this long for a status, in ms")->capture_default_str();
  app.require_subcommand(1);
  app.add_subcommand("arm", "let the controller drive: wants standby, fresh vision and wheel states");
  app.add_subcommand("disarm", "torque 0, back to standby");
  app.add_subcommand("estop", "emergency stop: latches a fault, torque 0");
  app.add_subcommand("clear", "clear the latched fault, if its cause is gone");
  app.add_subcommand("status", "print the controller's state");
  return host::run(app, argc, argv, [&] {
    return run(interface, app.get_subcommands().front()->get_name(), std::chrono::milliseconds(timeout_ms));
  });
}
