// SPDX-License-Identifier: Apache-2.0
// striker-bus-budget: does every message meet its deadline, and how long is it from picture to torque?
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "firmware/host/command_line.hpp"
#include "sil/budget/budget_report.hpp"
#include "sil/budget/dbc_reader.hpp"
#include "sil/budget/message_set.hpp"
#include "sil/bus/bit_rate.hpp"

namespace {

using namespace striker::sil;

struct Options {
  std::int64_t bitrate = 1'000'000;
  std::int64_t data_bitrate = 0;
  std::string dbc;
  std::int64_t default_distance_ms = 0;
  double errors_per_s = 0.0;
  double jitter_us = 100.0;
  double lateness_us = 100.0;
  double step_us = 50.0;
  bool lockstep = false;
  std::string json;
};

void define(CLI::App& app, Options& options) {
  app.add_option("--bitrate", options.bitrate, "of the bus, in bit/s")
      ->check(CLI::Validator(bit_rate_problem, "bit/s"))
      ->capture_default_str();
  app.add_option("--data-bitrate", options.data_bitrate,
                 "of the data in CAN FD frames that switch, in bit/s; --bitrate or more")
      ->check(CLI::Validator(data_bit_rate_problem, "bit/s"));
  striker::host::reads_file(app.add_option(
      "--dbc", options.dbc,
      "take the messages of this file (GenMsgCycleTime, GenMsgDelayTime, Burst, Deadline), not Striker's own; "
      "classic and CAN FD, 11 and 29 bits"));
  app.add_option("--default-distance-ms", options.default_distance_ms,
                 "shortest distance of messages for which the DBC gives neither period nor distance")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{10'000'000}))
      ->capture_default_str();
  app.add_option("--errors-per-s", options.errors_per_s, "bus errors, no two nearer than 1/X seconds")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  const auto microseconds = CLI::Range(0.0, 1e9);
  app.add_option("--jitter-us", options.jitter_us, "from event to queueing, at most: all but the controller")
      ->check(microseconds)
      ->capture_default_str();
  app.add_option("--lateness-us", options.lateness_us, "of the controller's tick, at most")
      ->check(microseconds)
      ->capture_default_str();
  app.add_option("--step-us", options.step_us, "the controller's receive, step and send, at most")
      ->check(microseconds)
      ->capture_default_str();
  app.add_flag("--lockstep", options.lockstep, "SYNC frames are the ticks: its response is the lateness");
  striker::host::writes_file(app.add_option("--json", options.json, "write the budget"));
}

std::int64_t to_ns(double us) {
  return std::llround(us * 1e3);
}

BusBudget make_budget(const Options& options) {
  if (options.data_bitrate != 0 && options.data_bitrate < options.bitrate) {
    throw std::runtime_error(fmt::format("--data-bitrate {} is slower than --bitrate {}: give that or more",
                                         options.data_bitrate, options.bitrate));
  }
  BusBudget budget;
  budget.source = options.dbc.empty() ? "the message table" : options.dbc;
  budget.bitrate = options.bitrate;
  budget.data_bitrate = options.data_bitrate;
  budget.errors_per_s = options.errors_per_s;
  budget.messages = options.dbc.empty() ? table_messages()
                                        : read_dbc(std::filesystem::path(options.dbc),
                                                   {.default_distance_ms = options.default_distance_ms,
                                                    .has_data_bitrate = options.data_bitrate != 0});
  const BusAssumptions assumptions = budget.assumptions();
  ControllerTime controller{.lateness_ns = to_ns(options.lateness_us), .step_ns = to_ns(options.step_us)};
  if (options.lockstep) {
    const auto lateness_ns = sync_lateness_ns(budget.messages, assumptions, to_ns(options.jitter_us));
    if (!lateness_ns) {
      throw std::runtime_error("--lockstep: no message Sync with a bounded response: leave the option out");
    }
    controller.lateness_ns = *lateness_ns;
  }
  set_jitter(budget.messages, {.controller_ns = controller.lateness_ns + controller.step_ns,
                               .others_ns = to_ns(options.jitter_us)});
  budget.responses = response_times(budget.messages, assumptions);
  budget.decision = decision_deadline(budget.messages, budget.responses, controller);
  return budget;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Worst-case response times on the CAN bus (Davis, Burns, Bril, Lukkien 2007), and from picture to torque "
      "command. Exit status: 0 every deadline is met, 1 one is missed, 2 wrong use.",
      "striker-bus-budget");
  Options options;
  define(app, options);
  return striker::host::run(app, argc, argv, [&] {
    const BusBudget budget = make_budget(options);
    fmt::print("{}", format_table(budget));
    if (!options.json.empty()) {
      write_json(budget, options.json);
    }
    return budget.missed().empty() ? 0 : 1;
  });
}
