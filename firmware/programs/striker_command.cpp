// SPDX-License-Identifier: Apache-2.0
// striker-command: the operator's tool. Sends a protected command, gives consent where the controller asks for it,
// and waits until fresh statuses show the effect.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "firmware/can/codec.hpp"
#include "firmware/can/message_receiver.hpp"
#include "firmware/core/supervision/vigilance.hpp"
#include "firmware/host/can/can_socket.hpp"
#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"

namespace {

using namespace striker;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::array<std::uint16_t, 4> tool_receives = {
    can::layout<can::Status>.info.id, can::layout<can::Safety>.info.id, can::layout<can::Challenge>.info.id,
    can::layout<can::EmergencyStop>.info.id};

// Longer than the window in which a controller's statuses are believed: what repeats old ones never gets there.
constexpr int statuses_to_believe = 16;

constexpr milliseconds ask_again{300};
constexpr milliseconds renew_every{1000};
constexpr milliseconds stop_hold{core::stop_hold_ticks};

// What the controller says of itself. `status` is there once statuses have come in sequence for long enough.
class Controller {
 public:
  explicit Controller(host::CanSocket& socket) : socket_(&socket) {}

  void listen(milliseconds limit) {
    socket_->wait(limit);
    while (const auto frame = socket_->receive()) {
      hear(*frame);
    }
  }

  [[nodiscard]] bool heard() const { return believed_ >= statuses_to_believe; }
  [[nodiscard]] const can::Status& status() const { return status_; }
  [[nodiscard]] core::State state() const { return static_cast<core::State>(status_.state); }
  [[nodiscard]] bool is_stopped() const {
    return (static_cast<core::Faults>(safety_.faults) & core::set_of(core::Fault::emergency_stop)) != 0;
  }
  // How long ago a stop's last frame came; before this tool listened none is known of.
  [[nodiscard]] std::optional<milliseconds> last_stop_ago() const {
    return last_stop_ ? std::optional(std::chrono::duration_cast<milliseconds>(Clock::now() - *last_stop_))
                      : std::nullopt;
  }
  // What it asked back, once.
  std::optional<can::Challenge> take_challenge() { return std::exchange(challenge_, std::nullopt); }

 private:
  void hear(const can::Frame& frame) {
    can::Challenge challenge;
    can::EmergencyStop stop;
    const auto now = std::chrono::duration_cast<milliseconds>(Clock::now().time_since_epoch()).count();
    const auto tick = static_cast<std::uint32_t>(now);
    if (can::is<can::Status>(frame)) {
      const bool accepted = statuses_.take(frame, tick, status_) == can::Verdict::accepted;
      believed_ = accepted ? believed_ + 1 : 0;
    } else if (can::is<can::Safety>(frame)) {
      can::Safety safety;
      safety_ = can::receive(frame, safety) == can::Verdict::accepted ? safety : safety_;
    } else if (can::is<can::Challenge>(frame) && can::receive(frame, challenge) == can::Verdict::accepted) {
      challenge_ = challenge;
    } else if (can::is<can::EmergencyStop>(frame) && can::receive(frame, stop) == can::Verdict::accepted) {
      last_stop_ = Clock::now();
    }
  }

  host::CanSocket* socket_;
  can::MessageReceiver<can::Status> statuses_;
  can::Status status_;
  can::Safety safety_;
  std::optional<can::Challenge> challenge_;
  std::optional<Clock::time_point> last_stop_;  // that was heard
  int believed_ = 0;                            // statuses in a row
};

std::string describe(const Controller& controller) {
  const can::Status& status = controller.status();
  return fmt::format(
      "state {}{}, fault {}{}, vision {}, wheels {}, ignored frames: {} wrong length, {} wrong CRC, {} wrong counter, {} "
      "out of range",
      core::name_of(controller.state()), status.kick_over != 0 ? " (kick over)" : "",
      core::name_of(static_cast<core::Fault>(status.fault)), controller.is_stopped() ? ", stopped" : "",
      status.vision_ready != 0 ? "ready" : "not ready", status.wheels_ready != 0 ? "ready" : "not ready",
      status.wrong_length, status.wrong_crc, status.wrong_counter, status.out_of_range);
}

// Why a clear after a stop may need no more than time. The controller does not tell how long it still holds.
std::string hold_text(const Controller& controller, milliseconds listened) {
  if (!controller.is_stopped()) {
    return {};
  }
  if (const auto ago = controller.last_stop_ago()) {
    return fmt::format(
        "; stop frames still come, the last one {} ms ago: a stop holds for {} ms after it; end them, then "
        "clear again",
        ago->count(), stop_hold.count());
  }
  return fmt::format(
      "; a stop holds for {} ms after its last frame, this one for another {} ms at most: clear again",
      stop_hold.count(), std::max(stop_hold - listened, milliseconds(0)).count());
}

bool has_effect(const std::string& command, const Controller& controller) {
  if (!controller.heard()) {
    return false;
  }
  const core::State state = controller.state();
  if (command == "arm") {
    return state == core::State::active;
  }
  if (command == "estop") {
    return controller.is_stopped();
  }
  if (command == "clear") {
    return state != core::State::fault;
  }
  return command == "status" || state != core::State::active;
}

class Tool {
 public:
  Tool(host::CanSocket& socket, std::string command)
      : socket_(&socket), controller_(socket), command_(std::move(command)) {}

  // Until the command's effect is seen, or the limit has passed.
  bool run(milliseconds limit) {
    const auto deadline = Clock::now() + limit;
    auto ask_at = Clock::now();
    while (Clock::now() < deadline && !host::stop_requested()) {
      if (Clock::now() >= ask_at) {
        send();
        ask_at = Clock::now() + ask_again;
      }
      controller_.listen(milliseconds(10));
      consent();
      if (has_effect(command_, controller_)) {
        return true;
      }
    }
    return false;
  }

  // Keeps the controller armed until a stop signal, then disarms it.
  void hold() {
    while (!host::stop_requested() && controller_.state() == core::State::active) {
      mode(can::Mode::renew, 0);
      for (milliseconds passed{0}; passed < renew_every && !host::stop_requested();
           passed += milliseconds(10)) {
        controller_.listen(milliseconds(10));
      }
    }
    mode(can::Mode::disarm, 0);
  }

  [[nodiscard]] const Controller& controller() const { return controller_; }

 private:
  void send() {
    if (command_ == "estop") {
      socket_->send(can::send(can::EmergencyStop{}, stops_));
    } else if (command_ != "status") {
      const can::Mode wanted = command_ == "arm"     ? can::Mode::arm
                               : command_ == "clear" ? can::Mode::clear
                                                     : can::Mode::disarm;
      mode(wanted, 0);
    }
  }
  void mode(can::Mode mode, std::int32_t challenge) {
    socket_->send(
        can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode), .challenge = challenge}, modes_));
  }
  void consent() {
    const auto challenge = controller_.take_challenge();
    const auto asked = command_ == "arm" ? can::Mode::arm : can::Mode::clear;
    if (challenge && (command_ == "arm" || command_ == "clear") &&
        challenge->mode == static_cast<std::int32_t>(asked)) {
      mode(asked, challenge->challenge);
    }
  }

  host::CanSocket* socket_;
  Controller controller_;
  std::string command_;
  can::SendCounter modes_;
  can::SendCounter stops_;
};

int run(const std::string& interface, const std::string& command, milliseconds timeout, bool hold) {
  host::CanSocket socket(interface, tool_receives);
  Tool tool(socket, command);
  const auto begin = Clock::now();
  const bool done = tool.run(timeout);
  const auto listened = std::chrono::duration_cast<milliseconds>(Clock::now() - begin);
  if (!tool.controller().heard()) {
    fmt::print(stderr,
               "striker-command: no fresh status on {} within {} ms: is striker-firmware running{}?\n",
               interface, timeout.count(), command == "status" ? "" : " (the command was sent)");
    return 2;
  }
  fmt::print(done ? stdout : stderr, "{}{}{}\n",
             done ? "" : "striker-command: " + command + " had no effect: ", describe(tool.controller()),
             done || command != "clear" ? "" : hold_text(tool.controller(), listened));
  if (done && hold) {
    fmt::print("renewed every second; Ctrl-C disarms\n");
    std::fflush(stdout);
    tool.hold();
  }
  return done ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Sends a command to the controller and waits for its effect. Exit status: 0 done, 1 no effect, 2 no answer or "
      "no bus.",
      "striker-command");
  std::string interface;
  unsigned timeout_ms = 1000;
  bool hold = false;
  app.add_option("--can", interface, "CAN interface, for example vcan0")->required();
  app.add_option("--timeout", timeout_ms, "wait this long for an effect, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
  app.require_subcommand(1);
  auto* arm = app.add_subcommand(
      "arm", "let the controller drive, for 10 s: wants standby, fresh vision and wheel states");
  arm->add_flag("--hold", hold, "renew it until Ctrl-C, then disarm");
  app.add_subcommand("disarm", "torque 0, back to standby");
  app.add_subcommand("estop", "emergency stop: latches a fault, torque 0");
  app.add_subcommand("clear", "clear the latched faults, if their causes are gone; a stop holds for 200 ms");
  app.add_subcommand("status", "print the controller's state");
  return host::run(app, argc, argv, [&] {
    host::catch_stop_signals();
    return run(interface, app.get_subcommands().front()->get_name(), milliseconds(timeout_ms), hold);
  });
}
