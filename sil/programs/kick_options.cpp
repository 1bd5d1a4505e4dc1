// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/kick_options.hpp"

#include <vector>

#include "firmware/host/command_line.hpp"
#include "sil/bus/bit_rate.hpp"
#include "sil/bus/controller_messages.hpp"
#include "sil/programs/robot_options.hpp"
#include "sil/robot/plant.hpp"

namespace striker::sil {

namespace {

std::vector<std::string> plant_names() {
  std::vector<std::string> names;
  names.reserve(plant_kinds.size());
  for (const PlantKind kind : plant_kinds) {
    names.emplace_back(name_of(kind));
  }
  return names;
}

void define_episodes(CLI::App& kick, KickOptions& options) {
  kick.add_option("--plant", options.plant, "servo: the paper's motors, 10 ms; drive: torque drives, 1 ms")
      ->check(CLI::IsMember(plant_names()))
      ->capture_default_str();
  kick.add_option("--task", options.task, "what the contact is paid for: as in kick, or as in aimed")
      ->check(CLI::IsMember({"kick", "aimed"}))
      ->capture_default_str();
  kick.add_option("--pose", options.pose, "where the robot stands")
      ->check(CLI::IsMember({"origin", "anywhere"}))
      ->capture_default_str();
  define_robot(kick, options.robot);
  host::reads_file(
      kick.add_option("--policy", options.policy,
                      "plays this policy instead of the built-in one (inproc): a header of "
                      "striker-export, or a model, safetensors or ONNX, which is exported first"));
  define_variation(kick, options.vary);
  kick.add_option("--episodes", options.episodes, "how many")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{900000}))
      ->capture_default_str();
  kick.add_option("--first", options.first,
                  "number of the first episode: each is a function of seed and number")
      ->capture_default_str();
  kick.add_option("--seed", options.seed, "of the episodes")->capture_default_str();
}

void define_bus_time(CLI::App& kick, KickOptions& options) {
  auto* bitrate = kick.add_option("--bitrate", options.bitrate,
                                  "lockstep: frames take bus time at this rate, in bit/s, and arbitrate");
  bitrate->check(CLI::Validator(bit_rate_problem, "bit/s"));
  kick.add_option("--step-us", options.step_us, "with --bitrate: from SYNC to the controller's frames")
      ->check(CLI::Range(0.0, 900.0))
      ->needs(bitrate)
      ->capture_default_str();
  kick.add_option("--vision-phase-us", options.vision_phase_us, "with --bitrate: from SYNC to the picture")
      ->check(CLI::Range(0.0, 999.0))
      ->needs(bitrate)
      ->capture_default_str();
}

void define_clock(CLI::App& kick, KickOptions& options) {
  kick.add_flag("--realtime", options.real_time, "run at wall-clock speed, without SYNC");
  kick.add_option("--answer-timeout", options.answer_timeout_ms,
                  "lockstep: run on unanswered after this, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
  kick.add_option("--start-timeout", options.start_timeout_ms, "lockstep: wait for a controller, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
}

void define_files(CLI::App& kick, KickOptions& options) {
  host::writes_file(kick.add_option("--json", options.json, "write the summary and every episode"));
  host::writes_file(kick.add_option("--log", options.log, "write the bus as a candump log (candump -L)"));
  host::writes_file(kick.add_option("--decisions", options.decisions,
                                    "write the controller's state at each decision as CSV (inproc)"));
}

}  // namespace

std::string bus_problem(const std::string& bus) {
  return bus == "inproc" || (bus.starts_with("can:") && bus.size() > 4)
             ? std::string()
             : "give inproc or can:IFACE, as can:vcan0";
}

void define(CLI::App& kick, KickOptions& options) {
  kick.footer(
      "Exit status: 0 all episodes were played with a controller; 2 wrong use, or no controller; 3 some were not "
      "driven all along, and are marked; 4 an emergency stop ended the run; 5 the bus or a file failed; 130 "
      "interrupted. What was finished is kept: in the files, or, after a kill, in LOG.part and "
      "JSON.episodes.jsonl.");
  kick.add_option("--bus", options.bus, "inproc: the controller in this process; can:IFACE: over SocketCAN")
      ->check(bus_problem)
      ->capture_default_str();
  define_episodes(kick, options);
  define_bus_time(kick, options);
  define_clock(kick, options);
  define_files(kick, options);
  define_view(kick, options.view);
  kick.final_callback([&kick, &options] {
    const bool is_on_own_clock = options.real_time && !options.in_process();
    host::require_meaning(kick, !is_on_own_clock, {"--bitrate"},
                          "lockstep (without --realtime) or --bus inproc");
    host::require_meaning(kick, !options.real_time && !options.in_process(),
                          {"--answer-timeout", "--start-timeout"},
                          "--bus can:IFACE in lockstep (without --realtime)");
    require_robot_in_process(kick, options.bus);
    if (has_foreign_drives && options.plant == "servo") {
      throw CLI::ValidationError("--plant",
                                 "servo takes set-points, which this build's drives are not told: use drive");
    }
    host::require_meaning(kick, options.in_process(), {"--decisions"},
                          "--bus inproc: it reads the controller's own state");
    host::require_meaning(kick, options.in_process(), {"--policy"},
                          "--bus inproc: a controller on a bus has its own");
    host::require_meaning(kick, options.policy.empty(), {"--decisions"},
                          "the built-in policy: its columns are those of its inputs");
  });
}

}  // namespace striker::sil
