// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/replay_command.hpp"

#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include "firmware/host/can/lockstep_log.hpp"
#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/bus/socketcan_link.hpp"
#include "sil/programs/kick_options.hpp"
#include "sil/programs/match/replay_match_command.hpp"
#include "sil/programs/robot_options.hpp"

namespace striker::sil {

namespace {

std::unique_ptr<ControllerLink> link_of(const ReplayOptions& options) {
  if (options.bus == "inproc") {
    return std::make_unique<InProcessLink>(core::profile_of(described_robot(options.robot)));
  }
  return std::make_unique<LockstepLink>(
      interface_of(options.bus), SocketCanOptions{std::chrono::milliseconds(options.answer_timeout_ms),
                                                  std::chrono::milliseconds(options.start_timeout_ms)});
}

}  // namespace

void define(CLI::App& replay, ReplayOptions& options) {
  replay
      .add_option(
          "log", options.log,
          "a candump log of a run in lockstep, as 'kick --log' writes it; or the directory of a match: it is "
          "played again as its teams ordered, and compared frame by frame")
      ->required();
  replay.add_option("--interface", options.interface, "of the log, where it has more than one");
  define_robot(replay, options.robot);
  replay
      .add_option("--bus", options.bus,
                  "inproc, or can:IFACE for a 'striker-firmware --challenge-seed 0' there")
      ->check(bus_problem)
      ->capture_default_str();
  replay.add_option("--answer-timeout", options.answer_timeout_ms, "on a bus: for a tick, in ms")
      ->check(CLI::Range(1U, 3'600'000U))
      ->capture_default_str();
  replay.add_option("--start-timeout", options.start_timeout_ms, "on a bus: for the first answer, in ms")
      ->check(CLI::Range(1U, 3'600'000U))
      ->capture_default_str();
  replay.final_callback([&replay, &options] {
    host::require_meaning(replay, !std::filesystem::is_directory(options.log),
                          {"--interface", "--robot", "--bus"}, "a log, not with a match");
    host::require_meaning(replay, options.bus != "inproc", {"--answer-timeout", "--start-timeout"},
                          "--bus can:IFACE");
    require_robot_in_process(replay, options.bus);
  });
}

int play_replay(const ReplayOptions& options) {
  if (std::filesystem::is_directory(options.log)) {
    return play_match_again(options.log);
  }
  host::LockstepLog log(options.log, options.interface);
  const auto link = link_of(options);
  const host::ReplayReport report = host::replay(
      log,
      [&](const host::LoggedTick& tick) {
        std::vector<can::Frame> answer;
        link->send(tick.tick, tick.inputs);
        link->collect(tick.tick, answer);
        return answer;
      },
      host::stop_requested);
  fmt::print("{}", host::format_report(report));
  if (host::stop_requested()) {
    return host::exit_interrupted;
  }
  return report.differing == 0 ? 0 : exit_differs;
}

}  // namespace striker::sil
